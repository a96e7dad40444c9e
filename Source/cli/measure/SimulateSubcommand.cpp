#include "cli/measure/SimulateSubcommand.h"

#include "cli/Checks.h"
#include "cli/InputFiles.h"
#include "cli/ProfileInput.h"
#include "io/AudioFile.h"
#include "io/Fingerprint.h"

#include <pacini/actuator/Wearer.h>
#include <pacini/linearize/SimulatedRig.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
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
} // namespace

CLI::App* SimulateSubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("simulate", "Record a sweep without hardware, on a simulated wearer");
    command->add_option("sweep", input, "Sound of the sweep")->required()->type_name("SWEEP.wav");
    command->add_option("-o,--output", output, "Recording to write: a channel for each axis of the accelerometer")
        ->required()
        ->type_name("OUT.wav");
    command->add_option("--profile", profile, "Actuator, a profile with a body; its equaliser is not applied")
        ->capture_default_str()
        ->type_name("PROFILE");
    command->add_option("--wearer", wearer, "Wearer 1 to 14, each with a skin of its own; 0 is the profile's")
        ->check(wholeNumberFrom(0u, simulatedWearers))
        ->type_name("N");
    command
        ->add_option("--wearers", wearers,
                     "Record wearers 1 to N into files of their own: OUT-01.wav, OUT-02.wav and so on")
        ->check(wholeNumberFrom(1u, simulatedWearers))
        ->type_name("N");
    command->add_option("--contact", contact, "Level of a loose or a tight fit, dB")
        ->check(numberFrom(-60.0, 20.0))
        ->type_name("DB");
    command->add_option("--latency", latency, "Latency of player and recorder, ms")
        ->capture_default_str()
        ->check(numberFrom(0.0, 1000.0))
        ->type_name("MS");
    command->add_option("--drift", drift, "How much faster the recorder's clock is, ppm")
        ->capture_default_str()
        ->check(numberFrom(-5000.0, 5000.0))
        ->type_name("PPM");
    command->add_option("--noise", noise, "Noise of the sensor, \u00b5g per root of Hz (ADXL325: 250)")
        ->capture_default_str()
        ->check(numberFrom(0.0, 1e6))
        ->type_name("D");
    command->add_option("--range", range, "Acceleration at which the sensor clips, gravity included, g (ADXL325: 5)")
        ->capture_default_str()
        ->check(numberFrom(0.1, 10000.0))
        ->type_name("G");
    command
        ->add_option("--axes", axes,
                     "Axes of the sensor: 3, turned at random on every wearer, or 1, along the movement")
        ->capture_default_str()
        ->check(oneOf({"1", "3"}))
        ->type_name("N");
    command->add_option("--bits", bits, "Resolution of the converter")
        ->capture_default_str()
        ->check(wholeNumberFrom(4, 24))
        ->type_name("N");
    command->add_option("--distortion", distortion, "Third-order distortion of the actuator: part of the drive's cube")
        ->check(numberFrom(-1.0, 1.0))
        ->type_name("A");
    command->add_option("--seed", seed, "Seed of the noise and of the sensor's orientation")
        ->capture_default_str()
        ->check(countingNumber())
        ->type_name("N");
    overwriting.declare(*command);
    command->footer("Examples:\n  pacini measure simulate sweep.wav -o rec.wav\n"
                    "  pacini measure simulate sweep.wav -o rec.wav --wearers 14      fourteen recordings");
    return command;
}

Exit SimulateSubcommand::run(Console& console)
{
    const auto fail = [&](const std::string& file, const Error& error)
    {
        console.endProgress();
        console.error(file, error);
        return Exit::failed;
    };
    const auto actuator = openProfile(console, profile);
    if (!actuator)
        return Exit::failed;
    if (!actuator->body || actuator->technology == Technology::erm)
        return fail(profile, {ErrorCode::invalidData, actuator->body ? "technology" : "body",
                              actuator->body ? "is a motor, which plays no sweep" : "is missing, so nothing can move"});
    AudioReadOptions options;
    options.lowestSampleRate = limits::lowestWrittenRate;
    const auto sound = readAudio(input, options);
    if (!sound)
        return fail(input, sound.error());
    if (sound->channels != 1)
        return fail(input, {ErrorCode::invalidData, "", "must have one channel"});

    std::vector<std::string> clipped;
    const unsigned first = wearers > 0 ? 1 : wearer;
    const unsigned last = wearers > 0 ? wearers : wearer;
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (unsigned who = first; who <= last; ++who)
    {
        const std::string target = wearers > 0 ? numbered(output, who) : output;
        if (sameFileKey(target) == sameFileKey(input))
            return fail(input, {ErrorCode::invalidArgument, "", "would be overwritten by its own recording"});
        if (overwriting.keepsAll() && isOccupied(target))
            continue;
        const FileOrigin origin = originOf(input, target, Fingerprint().text());
        const auto existing = mayReplace(target, origin, overwriting.of(wearers == 0));
        if (!existing)
            return fail(input, existing.error());
        RigParams rig;
        rig.body = bodyOn(who, *actuator->body);
        rig.resonance = actuator->resonance;
        rig.contact = contact;
        rig.polynomial = {0.0, 1.0, 0.0, distortion};
        rig.range = range * standardGravity;
        rig.axes = static_cast<std::size_t>(axes);
        rig.noiseDensity = noise * 1e-6 * standardGravity;
        rig.bits = bits;
        rig.latency = 1e-3 * latency;
        rig.driftPpm = drift;
        rig.seed = seed + who;
        rig.sampleRate = sound->sampleRate;
        console.progress(static_cast<double>(who - first) / static_cast<double>(last - first + 1), target);
        const auto channels = recordOnRig(sound->samples, rig);
        if (std::any_of(channels.begin(), channels.end(), clips))
            clipped.push_back(target);
        std::vector<float> interleaved(channels.size() * channels.front().size());
        for (std::size_t c = 0; c < channels.size(); ++c)
            for (std::size_t i = 0; i < channels[c].size(); ++i)
                interleaved[i * channels.size() + c] = channels[c][i];
        AudioWriteParams writing;
        writing.sampleRate = sound->sampleRate;
        writing.channels = static_cast<int>(channels.size());
        writing.encoding = SampleEncoding::pcm24;
        if (wearers > 0)
            writing.origin = origin;
        writing.existing = *existing;
        if (const auto written = writeAudio(target, interleaved, writing); !written)
            return fail(target, written.error());
        console.wrote(target);
        files.push_back({{"input", input}, {"output", target}, {"wearer", who}});
    }
    console.endProgress();
    console.addToReport({{"files", files}, {"fullScale", range * standardGravity}});
    if (!clipped.empty())
        console.warning(
            clipped.size() == 1 ? clipped.front() : fmt::format("{} and {} more", clipped.front(), clipped.size() - 1),
            fmt::format("the sensor of {:g} g clips; play the sweep at a lower level, or take a sensor of a "
                        "wider --range",
                        range));
    console.note(fmt::format("analyse with --full-scale {:g}g", range));
    return Exit::ok;
}

} // namespace pacini::cli
