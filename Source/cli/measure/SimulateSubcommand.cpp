// Subcommand that simulates the recording of a sweep.

#include "cli/Command.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/measure/RigInput.h"
#include "io/AtomicFile.h"
#include "io/AudioFile.h"
#include "io/Fingerprint.h"

#include <pacini/linearize/RigSettings.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
/// rec.wav for wearer 3 of 14 is rec-03.wav.
std::string numbered(const std::string& output, unsigned wearer)
{
    std::filesystem::path path(output);
    const auto extension = path.extension().string();
    path.replace_filename(fmt::format("{}-{:02}{}", path.stem().string(), wearer, extension));
    return path.string();
}

/// A converter at its end stays there.
bool clips(const std::vector<float>& channel)
{
    return std::any_of(channel.begin(), channel.end(), [](float v) { return std::abs(v) >= 1.0f; });
}

/// `pacini measure simulate`: simulates the recording of an accelerometer on a worn actuator, for learning and tests.
struct SimulateSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    Exit record(Console& console) const;

    std::string input, output, profile = "l5-wristband";
    unsigned wearer = 0, wearers = 0;
    RigSettings settings;
    double latency = 1e3 * settings.latency; ///< ms
    OverwriteOptions overwriting;
};
} // namespace

CLI::App* SimulateSubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("simulate", "Record a sweep without hardware, on a simulated wearer");
    addOption(*command, "sweep", input, "Sound of the sweep", "SWEEP.wav")->required();
    addOption(*command, "-o,--output", output,
              "Recording to write, with one channel for each axis of the accelerometer", "OUT.wav")
        ->required();
    addPreset(*command, "--profile", profile, "Actuator: a profile with a body model; its equaliser is not applied",
              "PROFILE");
    auto* one = addOption(*command, "--wearer", wearer,
                          "Wearer 1 to 14, each with different skin; 0 has the skin of the profile",
                          wholeNumberFrom(0u, simulatedWearers), "N");
    addOption(*command, "--wearers", wearers,
              "Record wearers 1 to N into separate files: OUT-01.wav, OUT-02.wav and so on",
              wholeNumberFrom(1u, simulatedWearers), "N")
        ->excludes(one);
    addOption(*command, "--mass", settings.mass, "Mass that is attached to the device, g", numberFrom(0.0, 5000.0),
              "G");
    addOption(*command, "--contact", settings.contact, "Level of a loose or a tight fit, dB", numberFrom(-60.0, 20.0),
              "DB");
    addPreset(*command, "--latency", latency, "Latency of player and recorder together, ms", numberFrom(0.0, 1000.0),
              "MS");
    addPreset(*command, "--drift", settings.drift,
              "Deviation of the recorder's clock from the player's, ppm; positive is faster",
              numberFrom(-5000.0, 5000.0), "PPM");
    addPreset(*command, "--noise", settings.noise, "Noise of the sensor, \u00b5g per root of Hz (ADXL325: 250)",
              numberFrom(0.0, 1e6), "D");
    addPreset(*command, "--range", settings.range,
              "Acceleration at which the sensor clips, gravity included, g (ADXL325: 5)", numberFrom(0.1, 10000.0),
              "G");
    addPreset(*command, "--axes", settings.axes,
              "Axes of the sensor: 3, with a random orientation on every wearer, or 1, along the movement",
              oneOf({"1", "3"}), "N");
    addPreset(*command, "--bits", settings.bits, "Resolution of the converter", wholeNumberFrom(4, 24), "N");
    addOption(*command, "--distortion", settings.distortion,
              "Third-order distortion of the actuator: factor of the cube of the drive", numberFrom(-1.0, 1.0), "A");
    addPreset(*command, "--seed", settings.seed, "Seed of the noise and of the sensor's orientation", countingNumber(),
              "N");
    overwriting.declare(*command);
    return command->footer("Examples:\n  pacini measure simulate sweep.wav -o rec.wav\n"
                           "  pacini measure simulate sweep.wav -o rec.wav --wearers 14      fourteen recordings");
}

Exit SimulateSubcommand::run(Console& console)
{
    if (wearers > 0 && isStream(output))
        return console.fail(
            output,
            {ErrorCode::invalidArgument, "", "takes one file, but --wearers makes one for each; name a file with -o"},
            Exit::usage);
    return record(console);
}

Exit SimulateSubcommand::record(Console& console) const
{
    const auto opened = openRig(console, profile, input);
    if (!opened)
        return Exit::failed;
    const auto& [actuator, sound] = *opened;

    RigSettings given = settings;
    given.latency = 1e-3 * latency;
    std::vector<std::string> clipped;
    const unsigned first = wearers > 0 ? 1 : wearer;
    const unsigned last = wearers > 0 ? wearers : wearer;
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (unsigned who = first; who <= last; ++who)
    {
        const std::string target = wearers > 0 ? numbered(output, who) : output;
        if (sameFileKey(target) == sameFileKey(input))
            return console.fail(input, {ErrorCode::invalidArgument, "", "would be overwritten by its own recording"});
        if (overwriting.keepsAll() && isOccupied(target))
            continue;
        const FileOrigin origin = originOf(input, target, Fingerprint().text());
        const auto existing = mayReplace(target, origin, overwriting.of(wearers == 0));
        if (!existing)
            return console.fail(input, existing.error());
        const RigParams rig = rigOn(who, actuator, given, sound.sampleRate);
        console.progress(static_cast<double>(who - first) / static_cast<double>(last - first + 1), target);
        const auto channels = recordOnRig(sound.samples, rig);
        if (std::any_of(channels.begin(), channels.end(), clips))
            clipped.push_back(target);
        std::vector<float> interleaved(channels.size() * channels.front().size());
        for (std::size_t c = 0; c < channels.size(); ++c)
            for (std::size_t i = 0; i < channels[c].size(); ++i)
                interleaved[i * channels.size() + c] = channels[c][i];
        AudioWriteParams writing;
        writing.sampleRate = sound.sampleRate;
        writing.channels = static_cast<int>(channels.size());
        writing.encoding = SampleEncoding::pcm24;
        if (wearers > 0)
            writing.origin = origin;
        writing.existing = *existing;
        if (const auto written = writeAudio(target, interleaved, writing); !written)
            return console.fail(target, written.error());
        console.wrote(target);
        files.push_back({{"input", input}, {"output", target}, {"wearer", who}});
    }
    console.endProgress();
    console.addToReport({{"files", files}, {"fullScale", settings.range * standardGravity}});
    if (!clipped.empty())
        console.warning(
            clipped.size() == 1 ? clipped.front() : fmt::format("{} and {} more", clipped.front(), clipped.size() - 1),
            fmt::format("the sensor of {:g} g clips; play the sweep at a lower level, or take a sensor of a "
                        "wider --range",
                        settings.range));
    console.note(fmt::format("analyse with --full-scale {:g}g", settings.range));
    return Exit::ok;
}

std::unique_ptr<Command> simulateSubcommand()
{
    return std::make_unique<SimulateSubcommand>();
}

} // namespace pacini::cli
