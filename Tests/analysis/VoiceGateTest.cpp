#include "io/AudioReader.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Paths.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/analysis/SoundSurvey.h>
#include <pacini/analysis/VoiceGate.h>
#include <pacini/filters/PolyphaseInterpolator.h>
#include <pacini/realtime/Translator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
constexpr int spokenRate = 8000;

/// Four seconds by a voice that the weights were not fitted to ("en-us+f3" of eSpeak NG 1.51).
std::vector<float> spoken()
{
    const auto read = readAudio(testFolder() / "analysis/spoken_sentence.wav");
    REQUIRE(read);
    REQUIRE(read->sampleRate == spokenRate);
    return read->samples;
}

/// The same at a whole multiple of its rate.
std::vector<float> spokenAt(std::size_t factor)
{
    const auto x = spoken();
    if (factor == 1)
        return x;
    PolyphaseInterpolator raise(factor, 0.44);
    std::vector<float> y(x.size() * factor);
    raise.process(x, y);
    return y;
}

std::vector<float> kicks(std::size_t frames, double fs)
{
    std::vector<float> x(frames);
    double phase = 0.0;
    for (std::size_t i = 0; i < frames; ++i)
    {
        const double t = std::fmod(static_cast<double>(i) / fs, 0.5);
        phase += (t < 1.0 / fs ? -phase : 50.0 * (1.0 + 2.0 * std::exp(-t / 0.02)) / fs);
        x[i] = static_cast<float>(0.4 * std::sin(2.0 * std::numbers::pi * phase) * std::exp(-t / 0.15));
    }
    return x;
}

/// A struck bell every 0.8 s: inharmonic partials that die away.
std::vector<float> bells(std::size_t frames, double fs)
{
    std::vector<float> x(frames);
    for (std::size_t i = 0; i < frames; ++i)
    {
        const double t = std::fmod(static_cast<double>(i) / fs, 0.8);
        for (const double ratio : {0.5, 1.0, 1.2, 1.5, 2.0, 2.66})
            x[i] += static_cast<float>(0.08 * std::sin(2.0 * std::numbers::pi * 440.0 * ratio * t) *
                                       std::exp(-t * ratio / 0.6));
    }
    return x;
}

std::vector<float> gated(const std::vector<float>& x, double fs, double speech = 0.0, std::size_t channels = 1)
{
    VoiceGate gate;
    gate.prepare(fs, channels);
    gate.setParams({speech});
    std::vector<float> y(x.size());
    gate.process(x, y);
    return y;
}

/// Power of `y` over that of `x`, dB.
double change(const std::vector<float>& x, const std::vector<float>& y)
{
    double before = 0.0, after = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        before += static_cast<double>(x[i]) * static_cast<double>(x[i]);
    for (const float v : y)
        after += static_cast<double>(v) * static_cast<double>(v);
    return 10.0 * std::log10(after / before);
}

double strongest(const Clip& clip)
{
    double largest = 0.0;
    for (const Band& band : clip.bands)
        for (const Breakpoint& point : band.amplitude)
            largest = std::max(largest, static_cast<double>(point.value));
    return largest;
}
} // namespace

TEST_CASE("the voice gate keeps the contract of blocks", "[analysis][voice]")
{
    checkBlockContract<VoiceGate>({.speech = 0.0}, {.bound = 10.0});
    checkBlockContract<VoiceGate>({.speech = 1.0}, {.bound = 10.0});
}

TEST_CASE("the voice gate turns a spoken sentence down, at any rate and in blocks of any size", "[analysis][voice]")
{
    for (const std::size_t factor : {1u, 2u, 3u, 6u, 12u, 24u})
    {
        CAPTURE(factor);
        const double fs = spokenRate * static_cast<double>(factor);
        const auto x = spokenAt(factor);
        const auto expected = gated(x, fs);
        CHECK(change(x, expected) < -7.0);
        VoiceGate gate;
        gate.prepare(fs, 1);
        gate.setParams({0.0});
        CHECK(runInBlocks(gate, x, 77) == expected);
    }
}

TEST_CASE("the voice gate turns speech down to the share that is wanted", "[analysis][voice]")
{
    const auto x = spoken();
    CHECK(gated(x, spokenRate, 1.0) == x);
    const double none = change(x, gated(x, spokenRate, 0.0));
    const double half = change(x, gated(x, spokenRate, 0.5));
    CHECK(half < -4.5);
    CHECK(half > -6.5);
    CHECK(none < half);
}

