// Subcommand that plays a drive on a simulated wearer who tightens the strap, with dynamic compensation.

#include "cli/Command.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/measure/RigInput.h"
#include "io/AudioFile.h"
#include "io/Overwrite.h"

#include <pacini/actuator/DynamicCompensation.h>
#include <pacini/actuator/TighteningStrap.h>
#include <pacini/foundation/Gaussian.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

/// `pacini measure compensate`: shows what dynamic compensation does before it is wired to a sensor.
struct CompensateSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    /// What was driven, and what came back without and with compensation; interleaved, the latter of full scale
    /// `range`.
    [[nodiscard]] std::vector<float> play(const std::vector<float>& drive, double fs,
                                          const TighteningStrapParams& strap, DynamicCompensation& compensation,
                                          bool& clipped) const;

    std::string input, output, profile = "l5-wristband";
    int bands = DynamicCompensationParams{}.bands;
    double time = DynamicCompensationParams{}.time.value;
    double limit = DynamicCompensationParams{}.limit.value;
    double duration = 60.0, at = 20.0, tightness = 3.5, latency = 20.0, noise = 250.0, range = 5.0;
    std::optional<double> told, target;
    std::uint64_t seed = 1;
    OverwriteOptions overwriting;
};

/// RMS of the change over the range of the bands, dB; without compensation for none.
double changeOf(const TighteningStrapParams& strap, double low, double high, const DynamicCompensation* compensation)
{
    double sum = 0.0;
    constexpr int points = 120;
    for (int i = 0; i < points; ++i)
    {
        const double f = low * std::pow(high / low, (i + 0.5) / points);
        double change = strapLevel(strap, f, true) - strapLevel(strap, f, false);
        if (compensation)
            change += Decibels::fromGain(std::abs(compensation->response(Hertz(f)))).value;
        sum += change * change / points;
    }
    return std::sqrt(sum);
}

/// A table of the bands, which are added to `list` too.
std::string bandsText(const TighteningStrapParams& strap, const DynamicCompensation& compensation, Json& list)
{
    const auto frequencies = compensation.frequencies();
    std::string text = fmt::format("{:>9}  {:>10}  {:>9}\n", "Hz", "strap dB", "gain dB");
    for (std::size_t k = 0; k < frequencies.size(); ++k)
    {
        const double f = frequencies[k];
        const double change = strapLevel(strap, f, true) - strapLevel(strap, f, false);
        Json band{{"frequency", f}, {"change", change}, {"gain", compensation.gain(k)}};
        if (const auto level = compensation.measured(k))
            band["measured"] = *level;
        if (const auto level = compensation.reference(k))
            band["reference"] = *level;
        list.push_back(std::move(band));
        text += fmt::format("{:>9.1f}  {:>10}  {:>9}\n", f, signedText(change, 2),
                            compensation.measured(k) ? signedText(compensation.gain(k), 2) : "silent");
    }
    return text;
}
} // namespace

CLI::App* CompensateSubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand(
        "compensate", "Play a drive on a simulated wearer who tightens the strap, with dynamic compensation");
    addOption(*command, "drive", input, "Drive signal, such as a rendered clip; it is repeated", "DRIVE.wav")
        ->required();
    addOption(*command, "-o,--output", output,
              "Sound to write: the compensated drive, then the acceleration without and with compensation", "OUT.wav");
    addPreset(*command, "--profile", profile, "Actuator: a profile with a body model", "PROFILE");
    addPreset(*command, "--duration", duration, "Time to play, s", numberFrom(1.0, 3600.0), "S");
    addPreset(*command, "--at", at, "Time at which the strap is tightened, s", numberFrom(0.0, 3600.0), "S");
    addPreset(*command, "--tightness", tightness, "How many times as tight the strap becomes", numberFrom(0.1, 10.0),
              "N");
    addPreset(*command, "--bands", bands, "Bands that are followed", wholeNumberFrom(1, 24), "N");
    addPreset(*command, "--time", time, "Time constant of the correction, s", numberFrom(2.0, 600.0), "S");
    addPreset(*command, "--limit", limit, "Largest gain of a band, up or down, dB", numberFrom(0.0, 24.0), "DB");
    addOption(*command, "--target", target,
              "Level of the feedback at a drive of 1 to reach, dB re 1 m/s\u00b2 [what it is at the start]",
              numberFrom(-200.0, 200.0), "DB");
    addPreset(*command, "--latency", latency, "Delay from the drive to the feedback, ms", numberFrom(0.0, 1000.0),
              "MS");
    addOption(*command, "--delay", told, "Delay that the compensation is told, ms [that of --latency]",
              numberFrom(0.0, 1000.0), "MS");
    addPreset(*command, "--noise", noise, "Noise of the sensor, \u00b5g per root of Hz (ADXL325: 250)",
              numberFrom(0.0, 1e6), "D");
    addPreset(*command, "--range", range, "Acceleration at which the sensor clips, g", numberFrom(0.1, 10000.0), "G");
    addPreset(*command, "--seed", seed, "Seed of the noise", countingNumber(), "N");
    overwriting.declare(*command);
    return command->footer("Examples:\n  pacini measure compensate drive.wav\n"
                           "  pacini measure compensate drive.wav --tightness 5 --bands 24 -o strap.wav");
}

