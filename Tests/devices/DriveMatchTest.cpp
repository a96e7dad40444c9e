// Whatever plays a clip plays the drive that `pacini render` makes: the level that each kind of device is sent follows
// the level of the drive. The level of motors is the one that the bytes of a report mean by the motor's curve.
//
// pacini_tests "[devices-table]" prints the table of Resources/docs/devices.md.

#include "devices/ClipRumble.h"
#include "devices/DecodeReport.h"
#include "devices/InstantClock.h"
#include "devices/Levels.h"
#include "devices/RumblePlayback.h"
#include "devices/WaveformDevice.h"
#include "io/AudioReader.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/ReportList.h"

#include <pacini/analysis/Encoder.h>
#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/foundation/NumberText.h>
#include <pacini/synthesis/RenderScene.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::devices;
using namespace pacini::test;

namespace
{
constexpr double step = 0.001; // s, of levels

// The demo sounds as they are encoded.
std::vector<Clip> demoClips()
{
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() / "Resources/demo"))
        if (entry.path().extension() == ".flac")
            paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<Clip> clips;
    for (const auto& path : paths)
    {
        const auto audio = readAudio(path);
        REQUIRE(audio);
        Encoder encoder{EncoderParams{}};
        encoder.start(audio->sampleRate, audio->channels);
        encoder.push(audio->samples);
        clips.push_back(encoder.finish());
        clips.back().name = path.stem().string();
    }
    return clips;
}

// As a designer edits the intensity of the whole.
Clip withEnvelope(Clip clip)
{
    clip.name += ", edited envelope";
    clip.transients.clear();
    clip.envelope = {{0.0, 0.6}, {0.4 * clip.duration, 0.05}, {0.7 * clip.duration, 0.4}, {clip.duration, 0.02}};
    return clip;
}

Clip onlyNoise(const Clip& clip)
{
    Clip noise;
    noise.name = clip.name + ", noise alone";
    noise.duration = clip.duration;
    noise.noise.push_back({80.0, 300.0, {}});
    double loudest = 0.0;
    for (const Breakpoint& point : clip.envelope)
        loudest = std::max(loudest, point.value);
    for (const Breakpoint& point : clip.envelope)
        noise.noise[0].amplitude.push_back({point.time, 0.4 * point.value / std::max(loudest, 1e-9)});
    return noise;
}

Clip transposed(Clip clip)
{
    clip.name += ", transposed";
    for (Band& band : clip.bands)
    {
        for (double* frequency : {&band.lowFrequency, &band.centreFrequency, &band.highFrequency})
            *frequency *= 1.5;
        for (Breakpoint& point : band.pitch)
            point.value *= 1.5;
    }
    return clip;
}

std::vector<Clip> fortyClips()
{
    std::vector<Clip> all;
    for (const Clip& clip : demoClips())
    {
        Clip longer = stretchClip(clip, 1.7).value();
        longer.name += ", stretched";
        for (const Clip& each : {Clip(clip), withEnvelope(clip), onlyNoise(clip), transposed(clip), longer})
            all.push_back(each);
    }
    REQUIRE(all.size() == 40);
    return all;
}

// As `pacini render` makes it, in steps of 1 ms.
std::vector<double> driveLevels(const Clip& clip)
{
    const auto rendered = renderScene(sceneOf(clip), nullptr, {});
    REQUIRE(rendered);
    std::vector<double> squares(static_cast<std::size_t>(clip.duration / step));
    const std::size_t frames = 48;
    for (std::size_t i = 0; i < squares.size(); ++i)
        for (std::size_t k = 0; k < frames; ++k)
        {
            const double x = rendered->samples[i * frames + k];
            squares[i] += 2.0 * x * x / static_cast<double>(frames);
        }
    return smoothed(squares);
}

std::vector<double> sentLevels(const Clip& clip, const ControllerModel& model)
{
    ClipRumble rumble(clip, {Seconds(0.0), Seconds(clip.duration)}, 0_dB, model);
    const double interval = pacingOf(model).interval.value;
    std::vector<double> squares(static_cast<std::size_t>(clip.duration / step));
    std::int64_t last = -1;
    double square = 0.0;
    for (std::size_t i = 0; i < squares.size(); ++i)
    {
        const auto packet = static_cast<std::int64_t>(static_cast<double>(i) * step / interval + 1e-9);
        if (packet != last)
            square = squareOf(model, rumble.at(packet).value());
        last = packet;
        squares[i] = square;
    }
    return smoothed(squares);
}

