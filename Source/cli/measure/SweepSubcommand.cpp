#include "cli/measure/SweepSubcommand.h"

#include "cli/Checks.h"
#include "cli/InputFiles.h"
#include "cli/ProfileInput.h"
#include "cli/measure/SweepNames.h"
#include "io/AudioWriter.h"
#include "io/Fingerprint.h"
#include "io/SweepFile.h"

#include <pacini/linearize/EqualizedSweep.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pacini::cli
{

CLI::App* SweepSubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("sweep", "Make the sound that an actuator is measured with");
    outputOption =
        command
            ->add_option("-o,--output", output,
                         "Sound to play (.wav or .flac); its description goes beside it, as .json of the same name")
            ->capture_default_str()
            ->type_name("OUT");
    command
        ->add_option(
            "--low", low,
            "Frequency at which sweeps start, Hz [10; through an equaliser a little below the profile's range]")
        ->type_name("HZ");
    command->add_option("--high", high, "Frequency at which sweeps end, Hz")->capture_default_str()->type_name("HZ");
    command
        ->add_option("--duration", duration, "Length of a sweep, s; twice as long gives 3 dB more distance from noise")
        ->capture_default_str()
        ->type_name("S");
    command->add_option("--pause", pause, "Silence between sweeps, s; longer than the actuator rings")
        ->capture_default_str()
        ->type_name("S");
    command->add_option("--repeats", repeats, "How often each level is played")
        ->capture_default_str()
        ->check(wholeNumberFrom(1, 100))
        ->type_name("N");
    command
        ->add_option("--levels", levels,
                     "Peaks of the sweeps, dB re full scale, such as -24,-12,-6: several show where "
                     "distortion begins; a sweep that an equaliser raises beyond full scale is lowered")
        ->delimiter(',')
        ->capture_default_str()
        ->type_name("DB,...");
    command->add_option("--rate", rate, "Sample rate, Hz")
        ->capture_default_str()
        ->check(wholeNumberFrom(2000, 384000))
        ->type_name("HZ");
    command->add_option("--profile", profile, "Play through the equaliser of this profile, to verify it")
        ->type_name("PROFILE");
    overwriting.declare(*command);
    command->footer("Examples:\n  pacini measure sweep -o sweep.wav\n"
                    "  pacini measure sweep -o sweep.wav --levels -24,-12,-6      shows where distortion begins\n"
                    "  pacini measure sweep -o flat.wav --profile mine.json       for 'pacini measure verify'");
    return command;
}

Exit SweepSubcommand::run(Console& console)
{
    const auto fail = [&](const std::string& file, const Error& error, Exit exit = Exit::failed)
    {
        console.error(file, error);
        return exit;
    };
    SweepFile file;
    SweepParams& params = file.sweep;
    params.lowFrequency = low.value_or(params.lowFrequency);
    params.highFrequency = high;
    params.duration = duration;
    params.fadeIn = std::min(params.fadeIn, 0.25 * duration);
    params.pause = pause;
    params.repeats = repeats;
    params.levels = levels;
    params.sampleRate = rate;
    if (auto valid = validate(params); !valid)
    {
        Error error = valid.error();
        error.where = optionFor(error.where);
        return fail("", error, Exit::usage);
    }
    const std::string description = sweepFileBeside(output).string();
    if (sameFileKey(description) == sameFileKey(output))
        return fail(output, {ErrorCode::invalidArgument, "", "must be .wav or .flac"}, Exit::usage);
    if (overwriting.keepsAll() && (isOccupied(output) || isOccupied(description)))
    {
        console.note(fmt::format("{} or {} exists and was left", printable(output), printable(description)));
        return Exit::ok;
    }
    const FileOrigin origin = originOf(description, output, Fingerprint().text());
    const bool named = outputOption->count() > 0;
    const auto existing = mayReplace(output, origin, overwriting.of(named));
    if (!existing)
        return fail("", existing.error());
    if (isOccupied(description) && !overwriting.replacesAll() && !readSweepFile(description))
        return fail("", notReplaced(description, "exists and does not describe a sweep"));
    EqualizerSections sections;
    if (!profile.empty())
    {
        const auto actuator = openProfile(console, profile);
        if (!actuator)
            return Exit::failed;
        if (actuator->equalizer.empty())
            return fail(profile, {ErrorCode::invalidData, "equalizer",
                                  "is empty, so there is nothing to verify; 'pacini measure fit' finds one"});
        sections = actuator->equalizer;
        if (!low)
            params.lowFrequency =
                provingLowFrequency(params.lowFrequency, params.highFrequency, actuator->range.lowFrequency);
        file.equalizedFor = actuator->name;
    }
    const auto played = makeEqualizedSweep(params, sections, true);
    if (!played)
    {
        Error error = played.error();
        error.where = optionFor(error.where);
        return fail(profile, error);
    }
    const std::vector<float>& signal = played->signal;
    params = played->sweep;
    file.gain = played->gain;

    AudioWriteParams writing;
    writing.sampleRate = rate;
    writing.encoding = SampleEncoding::pcm24;
    writing.expectedFrames = signal.size();
    if (!named)
        writing.origin = origin;
    writing.existing = *existing;
    const auto written = writeAudio(output, signal, writing);
    if (!written)
        return fail(output, written.error());
    if (const auto described = writeSweepFile(description, file); !described)
        return fail(description, described.error());

    const double seconds = static_cast<double>(signal.size()) / params.sampleRate;
    const std::size_t sweeps = levels.size() * static_cast<std::size_t>(repeats);
    console.addToReport({{"output", output},
                         {"sweep", description},
                         {"duration", seconds},
                         {"sampleRate", rate},
                         {"sweeps", sweeps},
                         {"levels", params.levels},
                         {"lowered", played->lowered},
                         {"gain", played->gain},
                         {"equalizedFor", file.equalizedFor}});
    std::string through;
    if (!file.equalizedFor.empty())
        through = fmt::format(" through the equaliser of '{}'", printable(file.equalizedFor));
    if (played->lowered > 0.0)
        through += fmt::format(", {:g} dB lower ({:g} dB) so that what the equaliser raises fits", played->lowered,
                               fmt::join(params.levels, ", "));
    if (played->gain > 0.0)
        through += fmt::format(", {:.1f} dB louder than that alone leaves it", played->gain);

    console.wrote(output, fmt::format("{} sweep{} from {:.4g} to {:g} Hz{}, {} in all", sweeps, sweeps == 1 ? "" : "s",
                                      params.lowFrequency, params.highFrequency, through, durationText(seconds)));
    console.wrote(description, "keep it for the analysis");
    return Exit::ok;
}

} // namespace pacini::cli