Exit CompensateSubcommand::run(Console& console)
{
    const auto opened = openRig(console, profile, input);
    if (!opened)
        return Exit::failed;
    const auto& [actuator, sound] = *opened;
    if (sound.samples.empty())
        return console.fail(input, {ErrorCode::invalidData, "", "has no frames"});
    if (!output.empty() && isSameFile(output, input))
        return console.fail(output, {ErrorCode::invalidArgument, "", "is the drive; name another output"}, Exit::usage);

    if (overwriting.keeps(console, {output}))
        return Exit::ok;
    constexpr double mostFrames = 4e7; // three channels of them are half a gigabyte
    if (!output.empty() && duration * sound.sampleRate > mostFrames)
        return console.fail(output,
                            {ErrorCode::tooLarge, "--duration",
                             fmt::format("is too long to write at {} Hz; at most {:.0f} s", sound.sampleRate,
                                         std::floor(mostFrames / sound.sampleRate))},
                            Exit::usage);

    TighteningStrapParams strap;
    strap.loose = *actuator.body;
    strap.tight = tightened(*actuator.body, tightness);
    strap.resonance = strap.tightResonance = actuator.resonance;
    strap.start = at;
    DynamicCompensationParams params;
    params.bands = bands;
    params.time = Seconds(time);
    params.limit = Decibels(limit);
    params.delay = Seconds(1e-3 * told.value_or(latency));
    params.lowFrequency = Hertz(std::max(10.0, actuator.range.lowFrequency));
    params.highFrequency = Hertz(actuator.range.highFrequency);
    if (target)
        params.target = Decibels(*target);
    const double fs = sound.sampleRate;
    DynamicCompensation compensation;
    compensation.setParams(params);
    compensation.prepare({fs, 64});
    bool clipped = false;
    const auto interleaved = play(sound.samples, fs, strap, compensation, clipped);

    const auto frequencies = compensation.frequencies();
    const double before = changeOf(strap, frequencies.front(), frequencies.back(), nullptr);
    const double after = changeOf(strap, frequencies.front(), frequencies.back(), &compensation);
    Json list = Json::array();
    std::string text = bandsText(strap, compensation, list);
    text += fmt::format("changes by {:.2f} dB RMS under the strap, with compensation by {:.2f} dB", before, after);
    if (!output.empty())
    {
        AudioWriteParams writing;
        writing.sampleRate = sound.sampleRate;
        writing.channels = 3;
        writing.encoding = SampleEncoding::pcm24;
        if (const auto written = writeAudio(output, interleaved, writing); !written)
            return console.fail(output, written.error());
        console.wrote(output);
    }
    console.addToReport({{"input", input},
                         {"output", output},
                         {"bands", std::move(list)},
                         {"change", before},
                         {"compensated", after},
                         {"fullScale", range * standardGravity}});
    if (clipped)
        console.warning(input, fmt::format("the sensor of {:g} g clips; render at a lower level, or take a sensor of a "
                                           "wider --range",
                                           range));
    console.print(text);
    return Exit::ok;
}

std::vector<float> CompensateSubcommand::play(const std::vector<float>& drive, double fs,
                                              const TighteningStrapParams& strap, DynamicCompensation& compensation,
                                              bool& clipped) const
{
    constexpr std::size_t block = 64;
    TighteningStrap with, without;
    for (TighteningStrap* one : {&with, &without})
    {
        one->setParams(strap);
        one->prepare({fs, block});
    }
    const double full = range * standardGravity;
    const double deviation = noise * 1e-6 * standardGravity * std::sqrt(fs / 2.0);
    Gaussian gaussian(seed);
    // A block is the least that a loop is late by.
    std::vector<float> line(std::max<std::size_t>(block, static_cast<std::size_t>(std::llround(1e-3 * latency * fs))));
    std::size_t place = 0;
    const auto frames = static_cast<std::size_t>(duration * fs);
    std::vector<float> interleaved;
    if (!output.empty())
        interleaved.reserve(3 * frames);
    std::vector<float> x(block), y(block), felt(block), plain(block), back(block);
    for (std::size_t n = 0; n < frames; n += block)
    {
        for (std::size_t i = 0; i < block; ++i)
        {
            x[i] = drive[(n + i) % drive.size()];
            back[i] = line[(place + i) % line.size()];
        }
        compensation.process(x, back, y);
        with.process(y, felt);
        without.process(x, plain);
        for (std::size_t i = 0; i < block; ++i)
        {
            const double noisy = static_cast<double>(felt[i]) + deviation * gaussian.next();
            clipped = clipped || std::abs(noisy) > full;
            line[place] = static_cast<float>(std::clamp(noisy, -full, full));
            place = (place + 1) % line.size();
        }
        for (std::size_t i = 0; i < std::min(block, frames - n) && !output.empty(); ++i)
            for (const double sample :
                 {static_cast<double>(y[i]), static_cast<double>(plain[i]) / full, static_cast<double>(felt[i]) / full})
                interleaved.push_back(static_cast<float>(std::clamp(sample, -1.0, 1.0)));
    }
    return interleaved;
}

std::unique_ptr<Command> compensateSubcommand()
{
    return std::make_unique<CompensateSubcommand>();
}

} // namespace pacini::cli