// Of what is sent as samples.
std::vector<double> sampleLevels(const Clip& clip, const ControllerModel& model)
{
    const SampleStream stream = sampleStream(model).value();
    ClipRumble rumble(clip, {Seconds(0.0), Seconds(clip.duration)}, 0_dB, model);
    std::vector<double> squares(static_cast<std::size_t>(clip.duration / step));
    std::vector<double> samples;
    while (static_cast<double>(samples.size()) < clip.duration * stream.rate)
    {
        const auto state = rumble.at(static_cast<std::int64_t>(samples.size() / stream.samples));
        for (std::size_t i = 0; i < stream.samples; ++i)
            samples.push_back(std::get<PcmBlock>(state.value()).left[i] / 32767.0);
    }
    const auto perStep = static_cast<std::size_t>(step * stream.rate);
    for (std::size_t i = 0; i < squares.size(); ++i)
        for (std::size_t k = i * perStep; k < (i + 1) * perStep; ++k)
            squares[i] += 2.0 * samples[k] * samples[k] / static_cast<double>(perStep);
    return smoothed(squares);
}

// Mean difference in dB where the drive is within 10 dB of each of three levels below its loudest.
std::vector<double> offsets(const std::vector<double>& drive, const std::vector<double>& sent)
{
    const double loudest = *std::max_element(drive.begin(), drive.end());
    std::vector<double> all;
    for (int range = 0; range < 3; ++range)
    {
        double sum = 0.0;
        int count = 0;
        for (std::size_t i = 0; i < drive.size(); ++i)
        {
            const double below = 20.0 * std::log10(loudest / std::max(drive[i], 1e-9));
            if (below < 10.0 * range || below >= 10.0 * (range + 1))
                continue;
            sum += 20.0 * std::log10(std::max(sent[i], 1e-4) / drive[i]);
            ++count;
        }
        all.push_back(count >= 50 ? sum / count : 0.0);
    }
    return all;
}
} // namespace

TEST_CASE("The level that a device is sent follows the level of the rendered drive", "[devices]")
{
    for (const Clip& clip : fortyClips())
    {
        const auto drive = driveLevels(clip);
        for (const auto haptics :
             {ControllerHaptics::hdRumble, ControllerHaptics::dualShock4, ControllerHaptics::dualSense,
              ControllerHaptics::xbox, ControllerHaptics::steamDeck, ControllerHaptics::waveforms})
        {
            CAPTURE(clip.name, static_cast<int>(haptics));
            const auto sent = sentLevels(clip, {haptics, Transport::usb, standardTrigger()});
            const double agreement = correlation(drive, sent);
            const auto off = offsets(drive, sent);
            CHECK(agreement >= 0.95);
            for (const double each : off)
                CHECK(std::abs(each) <= 2.0);
        }
    }
}

TEST_CASE("What a DualSense is sent as samples has the level of the rendered drive", "[devices]")
{
    const auto model = usualModel(ControllerHaptics::dualSense, Transport::bluetooth);
    for (const Clip& clip : fortyClips())
    {
        CAPTURE(clip.name);
        const auto drive = driveLevels(clip);
        const auto sent = sampleLevels(clip, model);
        CHECK(correlation(drive, sent) >= 0.95);
        for (const double each : offsets(drive, sent))
            CHECK(std::abs(each) <= 2.0);
    }
}

namespace
{
struct Shown
{
    const char* name;
    ControllerModel model;
    double strongTime; ///< s to 63 % of a level, assumed
    double weakTime;
};

// Levels felt, as a motor shows them that gets to its speed in some time and whose curve has `exponent` above the start
// of ours: those of our curve, or of a number that is the level itself.
std::vector<double> feltLevels(const Clip& clip, const Shown& shown, double exponent, bool byCurve)
{
    const ControllerModel& model = shown.model;
    ClipRumble rumble(clip, {Seconds(0.0), Seconds(clip.duration)}, 0_dB, model);
    const double interval = pacingOf(model).interval.value;
    auto [strongCurve, weakCurve] = motorCurves(model);
    strongCurve.exponent = weakCurve.exponent = exponent;
    std::vector<double> squares(static_cast<std::size_t>(clip.duration / step));
    std::int64_t last = -1;
    MotorLevels target, now;
    for (std::size_t i = 0; i < squares.size(); ++i)
    {
        const auto packet = static_cast<std::int64_t>(static_cast<double>(i) * step / interval + 1e-9);
        if (packet != last)
        {
            const RumbleState state = rumble.at(packet).value();
            const auto numbers =
                byCurve ? test::toldNumbers(model, reportOf(model, state, 0)) : std::get<MotorLevels>(state);
            target = {strongCurve.level(numbers.strong), weakCurve.level(numbers.weak)};
        }
        last = packet;
        now.strong += (target.strong - now.strong) * (1.0 - std::exp(-step / shown.strongTime));
        now.weak += (target.weak - now.weak) * (1.0 - std::exp(-step / shown.weakTime));
        squares[i] = now.strong * now.strong + now.weak * now.weak;
    }
    return smoothed(squares);
}

// Mean distance in dB where the drive is within 30 dB of its loudest; no level is taken for less than -40 dB of that.
double distance(const std::vector<double>& drive, const std::vector<double>& felt)
{
    const double loudest = *std::max_element(drive.begin(), drive.end());
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < drive.size(); ++i)
        if (drive[i] > loudest * 0.0316)
        {
            sum += std::abs(20.0 * std::log10(std::max(felt[i], 0.01 * loudest) / drive[i]));
            ++count;
        }
    return count > 0 ? sum / count : 0.0;
}

