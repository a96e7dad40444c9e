#include "cli/study/MixedModel.h"

#include "io/ChildProgram.h"
#include "io/FileHandle.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::json;

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

/// What a program of Python prints that is given `input`.
Result<std::string> runPython(const char* source, const std::string& input)
{
    const FileHandle table = namelessStream();
    if (!table || std::fwrite(input.data(), 1, input.size(), table.get()) != input.size() ||
        !seekStream(table.get(), 0, SEEK_SET))
        return fileError(errno);
    const auto python = ChildProgram::start("python3", {"-c", source}, table.get());
    if (!python)
        return python.error();
    if (*python == nullptr)
        return Error{ErrorCode::io, "python3", fmt::format("cannot be started: {}", std::strerror(ENOENT))};
    constexpr std::size_t most = std::size_t(1) << 24; // bytes
    std::string printed = allOutput(**python, most);
    const auto ending = (*python)->wait();
    std::fputs(ending.complaint.c_str(), stderr);
    return printed;
}

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
