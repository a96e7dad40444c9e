// Subcommand that compares haptic signals with the sounds they were made from.

#include "cli/Batch.h"
#include "cli/Command.h"
#include "cli/ComparePairs.h"
#include "cli/CompareReport.h"
#include "cli/Counted.h"
#include "cli/Options.h"
#include "cli/TaskRunner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace pacini::cli
{

namespace
{
/// The list of doubtful onsets that belongs to X.json, X_ambiguous.json, when there is one.
fs::path ambiguousBeside(const fs::path& onsets)
{
    fs::path path = onsets;
    path.replace_filename(onsets.stem().string() + "_ambiguous" + onsets.extension().string());
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) ? path : fs::path();
}

/// Reads what --onsets names; a failure is reported and gives false.
bool readOnsetFiles(Console& console, const std::string& path, const ComparePairs& found, CompareSettings& settings)
{
    const auto read = [&](const fs::path& file, Onsets& target)
    {
        auto onsets = readOnsets(file);
        if (onsets)
            target = std::move(*onsets);
        else
            console.error(file.string(), onsets.error());
        return onsets.ok();
    };
    if (!read(path, settings.onsets.emplace()))
        return false;
    if (const fs::path beside = ambiguousBeside(path); !beside.empty() && !read(beside, settings.ambiguous))
        return false;
    if (!settings.onsets->namesFiles && found.pairs.size() > 1)
    {
        console.error(
            path, {ErrorCode::invalidData, "",
                   "has the onsets of one sound, but several are compared; write {\"door.wav\": [0.12, 0.8], ...}"});
        return false;
    }
    const auto isNamed = [&](const ComparePair& pair)
    {
        return settings.onsets->find(pair.reference) != nullptr;
    };
    if (!found.pairs.empty() && std::none_of(found.pairs.begin(), found.pairs.end(), isNamed))
    {
        console.error(path, {ErrorCode::invalidData, "",
                             "has no onsets of " + found.pairs.front().reference.filename().string() +
                                 (found.pairs.size() > 1 ? " or any other reference" : "")});
        return false;
    }
    return true;
}

/// Runs the job; what it throws becomes the failure of this pair, so that the others go on.
void compareOne(CompareJob& job, CompareTask& task, const std::function<void(double)>& progress)
{
    const auto fail = [&](Error error)
    {
        task.failure = InputFailure{task.pair.reference, std::move(error)};
    };
    try
    {
        auto outcome = job.run(task.pair, progress);
        if (auto* failure = std::get_if<InputFailure>(&outcome))
            task.failure = std::move(*failure);
        else
            task.result = std::move(std::get<CompareResult>(outcome));
    }
    catch (const std::bad_alloc&)
    {
        fail({ErrorCode::tooLarge, "", "needs more memory than is available; compare it alone, with -j 1"});
    }
    catch (const std::exception& error)
    {
        fail({ErrorCode::io, "", error.what()});
    }
}

void report(Console& console, const CompareTask& task)
{
    if (task.failure)
    {
        console.error(task.failure->path.string(), task.failure->error);
        return;
    }
    const CompareResult& r = *task.result;
    console.warnings(task.pair.reference.string(), r.referenceWarnings);
    console.warnings(task.pair.candidate.string(), r.candidateWarnings);
    console.warnings(task.pair.events.string(), r.warnings);
    if (std::abs(r.duration - r.candidateDuration) > 0.05)
        console.warning(task.pair.candidate.string(),
                        fmt::format("lasts {:.3f} s, its reference {:.3f} s; compared over the length of the "
                                    "reference, with silence for any missing part",
                                    r.candidateDuration, r.duration));
    constexpr double noticed = 20.0; // ms: rises that are less steep than those of the sound are as late
    if (std::abs(r.matchLag) > (r.aligned ? 4.0 : noticed))
        console.warning(task.pair.candidate.string(),
                        fmt::format("is {:.0f} ms {} than its reference, {}", std::abs(r.matchLag),
                                    r.matchLag > 0.0 ? "later" : "earlier",
                                    r.aligned ? "the match is computed without the lag, as the lengths differ"
                                              : "the lag will be felt and lowers the match"));
    if (r.notFinite > 0)
        console.warning(task.pair.candidate.string(),
                        counted(r.notFinite, "sample in it or its reference is not finite and counts as silence",
                                "samples in it or its reference are not finite and count as silence"));
    if (r.measures.silentReference)
        console.warning(task.pair.reference.string(),
                        "is silent between 30 and 1000 Hz; only match and HTS are meaningful");
}

/// What the manifest says of a pair.
BatchOutcome outcomeOf(const CompareTask& task)
{
    BatchOutcome outcome;
    if (task.failure)
        outcome.error = task.failure->error.text();
    else if (task.result)
    {
        outcome.duration = task.result->duration;
        outcome.report = nlohmann::json(pairJson(task));
    }
    return outcome;
}

/// `pacini compare`: how much of a sound a haptic signal keeps.
struct CompareCommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    std::string reference;
    std::string candidate;
    std::string onsets;
    std::string events;
    unsigned jobs = 0;
    bool allowTruncated = false;
    Batch batch;
};
} // namespace

