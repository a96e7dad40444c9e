// What is exported sounds as Pacini itself does within the format's model. Prints a table, for all demo sounds and, if
// PACINI_SOUNDS names a folder, for the sounds there: pacini_tests "[formatquality]"

#include "io/formats/DemoSounds.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/ahap/AhapFormat.h"
#include "io/formats/android/AndroidFormat.h"
#include "io/formats/haps/HapsFormat.h"
#include "io/formats/haptic/HapticFormat.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/players/AhapPlayer.h"
#include "io/formats/players/AndroidPlayer.h"
#include "io/formats/players/HapsPlayer.h"
#include "io/formats/players/HapticPlayer.h"
#include "io/formats/players/HjifPlayer.h"
#include "io/formats/players/TactPlayer.h"
#include "io/formats/samples/PcmFormat.h"
#include "io/formats/tact/TactFormat.h"

#include <pacini/actuator/LevelLimiter.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
constexpr int fs = 8000;

/// A format's model of a clip: one voice, in which any of these may be fixed.
struct Model
{
    std::optional<double> frequency = {};   ///< Hz
    std::optional<PulseParams> pulses = {}; ///< instead of those that the decoder makes of events
    double step = 0.0;                      ///< s; amplitudes stand still for so long
    double low = 20.0;                      ///< Hz: what the format's players play at least
    double high = 20e3;                     ///< and at most
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

/// The clip reduced to the model, by Pacini's decoder.
std::vector<float> reduced(const Clip& clip, const Model& model)
{
    SingleVoice voice = oneVoice(clip);
    if (model.frequency)
        voice.frequency = {{0.0, *model.frequency}};
    for (Breakpoint& point : voice.frequency)
        point.value = std::clamp(point.value, model.low, model.high);
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

/// How much HTS an export loses against a render, over many sounds.
struct Lost
{
    double mean = 0.0;
    double most = -std::numeric_limits<double>::infinity();
    std::string worst = {}; ///< where it is most
    double score = 0.0;     ///< HTS that is left, on the mean

    void add(const std::string& name, double points, std::size_t sounds)
    {
        mean += points / static_cast<double>(sounds);
        if (points > most)
        {
            most = points;
            worst = name;
        }
    }
};

/// What is lost against `own`; prints that and what is lost against the whole clip.
Lost lostOver(const std::vector<test::DemoSound>& sounds, const char* title, const Render& own, const Render& exported)
{
    Lost lost, ofWhole;
    for (const test::DemoSound& sound : sounds)
    {
        const double found = test::hts(sound, exported(sound.clip), fs);
        lost.score += found / static_cast<double>(sounds.size());
        lost.add(sound.name, test::hts(sound, own(sound.clip), fs) - found, sounds.size());
        ofWhole.add(sound.name, test::hts(sound, test::decoded(sound.clip, fs), fs) - found, sounds.size());
    }
    std::printf("%-34s %2zu sounds: HTS %5.2f, lost of the format's model %5.2f, most %5.2f (%s), of the clip %5.2f, "
                "most %5.2f\n",
                title, sounds.size(), lost.score, lost.mean, lost.most, lost.worst.c_str(), ofWhole.mean, ofWhole.most);
    return lost;
}

/// Compares over all demo sounds; `most` points of HTS may be lost on the mean, `maxOfOne` on each, and `least` must be
/// left of a sound on the mean: what is lost also grows when the clips become better than the format can tell.
void compareAll(const char* title, const Render& own, const Render& exported, double most, double maxOfOne,
                double least)
{
    const Lost lost = lostOver(test::demoSounds(), title, own, exported);
    CAPTURE(title, lost.worst);
    CHECK(lost.score > least);
    CHECK(lost.mean < most);
    CHECK(lost.most <= maxOfOne);
    if (const char* folder = std::getenv("PACINI_SOUNDS"))
    {
        static const std::vector<test::DemoSound> others = test::soundsIn(folder);
        lostOver(others, title, own, exported);
    }
}

std::string mainFile(const Result<ExportedClip>& exported)
{
    REQUIRE(exported);
    return exported->files.at(0).bytes;
}
} // namespace

TEST_CASE("An HJIF file with all bands sounds as the clip does", "[formats][formatquality]")
{
    compareAll(
        "HJIF", [](const Clip& clip) { return test::decoded(clip, fs); },
        [](const Clip& clip) { return test::playHjif(mainFile(writeHjif(clip, {})), fs); }, 1.0, 4.5, 82.2);
    // Most in a drum roll: the decoder is silent between its pulses, which keyframes of 5 ms do not follow (2.4
    // without).
}

TEST_CASE("An HJIF file that was not searched for keeps most", "[formats][formatquality]")
{
    ExportParams params;
    params.quick = true;
    compareAll(
        "HJIF, quick", [](const Clip& clip) { return test::decoded(clip, fs); },
        [&](const Clip& clip) { return test::playHjif(mainFile(writeHjif(clip, params)), fs); }, 3.5, 17.0, 80.2);
}

TEST_CASE("A .haptic file of the usual density sounds as the clip's one voice does", "[formats][formatquality]")
{
    const Render exported = [](const Clip& clip)
    {
        test::HapticPlayerSettings player;
        player.sampleRate = fs;
        return test::playHaptic(mainFile(writeHaptic(clip, {})), player);
    };
    // Most in a river, whose five splashes are emphases of 12 ms now that every event is one; merged it lost 3.0.
    compareAll(".haptic, all points on its player", asHaptic, exported, 2.0, 13.0, 78.0);
    compareAll(
        ".haptic", [](const Clip& clip) { return reduced(clip, {.low = 55.0, .high = 200.0}); }, exported, 2.5, 13.0,
        78.0); // most in a roll of 44 drum strokes, whose valleys want more points than the usual 40 per second
}

TEST_CASE("AHAP files, one or two, sound as the clip's one voice does", "[formats][formatquality]")
{
    for (const bool split : {false, true})
    {
        const Render exported = [&](const Clip& clip)
        {
            return playedAhap(clip, split);
        };
        compareAll(split ? "AHAP split, all points, its player" : "AHAP, all points on its player", asAhap, exported,
                   2.0, 13.0, 78.4);
        compareAll(
            split ? "AHAP split" : "AHAP", [](const Clip& clip) { return reduced(clip, {.low = 65.0, .high = 300.0}); },
            exported, 3.0, 13.0, 78.4);
    }
}

TEST_CASE("An Android waveform sounds as the clip's strength does on a motor", "[formats][formatquality]")
{
    compareAll(
        "Android waveform",
        [](const Clip& clip) {
            return reduced(clip, {150.0, PulseParams{TransientShape::sine, 150.0, 3.0}, 0.010});
        },
        [](const Clip& clip) { return test::playAndroidWaveform(mainFile(writeAndroidJson(clip, {})), 150.0, fs); },
        1.0, 3.0, 69.2);
}

TEST_CASE("Android envelopes sound as the clip's one voice does", "[formats][formatquality]")
{
    compareAll(
        "Android waveform envelope", [](const Clip& clip) { return reduced(clip, {}); },
        [](const Clip& clip)
        { return test::playAndroidEnvelope(mainFile(writeAndroidJson(clip, {})), false, 0.0, 0.0, fs); },
        1.0, 7.5, 77.8);
    compareAll(
        "Android basic envelope", [](const Clip& clip) { return reduced(clip, {.low = 65.0, .high = 300.0}); },
        [](const Clip& clip)
        { return test::playAndroidEnvelope(mainFile(writeAndroidJson(clip, {})), true, 65.0, 300.0, fs); },
        3.0, 9.0, 77.6);
}

TEST_CASE("Android envelopes within limits sound as the clip's one voice does, less so with few points",
          "[formats][formatquality]")
{
    const auto compare = [](const char* name, const EnvelopeLimits& limits, double mean, double most, double least)
    {
        compareAll(
            name, [](const Clip& clip) { return reduced(clip, {}); },
            [&](const Clip& clip)
            {
                ExportParams params;
                params.envelope = limits;
                return test::playAndroidEnvelope(mainFile(writeAndroidJson(clip, params)), false, 0.0, 0.0, fs);
            },
            mean, most, least);
    };
    compare("Android envelope, as few points as say it", {}, 1.5, 7.5, 77.9);
    compare("Android envelope, 20 ms apart", {0, 20, 1000}, 7.0, 26.5, 72.5); // most in a roll
    compare("Android envelope, 64 points, 20 ms apart", {64, 20, 1000}, 8.5, 38.0, 71.0);
    compare("Android envelope, 16 points, 20 ms apart", {16, 20, 1000}, 15.5, 43.5, 63.8);
}

TEST_CASE("A .haps file sounds as the clip's one voice does", "[formats][formatquality]")
{
    compareAll(
        ".haps",
        [](const Clip& clip) {
            return reduced(clip, {{}, PulseParams{TransientShape::sine, 2.0 / 0.022, 2.0}});
        },
        [](const Clip& clip) { return test::playHaps(mainFile(writeHaps(clip, {})), clip.duration, fs); }, 3.0, 7.5,
        75.5);
}

TEST_CASE("A .tact file sounds as the clip's strength does on a motor", "[formats][formatquality]")
{
    compareAll(
        ".tact",
        [](const Clip& clip) {
            return reduced(clip, {150.0, PulseParams{TransientShape::sine, 150.0, 3.0}, 0.020});
        },
        [](const Clip& clip) { return test::playTact(mainFile(writeTact(clip, {})), 150.0, fs); }, 1.0, 3.0, 61.0);
}

TEST_CASE("Raw samples sound as the clip does at their rate", "[formats][formatquality]")
{
    const auto play = [](const Clip& clip, int bits, auto sampleOf)
    {
        ExportParams params;
        params.sampleRate = fs;
        const std::string bytes = mainFile(writeRaw(clip, params, bits));
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
        auto samples = test::decoded(clip, fs);
        LevelLimiter limiter; // as everything that is played
        limiter.prepare({fs, samples.size()});
        const auto late = limiter.latencyFrames();
        samples.resize(samples.size() + late);
        limiter.process(samples, samples);
        samples.erase(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(late));
        return samples;
    };
    compareAll(
        "raw8", own, [&](const Clip& clip) { return play(clip, 8, bits8); }, 1.0, 1.0, 82.9);
    compareAll(
        "raw16", own, [&](const Clip& clip) { return play(clip, 16, bits16); }, 0.1, 0.1, 83.0);
}
