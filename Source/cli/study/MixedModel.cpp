#include "cli/study/MixedModel.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <utility>

#if !defined(_WIN32)
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__APPLE__)
extern char** environ;
#endif
#endif

namespace pacini::cli
{

namespace
{
using Json = nlohmann::json;

// The table comes first: a program that ends without reading it would leave the other end of the pipe nobody.
constexpr const char* program = R"python(import io, json, sys, warnings
table = sys.stdin.read()
try:
    import pandas, statsmodels
    import statsmodels.formula.api as formula
except ImportError as error:
    print(json.dumps({"missing": str(error)}))
    sys.exit()
warnings.simplefilter("ignore")
data = pandas.read_csv(io.StringIO(table), dtype=str, keep_default_na=False)
data["rating"] = data["rating"].astype(float)
for name in ("group", "participant"):
    if name not in data:
        data[name] = ""
data["person"] = data["group"] + "/" + data["participant"]
data["all"] = 1

def effects(fit, names):
    intervals = fit.conf_int()
    return [{"name": shown, "estimate": fit.params[name], "error": fit.bse[name], "low": intervals[0][name],
             "high": intervals[1][name], "p": fit.pvalues[name]} for name, shown in names]

def named(model, column):
    levels = sorted(data[column].unique())
    return [("Intercept", levels[0])] + [(f"C({column})[T.{level}]", level) for level in levels[1:]]

try:
    several = data["group"].nunique() > 1
    crossed = formula.mixedlm("rating ~ C(group)" if several else "rating ~ 1", data, groups="all",
                              vc_formula={"person": "0 + C(person)", "stimulus": "0 + C(stimulus)"}).fit(reml=True)
    stimuli = formula.mixedlm("rating ~ C(stimulus)", data, groups="person").fit(reml=True)
    variances = dict(zip(crossed.model.exog_vc.names, crossed.vcomp))
    print(json.dumps({"groups": effects(crossed, named(crossed, "group")),
                      "stimuli": effects(stimuli, named(stimuli, "stimulus")),
                      "participantVariance": variances["person"], "stimulusVariance": variances["stimulus"],
                      "residualVariance": crossed.scale, "converged": bool(crossed.converged and stimuli.converged),
                      "program": f"statsmodels {statsmodels.__version__}"}))
except Exception as error:
    print(json.dumps({"failed": f"{type(error).__name__}: {error}"}))
)python";

#if !defined(_WIN32)
/// Both ends of a pipe, closed at the end.
class Pipe
{
public:
    Pipe()
    {
        if (pipe(ends.data()) != 0)
            ends = {-1, -1};
    }
    ~Pipe()
    {
        closeEnd(0);
        closeEnd(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    [[nodiscard]] int end(std::size_t which) const { return ends[which]; }
    void closeEnd(std::size_t which)
    {
        if (ends[which] >= 0)
            close(std::exchange(ends[which], -1));
    }

private:
    std::array<int, 2> ends{-1, -1};
};

/// What a program of Python prints that is given `input`.
Result<std::string> runPython(const char* source, std::string_view input)
{
    Pipe in, out;
    if (in.end(0) < 0 || out.end(0) < 0)
        return Error{ErrorCode::io, "python3", "cannot be started: too many files are open"};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in.end(0), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out.end(1), STDOUT_FILENO);
    for (const int end : {in.end(0), in.end(1), out.end(0), out.end(1)})
        posix_spawn_file_actions_addclose(&actions, end);
    std::array<std::string, 3> words{"python3", "-c", source};
    std::array<char*, 4> line{words[0].data(), words[1].data(), words[2].data(), nullptr};
    pid_t child = 0;
    const int failed = posix_spawnp(&child, "python3", &actions, nullptr, line.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0)
        return Error{ErrorCode::io, "python3", fmt::format("cannot be started: {}", std::strerror(failed))};
    in.closeEnd(0);
    out.closeEnd(1);
    const auto before = std::signal(SIGPIPE, SIG_IGN); // it may end early
    while (!input.empty())
    {
        const ssize_t written = write(in.end(1), input.data(), input.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            break;
        input.remove_prefix(static_cast<std::size_t>(written));
    }
    in.closeEnd(1);
    std::signal(SIGPIPE, before);
    std::string printed;
    std::array<char, 4096> piece;
    for (;;)
    {
        const ssize_t got = read(out.end(0), piece.data(), piece.size());
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        printed.append(piece.data(), static_cast<std::size_t>(got));
    }
    while (waitpid(child, nullptr, 0) < 0 && errno == EINTR)
    {
    }
    return printed;
}
#else
Result<std::string> runPython(const char*, std::string_view)
{
    return Error{ErrorCode::io, "python3",
                 "is not available on Windows; export the ratings and fit them with another program"};
}
#endif

double numberOf(const Json& object, const char* name)
{
    const auto found = object.find(name);
    return found != object.end() && found->is_number() ? found->get<double>() : 0.0;
}

std::string textOf(const Json& object, const char* name)
{
    const auto found = object.find(name);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::vector<FixedEffect> effectsOf(const Json& list)
{
    std::vector<FixedEffect> effects;
    if (list.is_array())
        for (const Json& one : list)
            effects.push_back({textOf(one, "name"), numberOf(one, "estimate"), numberOf(one, "error"),
                               numberOf(one, "low"), numberOf(one, "high"), numberOf(one, "p")});
    return effects;
}
} // namespace

Result<MixedModel> fitMixedModel(const std::vector<study::Rating>& ratings)
{
    const auto printed = runPython(program, study::ratingsCsv(ratings));
    if (!printed)
        return printed.error();
    const Json found = Json::parse(*printed, nullptr, false);
    if (!found.is_object())
        return Error{ErrorCode::io, "python3", "returned no result"};
    if (const std::string missing = textOf(found, "missing"); !missing.empty())
        return Error{
            ErrorCode::io, "python3",
            fmt::format("has no statsmodels ({}); install it with python3 -m pip install statsmodels", missing)};
    if (const std::string failed = textOf(found, "failed"); !failed.empty())
        return Error{ErrorCode::invalidData, "statsmodels", fmt::format("cannot fit these ratings: {}", failed)};
    MixedModel model;
    model.groups = effectsOf(found.value("groups", Json()));
    model.stimuli = effectsOf(found.value("stimuli", Json()));
    model.participantVariance = numberOf(found, "participantVariance");
    model.stimulusVariance = numberOf(found, "stimulusVariance");
    model.residualVariance = numberOf(found, "residualVariance");
    model.converged = found.value("converged", false);
    model.program = textOf(found, "program");
    return model;
}

} // namespace pacini::cli