CLI::App* CompareCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("compare", "Measure how much of a sound a haptic signal keeps");
    addOption(*command, "reference", reference, "Sound: an audio file or a folder of audio files", "REF")->required();
    addOption(
        *command, "candidate", candidate,
        "Haptic signal: an audio file, or a clip, which is rendered first; or a folder of files with the same names",
        "CAND")
        ->required();
    auto* onsetOption =
        addOption(*command, "--onsets", onsets,
                  "Known onsets of the sound: JSON, {\"door.wav\": [0.12, 0.8]} in seconds, or text with one "
                  "time per line. FILE_ambiguous.json beside FILE.json lists events that are not scored",
                  "FILE");
    addOption(*command, "--events", events,
              "Clip, or folder of clips, whose transients are the events of the candidate [detected in the candidate]",
              "CLIP")
        ->needs(onsetOption);
    command->add_flag("--allow-truncated", allowTruncated, "Compare the remaining part of truncated files");
    addOption(*command, "-j,--jobs", jobs,
              "Number of pairs processed in parallel; a single pair takes two threads unless N is 1 "
              "[number of processors]",
              wholeNumberFrom(1u, 256u), "N");
    batch.declare(*command);
    return command->footer(
        "Measures (from 30 to 1000 Hz unless noted; the level of the candidate does not matter):\n"
        "  match           predicted mean rating by people of how well it matches the sound, 0 to 100. Values range\n  "
        "                from 35 (nothing is felt) to 71; the JSON also has its parts\n"
        "  HTS             haptic translation similarity, 0 to 100: envelope and events as heard, spectrum as felt\n"
        "  sound itself    a row: the sound played as it is; silence: nothing is felt\n"
        "  of REF          the HTS of the unchanged sound. It is below 100 when much of the sound cannot be felt; a\n  "
        "                translation that makes this part perceptible can score higher\n"
        "  HTS-F           like HTS, but compares only the parts that can be felt\n"
        "  LSD             log-spectral distance in third octaves; 0 is equal\n"
        "  wide SNR        of the envelope of the whole band; 60 is equal\n"
        "  band SNR        of the envelopes of 12 bands; 60 is equal\n"
        "  low kept        correlation of the envelopes of 30 to 120 and 120 to 300 Hz with those of the sound\n"
        "  beat kept       level in the strongest low events against that between them, as a share of the same\n"
        "                  ratio of the sound; 1 is equal\n"
        "  centroid error  median error of the spectral centroid\n"
        "  F1              events within 25 ms of the onsets: 2 hits / (2 hits + spurious + missed)\n"
        "Sample rates from 2 to 768 kHz; channels are mixed down. Signals are not aligned in time.\n\n"
        "Examples:\n"
        "  pacini compare door.wav door.json\n"
        "  pacini compare door.wav door_haptic.wav\n"
        "  pacini compare sounds/ rendered/ --json -j 4\n"
        "  pacini compare door.wav door_haptic.wav --onsets onsets.json --events door.pacb");
}

Exit CompareCommand::run(Console& console)
{
    const auto paired = pairFiles(reference, candidate, events);
    if (!paired)
        return console.fail("", paired.error(), Exit::usage);
    CompareSettings settings;
    settings.allowTruncated = allowTruncated;
    settings.strict = console.isStrict();
    if (!onsets.empty() && !readOnsetFiles(console, onsets, *paired, settings))
        return Exit::failed;
    for (const InputFailure& failure : paired->failures)
        console.error(failure.path.string(), failure.error);
    for (const fs::path& file : paired->leftOver)
        console.warning(file.string(), "has no reference and is skipped");

    std::vector<CompareTask> tasks;
    for (const ComparePair& pair : paired->pairs)
        tasks.push_back({pair, {}, {}});
    std::vector<BatchFile> files;
    for (const ComparePair& pair : paired->pairs)
        files.push_back({pair.reference, pair.name.generic_string(), false});
    const auto chosen = batch.start(files, false);
    if (!chosen)
        return console.fail("", chosen.error());
    keepChosen(tasks, *chosen);
    for (const PairFailure& failure : paired->failures)
        batch.add(failure.name, {{}, 0.0, {}, failure.error.text(), false});
    const auto nameOf = [&](std::size_t i)
    {
        return tasks[i].pair.name.string();
    };
    const unsigned within = tasks.size() > 1 ? 1u : jobs > 0 ? jobs : std::thread::hardware_concurrency();
    runTasks(console, tasks.size(), jobs, nameOf,
             [&]
             {
                 return [&, job = CompareJob(settings, within)](std::size_t i,
                                                                const std::function<void(double)>& progress) mutable
                 {
                     compareOne(job, tasks[i], progress);
                     report(console, tasks[i]);
                     batch.add(tasks[i].pair.name.generic_string(), outcomeOf(tasks[i]));
                 };
             });

    const bool anyDone = std::any_of(tasks.begin(), tasks.end(), [](const auto& task) { return task.result; });
    const bool anyFailed = !paired->failures.empty() ||
                           std::any_of(tasks.begin(), tasks.end(), [](const auto& task) { return task.failure; });
    console.addToReport(compareJson(tasks));
    if (anyDone)
        console.print(compareTable(tasks));
    console.print(compareSummary(tasks, paired->failures.size()));
    return batch.finish(console) && !anyFailed ? Exit::ok : Exit::failed;
}

std::unique_ptr<Command> compareCommand()
{
    return std::make_unique<CompareCommand>();
}

} // namespace pacini::cli