double packetsPerSecond(const std::vector<Clip>& clips, const ControllerModel& model)
{
    double packets = 0.0, seconds = 0.0;
    for (const Clip& clip : clips)
    {
        const test::PlayedReports played(model, clip);
        packets += static_cast<double>(played.sink.sent.size());
        seconds += clip.duration;
    }
    return packets / seconds;
}
} // namespace

TEST_CASE("The page's table of what is felt on each device is what is measured", "[devices][devices-table][slow]")
{
    std::ifstream file(sourceFolder() / "Resources/docs/devices.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    const auto clips = fortyClips();
    std::vector<std::vector<double>> drives;
    for (const Clip& clip : clips)
        drives.push_back(driveLevels(clip));
    // The distance of the levels of each clip from its drive, dB to a tenth, mean over the clips.
    const auto distanceOf = [&](const auto& levelsOf)
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < clips.size(); ++i)
            sum += distance(drives[i], levelsOf(clips[i])) / static_cast<double>(clips.size());
        return decimalText(sum, 1);
    };
    const auto checkRow = [&](const std::string& device, const ControllerModel& model, std::vector<std::string> cells)
    {
        cells.resize(3);
        std::string row = "| " + device + " |";
        for (const std::string& cell : cells)
            row += cell.empty() ? " |" : " " + cell + " |";
        row += " " + decimalText(packetsPerSecond(clips, model), 0) + " |";
        std::cout << row << std::endl;
        CAPTURE(row);
        CHECK(page.find(row + "\n") != std::string::npos);
    };
    const Transport usb = Transport::usb;
    for (const Shown& shown :
         std::vector<Shown>{{"DualShock 4", {ControllerHaptics::dualShock4, usb}, 0.060, 0.030},
                            {"DualSense, rumble", {ControllerHaptics::dualSense, usb}, 0.010, 0.010},
                            {"Xbox", {ControllerHaptics::xbox, Transport::bluetooth}, 0.060, 0.030},
                            {"Steam Deck", {ControllerHaptics::steamDeck, usb}, 0.005, 0.005}})
    {
        std::vector<std::string> cells;
        for (const double exponent : {1.0, 1.5, 2.0})
            if (exponent == 1.0 ||
                shown.model.haptics != ControllerHaptics::steamDeck) // coils follow what they are sent
                cells.push_back(distanceOf([&](const Clip& clip) { return feltLevels(clip, shown, exponent, false); }) +
                                " / " +
                                distanceOf([&](const Clip& clip) { return feltLevels(clip, shown, exponent, true); }));
        checkRow(shown.name, shown.model, cells);
    }
    for (const auto& [name, model] : std::vector<std::pair<std::string, ControllerModel>>{
             {"Switch (HD rumble)", {ControllerHaptics::hdRumble, Transport::bluetooth}},
             {"Waveforms", {ControllerHaptics::waveforms, usb, standardTrigger()}}})
        checkRow(name, model, {distanceOf([&, &of = model](const Clip& clip) { return sentLevels(clip, of); })});
    for (const auto& [name, model] : std::vector<std::pair<std::string, ControllerModel>>{
             {"DualSense on Bluetooth, samples", usualModel(ControllerHaptics::dualSense, Transport::bluetooth)},
             {"Steam Controller, samples", {ControllerHaptics::steamController, usb}}})
        checkRow(name, model, {distanceOf([&, &of = model](const Clip& clip) { return sampleLevels(clip, of); })});
}
