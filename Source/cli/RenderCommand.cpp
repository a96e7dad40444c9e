#include "cli/RenderCommand.h"

#include "cli/Checks.h"
#include "cli/Counted.h"
#include "cli/InputFiles.h"
#include "cli/ProfileInput.h"
#include "cli/ProgramFolder.h"
#include "cli/RenderJob.h"
#include "cli/RenderReport.h"
#include "cli/Task.h"
#include "cli/TaskRunner.h"
#include "io/ClipFile.h"
#include "io/FileExtension.h"
#include "io/ProfileJson.h"

#include <pacini/actuator/Wearer.h>
#include <pacini/foundation/DspBlock.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

namespace pacini::cli
{

namespace
{
using RenderTask = Task<RenderResult>;

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

std::string summary(const std::vector<RenderTask>& tasks, const std::optional<FeltSettings>& felt)
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
    std::string text = fmt::format("{} rendered", done);
    if (fresh > 0)
        text += fmt::format(", {} up to date", fresh);
    if (skipped > 0)
        text += ", " + counted(skipped, "exists and was left", "exist and were left");
    if (done + fresh + skipped < tasks.size())
        text += fmt::format(", {} failed", tasks.size() - done - fresh - skipped);
    if (seconds > 0.0)
        text += fmt::format(": {}, {:.0f} times real time", durationText(duration), duration / seconds);
    if (felt && done > 0)
        text += fmt::format(", peak {:.3g} m/s2", peak * felt->fullScale);
    return text;
}

/// How to avoid the clipping of samples of which the largest is `peak`.
std::string clippingAdvice(double peak, double gain, const std::optional<FeltSettings>& felt)
{
    if (felt)
        return fmt::format("--felt-full-scale {:.0f} avoids it", std::ceil(peak * felt->fullScale));
    return fmt::format("--gain {:.1f} avoids it", gain - std::ceil(200.0 * std::log10(peak)) / 10.0);
}

/// The option's value where it is not "auto".
template <typename T>
std::optional<T> chosen(const std::string& name, const std::map<std::string, T>& values)
{
    const auto found = values.find(name);
    return found == values.end() ? std::nullopt : std::optional<T>(found->second);
}
} // namespace

