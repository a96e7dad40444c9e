// Subcommand that renders clips and scenes.

#include "cli/Batch.h"
#include "cli/Command.h"
#include "cli/Counted.h"
#include "cli/DescribedOptions.h"
#include "cli/Felt.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/ProfileInput.h"
#include "cli/ProgramFolder.h"
#include "cli/RenderJob.h"
#include "cli/RenderReport.h"
#include "cli/Task.h"
#include "cli/TaskRunner.h"
#include "io/ClipFile.h"
#include "io/Fields.h"
#include "io/FileExtension.h"
#include "io/ProfileJson.h"

#include <pacini/actuator/Wearer.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/synthesis/ClipAdaptation.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
using RenderTask = Task<RenderResult>;

constexpr std::array<Choice<SampleEncoding>, 3> encodings{
    {{"float32", SampleEncoding::float32}, {"pcm24", SampleEncoding::pcm24}, {"pcm16", SampleEncoding::pcm16}}};
constexpr double noticed = 0.5; // dB: a gain that was asked for and is reduced by more is worth a word

nlohmann::ordered_json toJson(const RenderTask& task, const RenderSettings& settings, bool explain)
{
    const RenderResult& r = *task.result;
    if (r.upToDate)
        return {{"input", task.input.string()},
                {"output", task.output.string()},
                {"bytes", r.bytes},
                {"duration", r.duration},
                {"seconds", 0.0},
                {"timesRealTime", 0.0},
                {"upToDate", true}};
    nlohmann::ordered_json report{{"input", task.input.string()},
                                  {"output", task.output.string()},
                                  {"kind", r.isScene ? "scene" : "clip"},
                                  {"bytes", r.bytes},
                                  {"duration", r.duration},
                                  {"seconds", r.seconds},
                                  {"timesRealTime", r.seconds > 0.0 ? r.duration / r.seconds : 0.0},
                                  {"peak", r.peak},
                                  {"gainReduction", r.reduction},
                                  {"clippedSamples", r.clippedSamples},
                                  {"upToDate", false},
                                  {"plan", planJson(r, settings.compile)}};
    if (explain)
        report["plan"].update(planLists(r));
    if (const auto& felt = settings.felt)
    {
        report["feltFullScale"] = felt->fullScale;
        report["feltPeak"] = r.peak * felt->fullScale;
        report["wearer"] = felt->wearer;
    }
    return report;
}

std::string summary(const std::vector<RenderTask>& tasks, const std::optional<FeltParams>& felt)
{
    std::size_t done = 0, fresh = 0;
    const std::size_t skipped = countSkipped(tasks);
    double duration = 0.0, seconds = 0.0, peak = 0.0;
    for (const RenderTask& task : tasks)
        if (task.result && task.result->upToDate)
            ++fresh;
        else if (task.result)
        {
            ++done;
            duration += task.result->duration;
            seconds += task.result->seconds;
            peak = std::max(peak, task.result->peak);
        }
    std::string text =
        fmt::format("{} rendered{}", done, restText(fresh, skipped, tasks.size() - done - fresh - skipped));
    if (seconds > 0.0)
        text += fmt::format(": {}, {:.0f} times real time", durationText(duration), duration / seconds);
    if (felt && done > 0)
        text += fmt::format(", peak {:.3g} m/s2", peak * felt->fullScale);
    return text;
}

/// How to avoid the clipping of samples of which the largest is `peak`.
std::string clippingAdvice(double peak, double gain, const std::optional<FeltParams>& felt)
{
    if (felt)
        return fmt::format("--felt-full-scale {:.0f} avoids it", std::ceil(peak * felt->fullScale));
    return fmt::format("--gain {:.1f} avoids it", gain - std::ceil(200.0 * std::log10(peak)) / 10.0);
}

/// Says where a task came out softer than it was asked for, or clipped.
void tellLevel(Console& console, const RenderTask& task, const RenderSettings& settings)
{
    const double gain = settings.adjustment.gain;
    const RenderResult& result = *task.result;
    if (gain > 0.0 && result.reduction > noticed)
        console.warning(task.input.string(),
                        fmt::format("the limiter takes back up to {:.1f} of the {:.1f} dB of --gain, "
                                    "to stay within the limits of the actuator",
                                    std::min(result.reduction, gain), gain));
    else if (result.clippedSamples > 0)
        console.warning(task.input.string(),
                        fmt::format("{} clipped; {}", counted(result.clippedSamples, "sample was", "samples were"),
                                    clippingAdvice(result.peak, gain, settings.felt)));
}

