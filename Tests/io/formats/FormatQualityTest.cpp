// What is exported sounds as Pacini itself does within the format's model.

#include "io/formats/AhapFormat.h"
#include "io/formats/AndroidFormat.h"
#include "io/formats/DemoSounds.h"
#include "io/formats/HapsFormat.h"
#include "io/formats/HapticFormat.h"
#include "io/formats/HjifFormat.h"
#include "io/formats/PcmFormat.h"
#include "io/formats/PlayedClip.h"
#include "io/formats/TactFormat.h"
#include "io/formats/players/AhapPlayer.h"
#include "io/formats/players/AndroidPlayer.h"
#include "io/formats/players/HapsPlayer.h"
#include "io/formats/players/HapticPlayer.h"
#include "io/formats/players/HjifPlayer.h"
#include "io/formats/players/TactPlayer.h"

#include <cmath>
#include <functional>
#include <optional>

using namespace pacini;

namespace
{
constexpr int fs = 8000;

/// A format's model of a clip: one voice, in which any of these may be fixed.
struct Model
{
    std::optional<double> frequency;        ///< Hz
    std::optional<PulseParams> pulses = {}; ///< instead of those that the decoder makes of events
    double step = 0.0;                      ///< s; amplitudes stand still for so long
};

/// The curve's value in the middle of each step.
Curve stepped(const Curve& curve, double duration, double step)
{
    Curve steps;
    for (double from = 0.0; from < duration; from += step)
    {
        const double to = std::min(from + step, duration);
        steps.push_back({from, valueAt(curve, 0.5 * (from + to))});
        steps.push_back({to, steps.back().value});
    }
    return steps;
}

std::vector<float> reduced(const Clip& clip, const Model& model)
{
    SingleVoice voice = oneVoice(clip);
    if (model.frequency)
        voice.frequency = {{0.0, *model.frequency}};
    if (model.step > 0.0)
        voice.amplitude = stepped(voice.amplitude, clip.duration, model.step);
    const Clip one = clipOfVoice(voice);
    DecoderParams params;
    params.sampleRate = fs;
    if (model.pulses)
        params.pulses = *model.pulses;
    Decoder decoder(one, params);
    std::vector<float> samples(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(samples);
    return samples;
}

test::PlayerCurve pointsOf(const Curve& curve, const std::function<double(double)>& map)
{
    test::PlayerCurve points;
    for (const Breakpoint& point : curve)
        points.emplace_back(point.time, map(point.value));
    return points;
}

/// What of `hertz` a player of `low` to `high` Hz is told.
double placeOf(double hertz, double low, double high)
{
    return std::clamp((hertz - low) / (high - low), 0.0, 1.0);
}

/// The one voice of a clip with all of its points, on the player of .haptic files.
std::vector<float> asHaptic(const Clip& clip)
{
    test::HapticPlayerSettings player;
    player.sampleRate = fs;
    const SingleVoice voice = oneVoice(clip);
    test::HapticSignal signal;
    signal.amplitude = pointsOf(voice.amplitude, [](double a) { return std::min(a, 1.0); });
    signal.frequency = pointsOf(voice.frequency, [&](double hertz) { return placeOf(hertz, player.low, player.high); });
    for (const Transient& event : voice.events)
        // No emphasis may be weaker than the amplitude around it.
        signal.emphases.push_back({event.time, std::max(event.amplitude, valueAt(voice.amplitude, event.time)),
                                   placeOf(100.0 * std::pow(2.8, event.sharpness), player.dull, player.crisp)});
    return test::playHaptic(signal, player);
}

/// The one voice of a clip with all of its points, on the player of AHAP files: curves and events do not meet.
std::vector<float> asAhap(const Clip& clip)
{
    const SingleVoice voice = oneVoice(clip);
    const auto sharpnessOf = [](double hertz)
    {
        return placeOf(hertz, 65.0, 300.0);
    };
    test::AhapPattern curves, events;
    curves.events = {{0.0, clip.duration, 1.0, 0.0, false}};
    curves.intensity = {pointsOf(voice.amplitude, [](double a) { return std::sqrt(std::min(a, 1.0)); })};
    curves.sharpness = {pointsOf(voice.frequency, sharpnessOf)};
    for (const Transient& event : voice.events)
        events.events.push_back({event.time, 0.0, std::sqrt(std::min(event.amplitude, 1.0)),
                                 sharpnessOf(100.0 * std::pow(2.8, event.sharpness)), true});
    std::vector<float> samples(static_cast<std::size_t>(std::ceil(clip.duration * fs)));
    test::playAhap(curves, fs, samples);
    test::playAhap(events, fs, samples);
    return samples;
}

std::vector<float> playedAhap(const Clip& clip, bool split)
{
    ExportParams params;
    params.split = split;
    const auto exported = writeAhap(clip, params);
    REQUIRE(exported);
    std::vector<float> samples(static_cast<std::size_t>(std::ceil(clip.duration * fs)));
    for (const ExportedFile& file : exported->files)
        test::playAhap(file.bytes, fs, samples);
    return samples;
}

using Render = std::function<std::vector<float>(const Clip&)>;

/// Compares over all demo sounds; `most` points of HTS may be lost on the mean, `mostOfOne` on each.
void compareAll(const Render& own, const Render& exported, double most, double mostOfOne)
{
    double lost = 0.0;
    for (const test::DemoSound& sound : test::demoSounds())
    {
        const double reference = test::hts(sound, own(sound.clip), fs);
        const double found = test::hts(sound, exported(sound.clip), fs);
        CAPTURE(sound.name, reference, found);
        CHECK(found >= reference - mostOfOne);
        lost += reference - found;
    }
    CHECK(lost / static_cast<double>(test::demoSounds().size()) < most);
}

std::string mainFile(const Result<ExportedClip>& exported)
{
    REQUIRE(exported);
    return exported->files.at(0).bytes;
}
} // namespace

TEST_CASE("An HJIF file with all bands sounds as the clip does", "[formats]")
{
    compareAll([](const Clip& clip) { return test::decoded(clip, fs); },
               [](const Clip& clip) { return test::playHjif(mainFile(writeHjif(clip, {})), fs); }, 3.0, 3.0);
}

TEST_CASE("A .haptic file of the usual density sounds as the clip's one voice does", "[formats]")
{
    compareAll(
        asHaptic,
        [](const Clip& clip)
        {
            test::HapticPlayerSettings player;
            player.sampleRate = fs;
            return test::playHaptic(mainFile(writeHaptic(clip, {})), player);
        },
        2.0, 9.0); // a roll of 44 drum strokes is more than 40 points per second can say
}

TEST_CASE("AHAP files, one or two, sound as the clip's one voice does", "[formats]")
{
    for (const bool split : {false, true})
    {
        CAPTURE(split);
        compareAll(
            asAhap, [&](const Clip& clip) { return playedAhap(clip, split); }, 1.0, 6.0);
    }
}

TEST_CASE("An Android waveform sounds as the clip's strength does on a motor", "[formats]")
{
    compareAll(
        [](const Clip& clip) {
            return reduced(clip, {150.0, PulseParams{PulseShape::sine, 150.0, 3.0}, 0.010});
        },
        [](const Clip& clip) { return test::playAndroidWaveform(mainFile(writeAndroidJson(clip, {})), 150.0, fs); },
        1.0, 3.0);
}

TEST_CASE("An Android waveform envelope sounds as the clip's one voice does", "[formats]")
{
    compareAll([](const Clip& clip) { return reduced(clip, {}); },
               [](const Clip& clip)
               { return test::playAndroidEnvelope(mainFile(writeAndroidJson(clip, {})), false, 0.0, 0.0, fs); },
               3.0, 8.0);
}

TEST_CASE("A .haps file sounds as the clip's one voice does", "[formats]")
{
    compareAll(
        [](const Clip& clip) {
            return reduced(clip, {{}, PulseParams{PulseShape::sine, 2.0 / 0.022, 2.0}});
        },
        [](const Clip& clip) { return test::playHaps(mainFile(writeHaps(clip, {})), clip.duration, fs); }, 3.0, 3.0);
}

TEST_CASE("A .tact file sounds as the clip's strength does on a motor", "[formats]")
{
    compareAll(
        [](const Clip& clip) {
            return reduced(clip, {150.0, PulseParams{PulseShape::sine, 150.0, 3.0}, 0.020});
        },
        [](const Clip& clip) { return test::playTact(mainFile(writeTact(clip, {})), 150.0, fs); }, 1.0, 3.0);
}

TEST_CASE("Raw samples sound as the clip does at their rate", "[formats]")
{
    const auto play = [](const Clip& clip, auto write, auto sampleOf)
    {
        ExportParams params;
        params.sampleRate = fs;
        const std::string bytes = mainFile(write(clip, params));
        return sampleOf(bytes);
    };
    const auto bits8 = [](const std::string& bytes)
    {
        std::vector<float> samples;
        for (const char c : bytes)
            samples.push_back(static_cast<float>(static_cast<signed char>(c)) / 128.0f);
        return samples;
    };
    const auto bits16 = [](const std::string& bytes)
    {
        std::vector<float> samples;
        for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
            samples.push_back(static_cast<float>(static_cast<unsigned char>(bytes[i]) +
                                                 256 * static_cast<signed char>(bytes[i + 1])) /
                              32768.0f);
        return samples;
    };
    const Render own = [](const Clip& clip)
    {
        return test::decoded(clip, fs);
    };
    compareAll(
        own, [&](const Clip& clip) { return play(clip, writeRaw8, bits8); }, 1.0, 1.0);
    compareAll(
        own, [&](const Clip& clip) { return play(clip, writeRaw16, bits16); }, 0.1, 0.1);
}