CLI::App* RenderCommand::declare(CLI::App& app)
{
    command = app.add_subcommand(
        "render", "Turn clips and scenes into drive signals, or into the acceleration of the skin (WAV)");
    command
        ->add_option("inputs", inputs,
                     "Clips (JSON or packed) and scenes (JSON), folders of them, or - for standard input")
        ->required()
        ->type_name("CLIP|SCENE");
    command
        ->add_option(
            "-o,--output", output,
            "Sound file (.wav or .flac) with a channel for each actuator, folder for several, or - for WAV on standard "
            "output [beside each input, as .haptic.wav]")
        ->type_name("OUT|DIR");
    command
        ->add_option("--profile", profile,
                     "Actuator profile: a file, or a shipped one such as l5-wristband; clips are fitted to it")
        ->type_name("PROFILE");
    command->add_option("--rate", rate, "Sample rate of the output, Hz")
        ->capture_default_str()
        ->check(numberFrom(limits::lowestRate, limits::highestRate));
    command->add_option("--encoding", encoding, "Samples of the output: float32, pcm24 or pcm16")
        ->capture_default_str()
        ->check(oneOf({"float32", "pcm24", "pcm16"}));
    command
        ->add_option("--gain", gain,
                     "Gain, dB; what would then exceed full drive (1), or a limit of the profile, is turned down while "
                     "it does")
        ->capture_default_str()
        ->check(numberFrom(-120.0, 60.0));
    command->add_option("--transpose", transpose, "Semitones up or down; time stays")
        ->capture_default_str()
        ->check(numberFrom(-96.0, 96.0))
        ->type_name("ST");
    command->add_option("--stretch", stretch, "Length factor; pitch stays")
        ->capture_default_str()
        ->check(numberFrom(0.01, 100.0))
        ->type_name("R");
    command->add_option("--delay", delay, "Silence before the start, s")
        ->capture_default_str()
        ->check(numberFrom(0.0, 3600.0));
    command->add_option("--from", from, "Start of the part to render, s; what came before is played unheard")
        ->capture_default_str()
        ->check(numberFrom(0.0, limits::duration, "24 h"))
        ->type_name("S");
    command->add_option("--to", to, "End of the part to render, s [the end]")
        ->check(numberFrom(0.0, limits::duration, "24 h"))
        ->type_name("S");
    command
        ->add_option("--variation", variation, "Random variation of the bands; in a scene, of the plays that have none")
        ->capture_default_str()
        ->check(numberFrom(0.0, 1.0))
        ->type_name("V");
    command->add_option("--variation-per", variationPer, "One random factor per breakpoint or per band")
        ->capture_default_str()
        ->check(oneOf({"breakpoint", "band"}));
    command->add_option("--seed", seed, "Seed of the variation")->capture_default_str()->check(countingNumber());
    command
        ->add_option("--carriers", carriers,
                     "Sinusoids at fixed centres, on the pitch curves, or moving with the centroid")
        ->capture_default_str()
        ->check(oneOf({"auto", "fixed", "pitch", "centroid"}));
    command->add_option("--envelope", envelope, "Level the sum of the bands to the total envelope")
        ->capture_default_str()
        ->check(oneOf({"auto", "on", "off"}));
    command->add_option("--pulse", pulse, "Waveform of events")
        ->capture_default_str()
        ->check(oneOf({"auto", "adaptive", "square", "sine"}));
    command
        ->add_option("--pulse-frequency", pulseFrequency,
                     "Frequency of square and sine pulses, Hz [the actuator's resonance]")
        ->check(numberFrom(1.0, 2000.0));
    command->add_option("--pulse-cycles", pulseCycles, "Periods of square and sine pulses")
        ->capture_default_str()
        ->check(numberFrom(0.1, 100.0));
    command->add_option("--clips", clipFolder, "Where the clip files of scenes are [beside the scene]")
        ->type_name("DIR");
    command
        ->add_option("--tolerance", tolerance,
                     "Largest error that everything left out may cause together, dB relative to the whole")
        ->capture_default_str()
        ->check(numberFrom(-300.0, 0.0))
        ->type_name("DB");
    auto* all = command->add_flag("--everything", everything, "Leave nothing out");
    command->get_option("--tolerance")->excludes(all);
    command->add_flag("--no-adapt", noAdaptation, "Play clips as they are, not fitted to the profile's actuator");
    command
        ->add_option("--mapping", mapping,
                     "Frequencies outside the actuator's range: as its profile says, to the nearest end, spread over "
                     "it, or by octaves into it")
        ->capture_default_str()
        ->check(oneOf({"profile", "clamp", "rescale", "fold"}));
    command
        ->add_option("--max-boost", maxBoost,
                     "How far the drive may be raised to flatten the actuator's resonance, dB; 0 leaves the resonance")
        ->capture_default_str()
        ->check(numberFrom(0.0, 40.0));
    command->add_flag("--no-protection", noProtection,
                      "Do not keep the drive within full drive and the profile's limits: samples beyond 1 are written "
                      "as they are, or clipped as PCM");
    auto* asFelt =
        command->add_flag("--felt", felt,
                          "Write the acceleration of the skin that the profile's body model predicts instead "
                          "of the drive signal");
    asFelt->needs(command->get_option("--profile"));
    command->add_option("--felt-full-scale", feltFullScale, "With --felt: acceleration at a sample of 1, m/s^2")
        ->capture_default_str()
        ->check(numberFrom(1e-3, 1e6))
        ->needs(asFelt)
        ->type_name("M_S2");
    command
        ->add_option("--wearer", wearer,
                     "With --felt: whose skin; 0 as in the profile, 1 to 14 simulated people whose skin has half to "
                     "twice its mass, stiffness and damping (assumed)")
        ->capture_default_str()
        ->check(wholeNumberFrom(0u, simulatedWearers))
        ->needs(asFelt)
        ->type_name("N");
    command->add_flag("--explain", explain, "Show what is played, and what is left out, why, and with what error");
    command->add_flag("--measured", measured,
                      "Like --explain, and also render everything, to measure the error of what is left out");
    command->add_flag("-f,--force", force, "Render also what is up to date");
    overwriting.declare(*command);
    command->add_flag("--dry-run", dryRun, "Only say what would be done with each file; write nothing");
    command->add_option("-j,--jobs", jobs, "Files to work on at a time [number of processors]")
        ->check(wholeNumberFrom(1u, 256u))
        ->type_name("N");
    command->footer("Examples:\n  pacini render door.pacb -o door.wav\n"
                    "  pacini render door.pacb -o door.wav --profile l5-wristband --encoding pcm24\n"
                    "  pacini render step.json -o step3.wav --variation 0.3 --seed 3\n"
                    "  pacini render hall.scene.json -o hall.wav --explain\n"
                    "  pacini render hall.scene.json -o part.wav --from 12.5 --to 20\n"
                    "  pacini render door.pacb -o skin.wav --profile l5-wristband --felt");
    return command;
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
    const std::vector<std::string> without = {"inputs",   "output", "profile", "clips",        "explain",
                                              "measured", "jobs",   "force",   "no-overwrite", "overwrite",
                                              "json",     "quiet",  "dry-run", "strict"};
    for (const CLI::Option* option : command->get_options())
        if (const auto name = option->get_single_name();
            option->count() > 0 && std::find(without.begin(), without.end(), name) == without.end())
            text += fmt::format(", {} {}", name, fmt::join(option->results(), " "));
    return text;
}