/// `pacini render`: renders clips and scenes as drive signals, or as the acceleration of the skin.
struct RenderCommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    /// The clips and scenes to render. Of a folder those of other programs only where no clip of Pacini's has the same
    /// name, which they are then an export of.
    [[nodiscard]] InputFiles findClips() const;

    /// Reads the options; what is wrong with them is said, and anything but ok returned.
    [[nodiscard]] Exit readSettings(Console& console, RenderSettings& settings) const;

    /// All options that change what is written.
    [[nodiscard]] std::string record() const;

    CLI::App* command = nullptr;
    std::vector<std::string> inputs;
    std::string output;
    std::string profile;
    std::string designedFor;
    DescribedOptions described;
    DescribedOptions describedFelt;
    std::string encoding = "float32";
    std::uint64_t seed = 0;
    bool dryRun = false;
    std::string clipFolder;
    unsigned jobs = 0;
    bool felt = false;
    bool everything = false;
    bool noAdaptation = false;
    bool noProtection = false;
    bool force = false;
    OverwriteOptions overwriting;
    bool explain = false;
    bool measured = false;
    Batch batch;
};
} // namespace

CLI::App* RenderCommand::declare(CLI::App& app)
{
    command = app.add_subcommand("render",
                                 "Render clips and scenes as drive signals, or as the acceleration of the skin (WAV)");
    addOption(*command, "inputs", inputs,
              "Clips (JSON or packed), scenes (JSON), folders of both, or - for standard input", "CLIP|SCENE")
        ->required();
    addOption(*command, "-o,--output", output,
              "Sound file (.wav or .flac) with one channel for each actuator, folder for several inputs, or - for WAV "
              "on standard output [beside each input, as .haptic.wav]",
              "OUT|DIR");
    addOption(*command, "--profile", profile,
              "Actuator profile that clips are adapted to: a file or a shipped profile such as l5-wristband",
              "PROFILE");
    auto* designed =
        addOption(*command, "--designed-for", designedFor,
                  "Actuator profile on which the clips were designed: they feel alike on that of --profile", "PROFILE");
    addPreset(*command, "--encoding", encoding, "Sample format of the output: float32, pcm24 or pcm16",
              oneOf(encodings));
    described.declare(*command, infosOf(renderParameters));
    addPreset(*command, "--seed", seed, "Seed of the variation", countingNumber());
    addOption(*command, "--clips", clipFolder, "Folder with the clip files of scenes [the folder of the scene]", "DIR");
    auto* all =
        command->add_flag("--everything", everything, "Render everything, also inaudible and imperceptible parts");
    command->get_option("--tolerance")->excludes(all);
    auto* asIs = command->add_flag("--no-adapt", noAdaptation, "Do not adapt clips to the profile's actuator");
    std::vector<CLI::Option*> adapting{designed};
    for (const RenderParameter& parameter : renderParameters)
        if (parameter.need == RenderNeed::adaptation)
            adapting.push_back(command->get_option(optionName(parameter)));
    asIs->needs(command->get_option("--profile"));
    for (CLI::Option* fitted : adapting)
        fitted->needs(command->get_option("--profile"))->excludes(asIs);
    command->add_flag(
        "--no-protection", noProtection,
        "Switch off the limiter and the profile's limits: samples beyond 1 are written unchanged, or clipped in PCM");
    auto* asFelt = command->add_flag(
        "--felt", felt,
        "Write the acceleration of the skin, predicted by the profile's body model, instead of the drive signal");
    asFelt->needs(command->get_option("--profile"));
    describedFelt.declare(*command, infosOf(feltParameters));
    for (const auto& parameter : feltParameters)
        command->get_option(optionName(parameter))->needs(asFelt);
    command->add_flag("--explain", explain,
                      "Show the parts that are played, and those that are skipped, with reason and error");
    command->add_flag("--measured", measured, "Like --explain, and also measure the error by rendering everything");
    command->add_flag("-f,--force", force, "Also render files that are up to date");
    overwriting.declare(*command);
    command->add_flag("--dry-run", dryRun, "Print what would be done with each file and write nothing");
    addOption(*command, "-j,--jobs", jobs, "Number of files processed in parallel [number of processors]",
              wholeNumberFrom(1u, 256u), "N");
    batch.declare(*command);
    return command->footer("Examples:\n  pacini render door.pacb -o door.wav\n"
                           "  pacini render door.pacb -o door.wav --profile l5-wristband --encoding pcm24\n"
                           "  pacini render step.json -o step3.wav --variation 0.3 --seed 3\n"
                           "  pacini render hall.scene.json -o hall.wav --explain\n"
                           "  pacini render hall.scene.json -o part.wav --from 12.5 --to 20\n"
                           "  pacini render door.pacb -o skin.wav --profile l5-wristband --felt");
}

InputFiles RenderCommand::findClips() const
{
    InputFiles found = findInputs(inputs, clipFileExtensions());
    const auto isOwn = [](const InputFile& file)
    {
        return isOwnExtension(lowerExtension(file.path));
    };
    std::set<std::filesystem::path> ownNames;
    for (const InputFile& file : found.files)
        if (isOwn(file))
            ownNames.insert(std::filesystem::path(file.path).replace_extension());
    std::erase_if(found.files,
                  [&](const InputFile& file)
                  {
                      const bool named = std::find(inputs.begin(), inputs.end(), file.path.string()) != inputs.end();
                      return !named && !isOwn(file) &&
                             (ownNames.contains(std::filesystem::path(file.path).replace_extension()) ||
                              !companionOf(file.path).empty());
                  });
    return found;
}