TEST_CASE("the voice gate leaves kicks and bells as they are", "[analysis][voice]")
{
    for (const double fs : {8000.0, 44100.0, 48000.0})
    {
        CAPTURE(fs);
        for (const auto& x :
             {kicks(static_cast<std::size_t>(4.0 * fs), fs), bells(static_cast<std::size_t>(4.0 * fs), fs),
              noise(static_cast<std::size_t>(2.0 * fs), 3, 0.2)})
            CHECK(change(x, gated(x, fs)) > -0.1);
    }
}

TEST_CASE("a kick under speech stays while the speech goes", "[analysis][voice]")
{
    // Of two channels the gate decides by the mean, so each tells what became of one of two sounds together.
    const auto voice = spoken();
    const auto kick = kicks(voice.size(), spokenRate);
    std::vector<float> both(2 * voice.size());
    for (std::size_t i = 0; i < voice.size(); ++i)
    {
        both[2 * i] = 2.0f * voice[i];
        both[2 * i + 1] = 0.5f * kick[i];
    }
    const auto out = gated(both, spokenRate, 0.0, 2);
    std::vector<float> voiceBefore, voiceAfter, kickBefore, kickAfter;
    for (std::size_t i = 0; i < voice.size(); ++i)
    {
        voiceBefore.push_back(both[2 * i]);
        voiceAfter.push_back(out[2 * i]);
        kickBefore.push_back(both[2 * i + 1]);
        kickAfter.push_back(out[2 * i + 1]);
    }
    CHECK(change(voiceBefore, voiceAfter) < -3.5);
    CHECK(change(kickBefore, kickAfter) > -3.0);
}

TEST_CASE("the voice gate survives what is no sound", "[analysis][voice]")
{
    auto x = spoken();
    for (std::size_t i = 0; i < x.size(); i += 97)
        x[i] = i % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
    CHECK(allFinite(gated(x, spokenRate)));
    for (const float level : {1e-40f, 1e12f})
    {
        std::vector<float> extreme = spoken();
        for (float& v : extreme)
            v *= level;
        CHECK(allFinite(gated(extreme, spokenRate)));
    }
    const std::vector<float> silence(20000, 0.0f);
    CHECK(gated(silence, spokenRate) == silence);
}

TEST_CASE("clips and live drives let speech go alike, and are without it no stronger", "[analysis][voice]")
{
    const auto x = spokenAt(6);
    const double fs = 6.0 * spokenRate;
    const auto clipWith = [&](double speech)
    {
        EncoderParams params;
        params.speech = speech;
        Encoder encoder(params);
        const auto clip = encodePrecisely(encoder, {static_cast<int>(fs), 1}, SoundParts(x, 1));
        REQUIRE(clip);
        return *clip;
    };
    const Clip all = clipWith(1.0), none = clipWith(0.0);
    CHECK(strongest(none) <= 1.05 * strongest(all));
    const auto energy = [](const Clip& clip)
    {
        double sum = 0.0;
        for (const Band& band : clip.bands)
            for (double t = 0.0; t < clip.duration; t += 0.01)
                sum += std::pow(static_cast<double>(valueAt(band.amplitude, t)), 2.0);
        return sum;
    };
    CHECK(10.0 * std::log10(energy(none) / energy(all)) < -7.0);

    const auto drive = [&](double speech)
    {
        Translator translator;
        translator.prepare({fs, 512});
        TranslatorParams params;
        params.speech = speech;
        translator.setParams(params);
        return runInBlocks(translator, x, 512);
    };
    const auto felt = drive(1.0);
    CHECK(change(felt, drive(0.0)) < -7.0);
}

TEST_CASE("a sound is surveyed as it is encoded, also without its speech", "[analysis][voice]")
{
    const auto x = spoken();
    EncoderParams params;
    params.speech = 0.0;
    SoundSurvey survey(params);
    survey.start(spokenRate, 1);
    survey.push(x);
    const SoundScale scale = survey.finish();
    Encoder encoder(params);
    const auto once = encodePrecisely(encoder, {spokenRate, 1}, SoundParts(x, 1));
    const auto twice = encodePrecisely(encoder, {spokenRate, 1, 0, scale}, SoundParts(x, 1));
    REQUIRE(once);
    REQUIRE(twice);
    CHECK(*once == *twice);
}