Exit RenderCommand::run(Console& console)
{
    if (to && *to <= from)
    {
        console.error("", {ErrorCode::invalidArgument, "render", "--from must be before --to"});
        return Exit::usage;
    }
    RenderSettings settings;
    settings.compile.sampleRate = std::round(rate);
    settings.compile.tolerance = tolerance;
    settings.compile.leaveOut = !everything;
    settings.compile.adapt = !noAdaptation;
    settings.compile.adaptation.mapping = chosen<FrequencyMapping>(
        mapping,
        {{"clamp", FrequencyMapping::clamp}, {"rescale", FrequencyMapping::rescale}, {"fold", FrequencyMapping::fold}});
    settings.compile.adaptation.maxBoost = Decibels(maxBoost);
    settings.protect = !noProtection;
    settings.transposition = transpose;
    settings.stretch = stretch;
    settings.gain = gain;
    settings.delay = delay;
    settings.variation = {variation, variationPer == "band" ? VariationScope::band : VariationScope::breakpoint, seed};
    DecoderChoice& decoder = settings.compile.decoder;
    decoder.carriers = chosen<CarrierMode>(
        carriers, {{"fixed", CarrierMode::fixed}, {"pitch", CarrierMode::pitch}, {"centroid", CarrierMode::centroid}});
    decoder.followEnvelope = chosen<bool>(envelope, {{"on", true}, {"off", false}});
    decoder.pulseShape = chosen<PulseShape>(
        pulse, {{"adaptive", PulseShape::adaptive}, {"square", PulseShape::square}, {"sine", PulseShape::sine}});
    if (pulseFrequency > 0.0)
        decoder.pulseFrequency = pulseFrequency;
    decoder.pulseCycles = pulseCycles;
    settings.from = from;
    settings.to = to;
    settings.dryRun = dryRun;
    settings.reading = {clipFolder, console.isStrict()};
    explain = explain || measured;
    settings.describe = explain || console.isJson();
    settings.measure = measured;
    settings.encoding = encoding == "pcm16"   ? SampleEncoding::pcm16
                        : encoding == "pcm24" ? SampleEncoding::pcm24
                                              : SampleEncoding::float32;
    if (!profile.empty())
    {
        settings.profile = openProfile(console, profile);
        if (!settings.profile)
            return Exit::failed;
    }
    if (felt)
    {
        const auto chosenFelt = feltSettings(*settings.profile, wearer, feltFullScale, programFolder());
        if (!chosenFelt)
        {
            console.error(profile, chosenFelt.error());
            return Exit::failed;
        }
        settings.felt = *chosenFelt;
    }

    settings.record = record();
    if (settings.profile)
        settings.record += ", " + profileJson(*settings.profile);
    settings.resume = !force && !explain;

    const InputFiles found = findClips();
    if (const auto fits = checkOutput(found, output, console.isJson()); !fits)
    {
        console.error("", fits.error());
        return Exit::usage;
    }
    if (isStandardOutput(output))
        console.keepStdoutFree();
    auto tasks =
        makeTasks<RenderResult>(found, {output, ".wav", felt ? ".felt.wav" : ".haptic.wav"}, overwriting, !dryRun);
    BatchEnd end;
    const auto nameOf = [&](std::size_t i)
    {
        return tasks[i].input.filename().string();
    };
    runTasks(console, tasks.size(), jobs, nameOf,
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
                     if (!task.result)
                         return;
                     if (!task.result->upToDate && !dryRun)
                         console.wrote(task.output, durationText(task.result->duration));
                     if (gain > 0.0 && task.result->reduction > noticed)
                         console.warning(task.input.string(),
                                         fmt::format("up to {:.1f} of the {:.1f} dB of --gain are taken away again "
                                                     "to keep within what the actuator bears",
                                                     std::min(task.result->reduction, gain), gain));
                     else if (task.result->clippedSamples > 0)
                         console.warning(task.input.string(),
                                         fmt::format("{} clipped; {}",
                                                     counted(task.result->clippedSamples, "sample was", "samples were"),
                                                     clippingAdvice(task.result->peak, gain, settings.felt)));
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
    return anyFailed(tasks) ? Exit::failed : Exit::ok;
}

} // namespace pacini::cli
