// Subcommand that writes a measurement sweep.

#include "cli/Command.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/ProfileInput.h"
#include "cli/measure/SweepNames.h"
#include "io/AtomicFile.h"
#include "io/AudioWriter.h"
#include "io/Fingerprint.h"
#include "io/SweepFile.h"

#include <pacini/linearize/EqualizedSweep.h>
#include <pacini/linearize/Sweep.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
/// `pacini measure sweep`: writes the sweep to play on an actuator, and its description.
struct SweepSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    CLI::Option* outputOption = nullptr;
    std::string output = "sweep.wav";
    std::string profile;
    std::optional<double> low;
    double high = 1500.0;
    double duration = 20.0;
    double pause = 1.0;
    int repeats = 1;
    std::vector<double> levels = SweepParams().levels;
    int rate = 48000;
    OverwriteOptions overwriting;

    [[nodiscard]] SweepParams params() const;

    /// Reads the equaliser that the sweep goes through, and begins the sweep where it can be verified. False: what is
    /// wrong has been said.
    bool readEqualizer(Console& console, SweepFile& file, EqualizerSections& sections) const;
    void tell(Console& console, const SweepFile& file, const EqualizedSweep& played) const;
};
} // namespace

CLI::App* SweepSubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("sweep", "Make the sweep for measuring an actuator");
    outputOption = addPreset(
        *command, "-o,--output", output,
        "Sound to write (.wav or .flac); its description is written beside it, as .json of the same name", "OUT");
    addOption(*command, "--low", low,
              "Start frequency of the sweeps, Hz [10; through an equaliser a little below the profile's range]", "HZ");
    addPreset(*command, "--high", high, "End frequency of the sweeps, Hz", "HZ");
    addPreset(*command, "--duration", duration,
              "Length of a sweep, s; doubling it improves the signal-to-noise ratio by 3 dB", "S");
    addPreset(*command, "--pause", pause, "Silence between sweeps, s; must be longer than the decay of the actuator",
              "S");
    addPreset(*command, "--repeats", repeats, "Number of sweeps at each level", wholeNumberFrom(1, 100), "N");
    addPreset(*command, "--levels", levels,
              "Peak levels of the sweeps, dB re full scale, such as -24,-12,-6. Several levels show the onset of "
              "distortion. A sweep that an equaliser raises beyond full scale is lowered",
              "DB,...")
        ->delimiter(',');
    addPreset(*command, "--rate", rate, "Sample rate, Hz", wholeNumberFrom(2000, 384000), "HZ");
    addOption(*command, "--profile", profile, "Apply the equaliser of this profile, to verify it", "PROFILE");
    overwriting.declare(*command);
    return command->footer(
        "Examples:\n  pacini measure sweep -o sweep.wav\n"
        "  pacini measure sweep -o sweep.wav --levels -24,-12,-6      shows the onset of distortion\n"
        "  pacini measure sweep -o flat.wav --profile mine.json       for 'pacini measure verify'");
}

SweepParams SweepSubcommand::params() const
{
    SweepParams params;
    params.lowFrequency = low.value_or(params.lowFrequency);
    params.highFrequency = high;
    params.duration = duration;
    params.fadeIn = std::min(params.fadeIn, 0.25 * duration);
    params.pause = pause;
    params.repeats = repeats;
    params.levels = levels;
    params.sampleRate = rate;
    return params;
}

bool SweepSubcommand::readEqualizer(Console& console, SweepFile& file, EqualizerSections& sections) const
{
    const auto actuator = openProfile(console, profile);
    if (!actuator)
        return false;
    if (actuator->equalizer.empty())
    {
        console.error(profile, {ErrorCode::invalidData, "equalizer",
                                "is empty, so there is nothing to verify; fit one with 'pacini measure fit'"});
        return false;
    }
    sections = actuator->equalizer;
    if (!low)
        file.sweep.lowFrequency =
            provingLowFrequency(file.sweep.lowFrequency, file.sweep.highFrequency, actuator->range.lowFrequency);
    file.equalizedFor = actuator->name;
    return true;
}

