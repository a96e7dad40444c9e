#include "cli/bench/BenchRun.h"

#include "cli/InputFiles.h"
#include "cli/Overwrite.h"
#include "cli/ProgramFolder.h"
#include "cli/bench/Bench.h"
#include "cli/bench/BenchReport.h"
#include "io/AtomicFile.h"
#include "io/ShippedProfiles.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

namespace pacini::cli
{

namespace fs = std::filesystem;

namespace
{
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

/// Adds each sound to all reports. False: one could not be read, which has been said.
bool measureSounds(const std::vector<InputFile>& files, const BenchSettings& settings,
                   std::vector<BenchReport>& reports, Console& console)
{
    bool good = true;
    for (std::size_t i = 0; i < files.size(); ++i)
    {
        const auto& file = files[i];
        const auto sound = readBenchSound(file.path);
        if (!sound)
        {
            console.endProgress();
            console.error(file.path.string(), sound.error());
            good = false;
            continue;
        }
        for (std::size_t b = 0; b < reports.size(); ++b)
        {
            const double done = static_cast<double>(b) / static_cast<double>(reports.size());
            console.progress((static_cast<double>(i) + done) / static_cast<double>(files.size()),
                             fmt::format("{} of {}  {}  {}", i + 1, files.size(), sound->name, reports[b].bench.name));
            reports[b].measure(*sound, settings);
        }
    }
    console.endProgress();
    return good;
}

/// The start of the page that --markdown writes.
std::string pageHead(const BenchOptions& options, const std::vector<std::string>& inputs, bool demo)
{
    return fmt::format("# Measurements\n\nMade by Pacini " PACINI_VERSION
                       " with\n\n    pacini bench {}{} --repeat {}{} --markdown {}\n\n"
                       "Compiled by {}, {}. Times are of one processor and differ between computers; "
                       "ratios hardly do.\n",
                       options.what, demo ? "" : fmt::format(" {}", fmt::join(inputs, " ")), options.settings.repeats,
                       options.settings.sweep ? " --sweep" : "", fs::path(options.markdown).filename().string(),
                       compilerText(), buildText());
}
} // namespace

Exit runBenches(const BenchOptions& options, Console& console)
{
    std::vector<std::string> inputs = options.inputs;
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
        if (options.what == "all" || options.what == bench.name)
            reports.emplace_back(bench);
    // Told before minutes of measuring, of which a table without rows would be left.
    if (std::any_of(reports.begin(), reports.end(),
                    [](const BenchReport& report) { return report.bench.needsProfiles; }) &&
        shippedProfiles(programFolder()).empty())
        return console.fail(
            programFolder().string(),
            {ErrorCode::io, "", "has no folder 'profiles' in it or above it, which bench actuators measures"});
    failed = !measureSounds(found.files, options.settings, reports, console) || failed;
    if (std::all_of(reports.begin(), reports.end(), [](const BenchReport& report) { return report.sounds == 0; }))
        return Exit::failed;

    nlohmann::ordered_json object{{"compiler", compilerText()},
                                  {"build", buildText()},
                                  {"repeat", options.settings.repeats},
                                  {"benches", nlohmann::ordered_json::array()}};
    std::string page = pageHead(options, inputs, demo);
    std::vector<fs::path> written;
    for (BenchReport& report : reports)
    {
        report.means = report.rows.overSounds();
        if (!report.bench.sortedBy.empty())
            report.means = report.means.sortedBy(report.bench.sortedBy);
        console.print(fmt::format("{}, {}\n{}\n{}", report.bench.title, overText(report), report.means.aligned(),
                                  report.bench.note));
        object["benches"].push_back(toJson(report));
        page += "\n" + toMarkdown(report);
        if (options.overwriting.keepsAll() && isOccupied(fs::path(options.output) / (report.bench.name + ".json")))
        {
            console.note(
                fmt::format("{}.json in {} exists and was kept", report.bench.name, printable(options.output)));
            continue;
        }
        auto files = writeReport(report, options.output, options.format, options.overwriting.of(false));
        if (!files)
            return console.fail(files.error().where.empty() ? options.output : "", files.error());
        std::move(files->begin(), files->end(), std::back_inserter(written));
    }
    if (!options.markdown.empty())
    {
        if (const auto bytes = writeFileAtomically(options.markdown, page); !bytes)
            return console.fail(options.markdown, bytes.error());
        written.push_back(options.markdown);
    }
    console.addToReport(object);
    for (const fs::path& path : written)
        console.wrote(path);
    return failed ? Exit::failed : Exit::ok;
}

} // namespace pacini::cli
