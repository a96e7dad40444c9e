// Subcommand that runs the benchmarks.

#include "cli/Command.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/ProgramFolder.h"
#include "cli/bench/Bench.h"
#include "cli/bench/BenchReport.h"
#include "io/AtomicFile.h"
#include "io/ShippedProfiles.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace pacini::cli
{

namespace
{
namespace fs = std::filesystem;

/// The demo sounds: the nearest folder above the program that has them.
std::string demoFolder()
{
    std::error_code error;
    fs::path folder = programFolder();
    for (;; folder = folder.parent_path())
    {
        for (const fs::path& demo : {folder / "Resources" / "demo", folder / "share" / "pacini" / "demo"})
            if (fs::is_directory(demo, error))
                return demo.string();
        if (folder == folder.parent_path())
            return {};
    }
}

std::string compilerText()
{
#if defined(__clang__)
    return fmt::format("Clang {}.{}", __clang_major__, __clang_minor__);
#elif defined(__GNUC__)
    return fmt::format("GCC {}.{}", __GNUC__, __GNUC_MINOR__);
#elif defined(_MSC_VER)
    return fmt::format("MSVC {}", _MSC_VER);
#else
    return "another compiler";
#endif
}

std::string buildText()
{
#if defined(NDEBUG)
    return "optimised";
#else
    return "with assertions: times are not those of a release build";
#endif
}

/// `pacini bench`: error against run time, measured on the user's machine and sounds.
class BenchCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    std::string what = "all";
    std::vector<std::string> inputs;
    std::string output = "pacini-bench";
    std::string markdown;
    std::string format = "svg";
    BenchSettings settings;
    OverwriteOptions overwriting;
};
} // namespace

CLI::App* BenchCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("bench", "Measure error against run time");
    std::string names = "all";
    std::vector<std::string> allowed = {"all"};
    for (const Bench& bench : allBenches())
    {
        names += ", " + bench.name;
        allowed.push_back(bench.name);
    }
    addPreset(*command, "what", what, "What to measure: " + names, oneOf(allowed), "WHAT");
    addOption(*command, "inputs", inputs, "Sounds, or folders of them [the demo sounds]", "IN");
    addPreset(*command, "-o,--output", output, "Folder for the tables and charts", "DIR");
    addPreset(*command, "--repeat", settings.repeats, "Runs of which the fastest counts; long ones are not repeated",
              wholeNumberFrom(1, 1000));
    command->add_flag(
        "--sweep", settings.sweep,
        "methods: also Pacini's own at many settings; actuators: also small steps of strength, other boosts");
    addPreset(*command, "--format", format, "Format of the charts", oneOf({"svg", "png"}));
    addOption(*command, "--markdown", markdown, "Also write all tables into one Markdown page", "FILE");
    overwriting.declare(*command);
    command->footer("Errors and times come from the same runs, one at a time on one processor. Times differ between\n"
                    "computers; compare ratios.\n"
                    "Examples:\n  pacini bench simplify                         the demo sounds, into pacini-bench/\n"
                    "  pacini bench methods sounds/ --sweep -o out   all methods over a folder\n"
                    "  pacini bench all sounds/ --markdown measurements.md");
    return command;
}

Exit BenchCommand::run(Console& console)
{
    const bool demo = inputs.empty();
    if (demo)
    {
        inputs.push_back(demoFolder());
        if (inputs.front().empty())
            return console.fail(
                "", {ErrorCode::io, "", "finds no demo sounds beside this program; name a folder of sounds"});
    }
    bool failed = false;
    InputFiles found = findInputs(inputs, audioExtensions());
    for (const InputFailure& failure : found.failures)
    {
        console.error(failure.path.string(), failure.error);
        failed = true;
    }

    std::vector<BenchReport> reports;
    for (const Bench& bench : allBenches())
        if (what == "all" || what == bench.name)
            reports.emplace_back(bench);
    // Told before minutes of measuring, of which a table without rows would be left.
    if (std::any_of(reports.begin(), reports.end(),
                    [](const BenchReport& report) { return report.bench.needsProfiles; }) &&
        shippedProfiles(programFolder()).empty())
        return console.fail(
            programFolder().string(),
            {ErrorCode::io, "", "has no folder 'profiles' in it or above it, which bench actuators measures"});
    for (std::size_t i = 0; i < found.files.size(); ++i)
    {
        const auto& file = found.files[i];
        const auto sound = readBenchSound(file.path);
        if (!sound)
        {
            console.endProgress();
            console.error(file.path.string(), sound.error());
            failed = true;
            continue;
        }
        for (std::size_t b = 0; b < reports.size(); ++b)
        {
            const double done = static_cast<double>(b) / static_cast<double>(reports.size());
            console.progress(
                (static_cast<double>(i) + done) / static_cast<double>(found.files.size()),
                fmt::format("{} of {}  {}  {}", i + 1, found.files.size(), sound->name, reports[b].bench.name));
            reports[b].measure(*sound, settings);
        }
    }
    console.endProgress();
    if (std::all_of(reports.begin(), reports.end(), [](const BenchReport& report) { return report.sounds == 0; }))
        return Exit::failed;

    nlohmann::ordered_json object{{"compiler", compilerText()},
                                  {"build", buildText()},
                                  {"repeat", settings.repeats},
                                  {"benches", nlohmann::ordered_json::array()}};
    std::string page = fmt::format("# Measurements\n\nMade by Pacini " PACINI_VERSION
                                   " with\n\n    pacini bench {}{} --repeat {}{} --markdown {}\n\n"
                                   "Compiled by {}, {}. Times are of one processor and differ between computers; "
                                   "ratios hardly do.\n",
                                   what, demo ? "" : fmt::format(" {}", fmt::join(inputs, " ")), settings.repeats,
                                   settings.sweep ? " --sweep" : "", fs::path(markdown).filename().string(),
                                   compilerText(), buildText());
    std::vector<fs::path> written;
    for (BenchReport& report : reports)
    {
        report.means = report.rows.overSounds();
        console.print(fmt::format("{}, {}\n{}", report.bench.title, overText(report), report.means.aligned()));
        object["benches"].push_back(toJson(report));
        page += "\n" + toMarkdown(report);
        if (overwriting.keepsAll() && isOccupied(fs::path(output) / (report.bench.name + ".json")))
        {
            console.note(fmt::format("{}.json in {} exists and was left", report.bench.name, printable(output)));
            continue;
        }
        auto files = writeReport(report, output, format, overwriting.of(false));
        if (!files)
            return console.fail(files.error().where.empty() ? output : "", files.error());
        std::move(files->begin(), files->end(), std::back_inserter(written));
    }
    if (!markdown.empty())
    {
        if (const auto bytes = writeFileAtomically(markdown, page); !bytes)
            return console.fail(markdown, bytes.error());
        written.push_back(markdown);
    }
    console.addToReport(object);
    for (const fs::path& path : written)
        console.wrote(path);
    return failed ? Exit::failed : Exit::ok;
}

std::unique_ptr<Command> benchCommand()
{
    return std::make_unique<BenchCommand>();
}

} // namespace pacini::cli