void SweepSubcommand::tell(Console& console, const SweepFile& file, const EqualizedSweep& played) const
{
    const double seconds = static_cast<double>(played.signal.size()) / file.sweep.sampleRate;
    const std::size_t sweeps = levels.size() * static_cast<std::size_t>(repeats);
    console.addToReport({{"output", output},
                         {"sweep", sweepFileBeside(output).string()},
                         {"duration", seconds},
                         {"sampleRate", rate},
                         {"sweeps", sweeps},
                         {"levels", file.sweep.levels},
                         {"lowered", played.lowered},
                         {"gain", played.gain},
                         {"equalizedFor", file.equalizedFor}});
    std::string through;
    if (!file.equalizedFor.empty())
        through = fmt::format(" through the equaliser of '{}'", printable(file.equalizedFor));
    if (played.lowered > 0.0)
        through += fmt::format(", {:g} dB lower ({:g} dB) to leave headroom for the equaliser", played.lowered,
                               fmt::join(file.sweep.levels, ", "));
    if (played.gain > 0.0)
        through += fmt::format(", {:.1f} dB louder than that alone leaves it", played.gain);

    console.wrote(output,
                  fmt::format("{} sweep{} from {:.4g} to {:g} Hz{}, {} in all", sweeps, sweeps == 1 ? "" : "s",
                              file.sweep.lowFrequency, file.sweep.highFrequency, through, durationText(seconds)));
    console.wrote(sweepFileBeside(output), "keep it for the analysis");
}

Exit SweepSubcommand::run(Console& console)
{
    SweepFile file;
    file.sweep = params();
    if (auto valid = validate(file.sweep); !valid)
    {
        Error error = valid.error();
        error.where = optionFor(error.where);
        return console.fail("", error, Exit::usage);
    }
    if (isStream(output))
        return console.fail(output,
                            {ErrorCode::invalidArgument, "",
                             "takes one file, but a sweep is a sound and its description; name a file with -o"},
                            Exit::usage);
    const std::string description = sweepFileBeside(output).string();
    if (sameFileKey(description) == sameFileKey(output))
        return console.fail(output, {ErrorCode::invalidArgument, "", "must have the extension .wav or .flac"},
                            Exit::usage);
    if (overwriting.keepsAll() && (isOccupied(output) || isOccupied(description)))
    {
        console.note(fmt::format("{} or {} exists and was kept", printable(output), printable(description)));
        return Exit::ok;
    }
    const FileOrigin origin = originOf(description, output, Fingerprint().text());
    const bool named = outputOption->count() > 0;
    const auto existing = mayReplace(output, origin, overwriting.of(named));
    if (!existing)
        return console.fail("", existing.error());
    if (isOccupied(description) && !overwriting.replacesAll() && !readSweepFile(description))
        return console.fail(
            "", notReplaced(description, "exists and is not the description of a sweep; name another output"));
    EqualizerSections sections;
    if (!profile.empty() && !readEqualizer(console, file, sections))
        return Exit::failed;
    const auto played = makeEqualizedSweep(file.sweep, sections, true);
    if (!played)
    {
        Error error = played.error();
        error.where = optionFor(error.where);
        return console.fail(profile, error);
    }
    file.sweep = played->sweep;
    file.gain = played->gain;

    AudioWriteParams writing;
    writing.sampleRate = rate;
    writing.encoding = SampleEncoding::pcm24;
    writing.expectedFrames = played->signal.size();
    if (!named)
        writing.origin = origin;
    writing.existing = *existing;
    const auto written = writeAudio(output, played->signal, writing);
    if (!written)
        return console.fail(output, written.error());
    if (const auto described = writeSweepFile(description, file); !described)
        return console.fail(description, described.error());
    tell(console, file, *played);
    return Exit::ok;
}

std::unique_ptr<Command> sweepSubcommand()
{
    return std::make_unique<SweepSubcommand>();
}

} // namespace pacini::cli