std::string RenderCommand::record() const
{
    std::string text = "Pacini " PACINI_VERSION;
    const std::vector<std::string> without = {"inputs",   "output",  "profile", "designed-for", "clips",     "explain",
                                              "measured", "jobs",    "force",   "no-overwrite", "overwrite", "json",
                                              "quiet",    "dry-run", "strict",  "shard",        "manifest",  "retry"};
    for (const CLI::Option* option : command->get_options())
        if (const auto name = option->get_single_name();
            option->count() > 0 && std::find(without.begin(), without.end(), name) == without.end())
            text += fmt::format(", {} {}", name, fmt::join(option->results(), " "));
    return text;
}

Exit RenderCommand::readSettings(Console& console, RenderSettings& settings) const
{
    described.apply(renderParameters, settings);
    if (const auto part = checkPart(settings); !part)
        return console.fail("", {ErrorCode::invalidArgument, "render", "--from must be before --to"}, Exit::usage);
    settings.compile.sampleRate = std::round(settings.compile.sampleRate);
    settings.adjustment.variation.seed = seed;
    settings.compile.leaveOut = !everything;
    settings.compile.adapt = !noAdaptation;
    for (const RenderParameter& parameter : renderParameters)
        if (command->count(optionName(parameter)) > 0)
            if (const auto used = checkEffect(parameter, settings, !profile.empty()); !used)
                return console.fail("", {used.error().code, optionName(parameter), used.error().message}, Exit::usage);
    settings.protect = !noProtection;
    settings.dryRun = dryRun;
    settings.reading = {clipFolder, console.isStrict()};
    settings.describe = explain || measured || console.isJson();
    settings.measure = measured;
    settings.encoding = *valueOf(encoding, encodings);
    if (!profile.empty())
    {
        settings.profile = openProfile(console, profile);
        if (!settings.profile)
            return Exit::failed;
    }
    if (!designedFor.empty())
    {
        settings.designedFor = openProfile(console, designedFor);
        if (!settings.designedFor)
            return Exit::failed;
    }
    if (felt)
    {
        if (const auto known = checkFelt(*settings.profile, programFolder()); !known)
            return console.fail(profile, known.error());
        describedFelt.apply(feltParameters, settings.felt.emplace());
    }

    settings.record = record();
    if (settings.profile)
        settings.record += ", " + profileJson(*settings.profile);
    if (settings.designedFor)
        settings.record += ", designed for " + profileJson(*settings.designedFor);
    settings.resume = !force && !explain && !measured;
    return Exit::ok;
}

Exit RenderCommand::run(Console& console)
{
    RenderSettings settings;
    if (const Exit read = readSettings(console, settings); read != Exit::ok)
        return read;
    explain = explain || measured;
    const InputFiles found = findClips();
    if (const auto fits = checkOutput(found, output, console.isJson()); !fits)
        return console.fail("", fits.error(), Exit::usage);
    if (isStandardOutput(output))
        console.keepStdoutFree();
    auto tasks =
        makeTasks<RenderResult>(found, {output, ".wav", felt ? ".felt.wav" : ".haptic.wav"}, overwriting, !dryRun);
    if (const auto started = batch.start(tasks, dryRun); !started)
        return console.fail("", started.error());
    BatchEnd end;
    runTasks(console, tasks, jobs,
             [&]
             {
                 return [&](std::size_t i, const std::function<void(double)>& progress)
                 {
                     RenderTask& task = tasks[i];
                     attempt(task, end,
                             [&] { return render(task.input, task.output, task.replaceable, settings, progress); });
                     if (task.result)
                         console.warnings(task.input.string(), task.result->warnings);
                     tellError(console, task, end);
                     batch.add(task, [&](const RenderTask& done) { return toJson(done, settings, explain); });
                     if (!task.result)
                         return;
                     if (!task.result->upToDate && !dryRun)
                         console.wrote(task.output, durationText(task.result->duration));
                     tellLevel(console, task, settings);
                 };
             });

    if (dryRun)
    {
        reportPlan(console, tasks);
        return anyFailed(tasks) ? Exit::failed : Exit::ok;
    }
    console.addToReport(jsonReport(tasks, [&](const RenderTask& task) { return toJson(task, settings, explain); }));
    for (const RenderTask& task : tasks)
        if (explain && task.result)
            console.print(
                fmt::format("{}:\n{}", printable(task.input.string()), planText(*task.result, settings.compile)));
    console.note(summary(tasks, settings.felt));
    return batch.finish(console) && !anyFailed(tasks) ? Exit::ok : Exit::failed;
}

std::unique_ptr<Command> renderCommand()
{
    return std::make_unique<RenderCommand>();
}

} // namespace pacini::cli
