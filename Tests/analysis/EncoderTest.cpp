#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/Encoder.h>
#include <pacini/analysis/SoundSurvey.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

using namespace pacini;

namespace
{
Clip encode(std::span<const float> interleaved, int fs, int channels = 1, const EncoderParams& params = {},
            std::size_t block = 65536)
{
    Encoder encoder(params);
    encoder.start(fs, channels);
    block *= static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i < interleaved.size(); i += block)
        encoder.push(interleaved.subspan(i, std::min(block, interleaved.size() - i)));
    return encoder.finish();
}

/// A drum: a sine that falls from 150 to 50 Hz and dies away.
void addKick(std::vector<float>& x, std::size_t at, double fs, double amplitude)
{
    double phase = 0.0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(0.3 * fs) && at + n < x.size(); ++n)
    {
        const double t = static_cast<double>(n) / fs;
        phase += 2.0 * std::numbers::pi * (50.0 + 100.0 * std::exp(-t / 0.02)) / fs;
        x[at + n] += static_cast<float>(amplitude * std::exp(-t / 0.06) * std::sin(phase));
    }
}

const Band& loudestBand(const Clip& clip, double time)
{
    return *std::max_element(clip.bands.begin(), clip.bands.end(),
                             [&](const Band& a, const Band& b)
                             { return valueAt(a.amplitude, time) < valueAt(b.amplitude, time); });
}
} // namespace

TEST_CASE("A steady tone becomes a level and a pitch", "[analysis][encoder]")
{
    for (const double f : {45.0, 110.0, 390.0})
    {
        CAPTURE(f);
        EncoderParams params;
        params.normalise = false;
        const Clip clip = encode(test::sine(4 * 44100, f, 44100.0, 0.25), 44100, 1, params);
        REQUIRE(validate(clip).ok());
        CHECK(clip.duration == 4.0);
        CHECK(valueAt(clip.envelope, 2.0) == Approx(0.25).epsilon(0.02));
        CHECK(valueAt(loudestBand(clip, 2.0).pitch, 2.0) == Approx(f).epsilon(0.01));
        CHECK(valueAt(clip.centroid, 2.0) == Approx(f).epsilon(0.03));
        // The cap is 960; each of 14 curves has its ends, and a few points for the start.
        CHECK(breakpointCount(clip) < 100);
    }
}

TEST_CASE("No curve goes on after the sound, however it ends", "[analysis]")
{
    for (std::size_t frames = 20000; frames < 22000; frames += 97)
    {
        CAPTURE(frames);
        auto x = test::noise(frames, frames, 0.05);
        for (std::size_t n = frames - 700; n < frames; ++n)
            x[n] *= 1.0f + 0.02f * static_cast<float>(n % 700); // loud to the last frame
        REQUIRE(validate(encode(x, 44100)).ok());
    }
}

TEST_CASE("Normalising raises the loudest moment to full drive", "[analysis][encoder]")
{
    auto x = test::sine(44100, 100.0, 44100.0, 0.02);
    for (std::size_t n = 0; n < 8820; ++n) // a sudden start or end would be the loudest moment
    {
        x[n] *= static_cast<float>(n) / 8820.0f;
        x[x.size() - 1 - n] *= static_cast<float>(n) / 8820.0f;
    }
    const Clip clip = encode(x, 44100);
    CHECK(valueAt(clip.envelope, 0.5) == Approx(1.0).epsilon(0.03));
    const auto gain = std::find_if(clip.encoder.begin(), clip.encoder.end(),
                                   [](const EncoderParameter& p) { return p.name == "gain"; });
    REQUIRE(gain != clip.encoder.end());
    CHECK(std::get<double>(gain->value) == Approx(50.0).epsilon(0.02));
}

TEST_CASE("Clips do not depend on how the sound is cut into calls", "[analysis][encoder]")
{
    auto x = test::noise(2 * 50000, 3, 0.1);
    for (std::size_t at : {20000u, 60000u})
        addKick(x, at, 44100.0, 0.8);
    const Clip whole = encode(x, 44100, 2);
    CHECK(encode(x, 44100, 2, {}, 1) == whole);
    CHECK(encode(x, 44100, 2, {}, 777) == whole);
    CHECK(whole.transients.size() >= 2);
}

TEST_CASE("An encoder forgets the sound before", "[analysis][encoder]")
{
    const auto tone = test::sine(30000, 70.0, 44100.0, 0.5);
    Encoder encoder{EncoderParams{}};
    encoder.start(44100, 1);
    encoder.push(tone);
    const Clip first = encoder.finish();
    encoder.start(96000, 3);
    encoder.push(test::noise(90000, 5, 1.0));
    (void)encoder.finish();
    encoder.start(44100, 1);
    encoder.push(tone);
    CHECK(encoder.finish() == first);
}

TEST_CASE("Nothing cancels in the mix of channels", "[analysis][encoder]")
{
    const auto mono = test::sine(44100, 80.0, 44100.0, 0.5);
    std::vector<float> antiphase, one;
    for (float v : mono)
    {
        antiphase.insert(antiphase.end(), {v, -v});
        one.insert(one.end(), {v, 0.0f});
    }
    EncoderParams params;
    params.normalise = false;
    const double level = valueAt(encode(mono, 44100, 1, params).envelope, 0.5);
    CHECK(valueAt(encode(antiphase, 44100, 2, params).envelope, 0.5) == Approx(level).epsilon(0.02));
    CHECK(valueAt(encode(one, 44100, 2, params).envelope, 0.5) == Approx(level / 2.0).epsilon(0.05));
}

TEST_CASE("Silence, one sample, DC and extreme rates give valid clips", "[analysis][encoder]")
{
    for (const int fs : {8000, 11025, 44100, 192000, 384000, 768000})
    {
        CAPTURE(fs);
        const std::vector<float> silent(static_cast<std::size_t>(fs) / 2, 0.0f);
        const Clip silence = encode(silent, fs);
        CHECK(validate(silence).ok());
        CHECK(silence.duration == static_cast<double>(fs / 2) / fs);
        CHECK(breakpointCount(silence) == 0);
        CHECK(silence.transients.empty());

        const Clip one = encode(std::vector<float>{0.5f}, fs);
        CHECK(validate(one).ok());
        CHECK(one.duration == 1.0 / fs);

        const std::vector<float> constant(static_cast<std::size_t>(fs), 0.7f);
        EncoderParams params;
        params.normalise = false;
        const Clip dc = encode(constant, fs, 1, params);
        CHECK(validate(dc).ok());
        CHECK(valueAt(dc.envelope, 0.5) < 0.01);

        const Clip tone = encode(test::sine(static_cast<std::size_t>(fs), 100.0, fs, 0.3), fs, 1, params);
        CHECK(valueAt(tone.envelope, 0.5) == Approx(0.3).epsilon(0.02));
        CHECK(valueAt(loudestBand(tone, 0.5).pitch, 0.5) == Approx(100.0).epsilon(0.01));
    }
    CHECK(encode({}, 44100).duration == 0.0);
}

TEST_CASE("64 channels and full-scale garbage give valid clips", "[analysis][encoder]")
{
    CHECK(validate(encode(test::noise(64 * 4000, 9, 1.0), 48000, 64)).ok());
    auto x = test::noise(44100, 10, 3.0e38);
    CHECK(validate(encode(x, 44100)).ok());
    for (float& v : x)
        v = v > 0.0f ? 1.0f : -1.0f;
    CHECK(validate(encode(x, 44100)).ok());
}

TEST_CASE("Every number of bands and both spacings give valid clips within the cap of breakpoints",
          "[analysis][encoder]")
{
    auto x = test::noise(3 * 44100, 21, 0.3);
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] *= static_cast<float>(1.0 + std::sin(0.002 * static_cast<double>(n)));
    for (const BandSpacing spacing : {BandSpacing::logarithmic, BandSpacing::linear})
        for (const int bands : {1, 2, 6, 12, 32})
            for (const double breakpoints : {1.0, 20.0})
            {
                CAPTURE(bands, breakpoints);
                EncoderParams params;
                params.bands = bands;
                params.breakpoints = breakpoints;
                params.spacing = spacing;
                const Clip clip = encode(x, 44100, 1, params);
                CHECK(validate(clip).ok());
                CHECK(clip.bands.size() == static_cast<std::size_t>(bands));
                // Each curve has two ends whatever the cap.
                CHECK(static_cast<double>(breakpointCount(clip)) <=
                      breakpoints * bands * 3.0 + 2.0 * (2.0 * bands + 2.0));
            }
}

TEST_CASE("More breakpoints describe a sound better", "[analysis][encoder]")
{
    // Two tones whose levels and pitches swing: what a clip should say of them is known without any analysis.
    const double fs = 44100.0, seconds = 6.0;
    const auto swing = [](double t, double rate, double phase)
    {
        return 0.5 + 0.25 * std::sin(2.0 * std::numbers::pi * rate * t + phase) +
               0.2 * std::sin(2.0 * std::numbers::pi * 2.7 * rate * t);
    };
    const auto lowLevel = [&](double t)
    {
        return 0.5 * swing(t, 1.1, 0.0);
    };
    const auto highLevel = [&](double t)
    {
        return 0.4 * swing(t, 1.7, 2.0);
    };
    const auto highPitch = [&](double t)
    {
        return 400.0 * std::exp2(0.3 * std::sin(2.0 * std::numbers::pi * 0.8 * t));
    };
    std::vector<float> x(static_cast<std::size_t>(seconds * fs));
    double phase = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        const double t = static_cast<double>(n) / fs;
        phase += 2.0 * std::numbers::pi * highPitch(t) / fs;
        x[n] = static_cast<float>(lowLevel(t) * std::sin(2.0 * std::numbers::pi * 70.0 * t) +
                                  highLevel(t) * std::sin(phase));
    }

    struct Errors
    {
        double level, pitch; ///< RMS: of full scale, octaves
    };
    std::size_t countBefore = 0;
    Errors before{1.0, 1.0};
    for (const double breakpoints : {2.0, 5.0, 12.0, 40.0})
    {
        CAPTURE(breakpoints);
        EncoderParams params;
        params.breakpoints = breakpoints;
        params.normalise = false;
        params.bands = 2; // 30 to 173 to 1000 Hz
        const Clip clip = encode(x, 44100, 1, params);
        REQUIRE(clip.bands.size() == 2);
        Errors errors{};
        int places = 0;
        for (double t = 0.3; t < seconds - 0.3; t += 0.01, ++places)
        {
            errors.level += std::pow(valueAt(clip.bands[0].amplitude, t) - lowLevel(t), 2.0) +
                            std::pow(valueAt(clip.bands[1].amplitude, t) - highLevel(t), 2.0);
            errors.pitch += std::pow(std::log2(valueAt(clip.bands[1].pitch, t) / highPitch(t)), 2.0);
        }
        for (double* error : {&errors.level, &errors.pitch})
            *error = std::sqrt(*error / places);
        CHECK(breakpointCount(clip) > countBefore);
        CHECK(errors.level < 0.75 * before.level);
        CHECK(errors.pitch <= before.pitch);
        countBefore = breakpointCount(clip);
        before = errors;
    }
    CHECK(before.level < 0.02);
    CHECK(before.pitch < 0.04);
}

TEST_CASE("Any finite amplitude gives a valid clip, and that of the same sound at an ordinary level",
          "[analysis][encoder]")
{
    auto x = test::noise(22050, 12, 0.01);
    addKick(x, 4000, 44100.0, 0.7);
    addKick(x, 14000, 44100.0, 0.4);
    const auto scaled = [&](double factor)
    {
        auto y = x;
        for (float& v : y)
            v = static_cast<float>(factor * static_cast<double>(v));
        return y;
    };
    const auto silentClip = [](const Clip& clip)
    {
        return breakpointCount(clip) == 0 && clip.transients.empty();
    };
    const Clip ordinary = encode(x, 44100);
    CHECK(ordinary.transients.size() == 2);
    for (int decade = -30; decade <= 38; decade += 2)
    {
        CAPTURE(decade);
        const double factor = std::pow(10.0, decade);
        for (const bool normalise : {true, false})
        {
            EncoderParams params;
            params.normalise = normalise;
            CAPTURE(normalise);
            const Clip clip = encode(scaled(factor), 44100, 1, params);
            CHECK(validate(clip).ok());
            if (decade <= -7 || decade >= -1)
                CHECK(silentClip(clip) == (decade <= -7));
            std::vector<float> constant(4410, static_cast<float>(factor)), alternating(4410), mixed(4410);
            for (std::size_t n = 0; n < alternating.size(); ++n)
            {
                alternating[n] = static_cast<float>(n % 2 == 0 ? factor : -factor);
                mixed[n] = static_cast<float>(n % 300 < 150 ? factor : -1.0 / factor);
            }
            for (const auto& sound : {constant, alternating, mixed})
            {
                CHECK(validate(encode(sound, 44100, 1, params)).ok());
                CHECK(validate(encode(sound, 8000, 2, params)).ok());
            }
        }
    }
    // Powers of two scale without rounding: up to the largest magnitude of sound, nothing but the gain is another.
    for (const double factor : {0x1p-3, 0x1p10, 0x1p20, 0x1p30, 0x1p39})
    {
        CAPTURE(factor);
        const Clip clip = encode(scaled(factor), 44100);
        CHECK(clip.transients.size() == ordinary.transients.size());
        REQUIRE(clip.bands.size() == ordinary.bands.size());
        for (double t = 0.0; t < 0.5; t += 0.01)
        {
            CHECK(valueAt(clip.envelope, t) == Approx(valueAt(ordinary.envelope, t)).margin(1e-3));
            for (std::size_t k = 0; k < clip.bands.size(); ++k)
                CHECK(valueAt(clip.bands[k].amplitude, t) ==
                      Approx(valueAt(ordinary.bands[k].amplitude, t)).margin(1e-3));
        }
    }
    // What is no number counts as silence, what is beyond all sound as the loudest of it.
    auto bad = x, zero = x;
    bad[5000] = std::numeric_limits<float>::quiet_NaN();
    bad[5001] = std::numeric_limits<float>::infinity();
    bad[5002] = -std::numeric_limits<float>::infinity();
    zero[5000] = zero[5001] = zero[5002] = 0.0f;
    CHECK(encode(bad, 44100) == encode(zero, 44100));
    bad = scaled(1e10);
    zero = bad;
    bad[5000] = 3e38f;
    zero[5000] = 1e12f;
    CHECK(encode(bad, 44100) == encode(zero, 44100));
}

TEST_CASE("Eight identical kicks give eight equal events, loud or quiet", "[analysis][encoder]")
{
    for (const double amplitude : {0.9, 0.09})
    {
        std::vector<float> x(5 * 44100, 0.0f);
        for (std::size_t k = 0; k < 8; ++k)
            addKick(x, 4410 + k * 22050, 44100.0, amplitude);
        const Clip clip = encode(x, 44100);
        REQUIRE(clip.transients.size() == 8);
        for (std::size_t k = 0; k < 8; ++k)
        {
            CHECK(clip.transients[k].time == Approx(0.1 + 0.5 * static_cast<double>(k)).margin(0.003));
            CHECK(clip.transients[k].amplitude == Approx(clip.transients[0].amplitude).epsilon(0.03));
            CHECK(clip.transients[k].sharpness == Approx(clip.transients[0].sharpness).margin(0.05));
        }
    }
}

TEST_CASE("Long sounds are fitted in sections that cannot be felt", "[analysis][encoder]")
{
    // A tone over the first seam, at 600 s, silence over the second, at 1200 s, and kicks over the third, at 1800 s.
    constexpr int fs = 8000;
    auto x = test::sine(2000 * fs, 110.0, fs, 0.25);
    std::fill(x.begin() + 1000 * fs, x.begin() + 1500 * fs, 0.0f);
    std::fill(x.begin() + 1700 * fs, x.end(), 0.0f);
    for (std::size_t k = 0; k < 400; ++k)
        addKick(x, 1700 * fs + k * 5200, fs, k % 7 == 0 ? 0.9 : 0.4);

    EncoderParams params;
    const Clip clip = encode(x, fs, 1, params);
    REQUIRE(validate(clip).ok());
    const double level = valueAt(clip.envelope, 300.0);
    const Band& band = loudestBand(clip, 300.0);
    for (double t = 590.0; t < 610.0; t += 0.01)
    {
        CAPTURE(t);
        REQUIRE(valueAt(clip.envelope, t) == Approx(level).epsilon(0.02));
        REQUIRE(valueAt(band.amplitude, t) == Approx(level).epsilon(0.02));
        REQUIRE(valueAt(band.pitch, t) == Approx(110.0).epsilon(0.01));
        REQUIRE(valueAt(clip.centroid, t) == Approx(110.0).epsilon(0.03));
    }
    for (double t = 1001.0; t < 1499.0; t += 0.5)
        REQUIRE(valueAt(clip.envelope, t) == 0.0);
    CHECK(valueAt(clip.envelope, 1600.0) == Approx(level).epsilon(0.02));
    CHECK(valueAt(clip.envelope, 999.0) == Approx(level).epsilon(0.02));
    // The same kicks as a sound of their own, away from any seam, are the same curve.
    const std::vector<float> part(x.begin() + 1700 * fs, x.begin() + 1900 * fs);
    const Clip alone = encode(part, fs, 1, params);
    double sum = 0.0;
    double difference = 0.0;
    for (double t = 20.0; t < 180.0; t += 0.005)
    {
        const double whole = valueAt(clip.envelope, 1700.0 + t);
        sum += whole * whole;
        difference += std::pow(whole - valueAt(alone.envelope, t), 2.0);
    }
    CHECK(difference < 0.02 * 0.02 * sum);
}

TEST_CASE("A sound that was looked at before is encoded piece by piece to the same clip", "[analysis][encoder]")
{
    // Hiss over the first seam, at 600 s, that a train crosses; the loudest comes last.
    constexpr int fs = 8000;
    auto x = test::sine(1300 * fs, 110.0, fs, 0.05);
    Random random(5);
    for (std::size_t i = 500 * fs; i < 700 * fs; ++i)
        x[i] = static_cast<float>(random.uniform(-0.05, 0.05));
    for (std::size_t k = 0; k < 60; ++k)
        addKick(x, 599 * fs + k * 240, fs, 0.4);
    for (std::size_t i = 1290 * fs; i < 1295 * fs; ++i)
        x[i] = static_cast<float>(0.5 * std::sin(2.2 * static_cast<double>(i)));
    for (const double audible : {0.0, 1.0})
    {
        EncoderParams params;
        params.audible = audible;
        const auto pushAll = [&x](auto& to)
        {
            for (std::size_t i = 0; i < x.size(); i += 10007)
                to.push(std::span(x).subspan(i, std::min<std::size_t>(10007, x.size() - i)));
        };
        SoundSurvey survey(params);
        survey.start(fs, 1);
        pushAll(survey);
        Encoder told(params);
        told.start(fs, 1, x.size(), survey.finish());
        pushAll(told);
        CHECK(told.finish() == encode(x, fs, 1, params));
    }
}

TEST_CASE("Wrong parameters are refused by name", "[analysis][encoder]")
{
    EncoderParams params;
    CHECK(validate(params).ok());
    params.bands = 33;
    CHECK(validate(params).error().where == "bands");
    params = {};
    params.quantise = 3;
    CHECK(validate(params).error().where == "quantise");
    params = {};
    params.breakpoints = std::nan("");
    CHECK(validate(params).error().where == "breakpoints");
    params = {};
    params.lowFrequency = 500.0;
    params.highFrequency = 100.0;
    CHECK_FALSE(validate(params).ok());
}

TEST_CASE("The ends of every range of the encoder are allowed and nothing beyond them", "[analysis][encoder]")
{
    const auto where = [](auto&& set)
    {
        EncoderParams params;
        set(params);
        const auto valid = validate(params);
        return valid.ok() ? std::string() : valid.error().where;
    };
    for (const auto& [value, allowed] :
         {std::pair(1.0, true), std::pair(32.0, true), std::pair(0.0, false), std::pair(33.0, false)})
        CHECK(where([v = value](EncoderParams& p) { p.bands = static_cast<decltype(p.bands)>(v); }).empty() == allowed);
    for (const auto& [value, allowed] :
         {std::pair(4, true), std::pair(16, true), std::pair(3, false), std::pair(17, false)})
        CHECK(where([v = value](EncoderParams& p) { p.quantise = v; }).empty() == allowed);
    for (const auto& [value, allowed] :
         {std::pair(0.5, true), std::pair(1000.0, true), std::pair(0.499, false), std::pair(1000.1, false)})
        CHECK(where([v = value](EncoderParams& p) { p.breakpoints = v; }).empty() == allowed);
    for (const auto& [value, allowed] :
         {std::pair(0.25, true), std::pair(4.0, true), std::pair(0.249, false), std::pair(4.01, false)})
        CHECK(where([v = value](EncoderParams& p) { p.onsets.sensitivity = v; }).empty() == allowed);
    CHECK(where([](EncoderParams& p) { p.lowFrequency = 1.0, p.highFrequency = 1800.0; }).empty());
    CHECK(where([](EncoderParams& p) { p.lowFrequency = 0.99; }) == "low");
    CHECK(where([](EncoderParams& p) { p.highFrequency = 1800.1; }) == "high");
    CHECK(where([](EncoderParams& p) { p.lowFrequency = p.highFrequency = 500.0; }) == "low");
}

namespace
{
/// Bursts of a tone, 60 ms long, four a second.
std::vector<float> bursts(double frequency, double amplitude, int fs)
{
    std::vector<float> x(static_cast<std::size_t>(2 * fs));
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        const double t = static_cast<double>(n) / fs;
        if (std::fmod(t, 0.25) >= 0.1 && std::fmod(t, 0.25) < 0.16)
            x[n] = static_cast<float>(amplitude * std::sin(2.0 * std::numbers::pi * frequency * t));
    }
    return x;
}

EncoderParams audibleParams(double audible)
{
    EncoderParams params;
    params.audible = audible;
    return params;
}
} // namespace

TEST_CASE("What is heard above the range of touch is felt as a tone, unless it is switched off", "[analysis][encoder]")
{
    auto x = bursts(3000.0, 0.3, 48000);
    for (std::size_t n = 0; n < x.size(); ++n) // something low, steady and soft
        x[n] += static_cast<float>(0.003 * std::sin(2.0 * std::numbers::pi * 60.0 * static_cast<double>(n) / 48000.0));
    for (const HeardRole role : {HeardRole::beside, HeardRole::instead})
    {
        CAPTURE(role);
        const auto paramsOf = [role](double audible)
        {
            EncoderParams params = audibleParams(audible);
            params.heard = role;
            return params;
        };
        const Clip usual = encode(x, 48000, 1, paramsOf(0.0));
        const Clip clip = encode(x, 48000, 1, paramsOf(1.0));
        CHECK(validate(clip));
        // The soft tone is raised to full drive and hides the bursts; their loudness does not.
        CHECK(valueAt(usual.envelope, 0.5) > 0.5 * valueAt(usual.envelope, 0.63));
        CHECK(valueAt(clip.envelope, 0.60) < 0.6 * valueAt(clip.envelope, 0.64));
        CHECK(valueAt(clip.envelope, 0.74) < 0.7 * valueAt(clip.envelope, 0.64));
        const Band& loudest = loudestBand(clip, 0.63);
        CHECK(loudest.lowFrequency < (role == HeardRole::beside ? 380.0 : 290.0));
        CHECK(loudest.highFrequency > 150.0);
        CHECK(valueAt(loudest.pitch, 0.63) > 140.0);
        CHECK(valueAt(loudest.pitch, 0.63) < (role == HeardRole::beside ? 390.0 : 300.0));
        CHECK(loudestBand(usual, 0.63).highFrequency < 100.0);

        const Clip half = encode(x, 48000, 1, paramsOf(0.5));
        CHECK(half.envelope != clip.envelope);
        CHECK(half.envelope != usual.envelope);
        const auto recorded = std::find_if(half.encoder.begin(), half.encoder.end(),
                                           [](const EncoderParameter& p) { return p.name == "audible"; });
        REQUIRE(recorded != half.encoder.end());
        CHECK(std::get<double>(recorded->value) == 0.5);
        // Halfway is halfway.
        const double between =
            0.5 * (valueAt(clip.envelope, 0.74) + valueAt(usual.envelope, 0.74)) / valueAt(half.envelope, 0.74);
        CHECK(between > 0.7);
        CHECK(between < 1.4);
    }
}

TEST_CASE("The record of a clip says how what is heard was felt, so that one of before is made anew",
          "[analysis][encoder]")
{
    std::vector<EncoderParameter> before = encoderRecord({});
    const auto heard =
        std::find_if(before.begin(), before.end(), [](const EncoderParameter& p) { return p.name == "heard"; });
    REQUIRE(heard != before.end());
    before.erase(heard); // as clips had it when it was always instead
    EncoderParams instead;
    instead.heard = HeardRole::instead;
    CHECK(before != encoderRecord({}));
    CHECK(before != encoderRecord(instead));
}

TEST_CASE("Brighter sounds are felt higher", "[analysis][encoder]")
{
    const auto pitch = [](double frequency, HeardRole role)
    {
        EncoderParams params = audibleParams(1.0);
        params.heard = role;
        const Clip clip = encode(bursts(frequency, 0.3, 48000), 48000, 1, params);
        const Band& band = loudestBand(clip, 0.63);
        return band.pitch.empty() ? band.centreFrequency : valueAt(band.pitch, 0.63);
    };
    CHECK(pitch(1300.0, HeardRole::instead) < 200.0);
    CHECK(pitch(9000.0, HeardRole::instead) > 250.0);
    CHECK(pitch(9000.0, HeardRole::instead) < 300.0);
    CHECK(pitch(1300.0, HeardRole::beside) < 320.0);
    CHECK(pitch(9000.0, HeardRole::beside) > 340.0);
    CHECK(pitch(9000.0, HeardRole::beside) < 400.0);
    for (const HeardRole role : {HeardRole::beside, HeardRole::instead})
    {
        CHECK(pitch(1300.0, role) < pitch(3000.0, role));
        CHECK(pitch(3000.0, role) < pitch(9000.0, role));
    }
}

TEST_CASE("A sound that lives in the range of touch is the same clip with what is heard", "[analysis][encoder]")
{
    std::vector<float> x(48000);
    addKick(x, 4800, 48000.0, 0.8);
    addKick(x, 26000, 48000.0, 0.4);
    Clip usual = encode(x, 48000, 1, audibleParams(0.0));
    Clip audible = encode(x, 48000);
    usual.encoder = audible.encoder = {};
    CHECK(usual == audible);
}

TEST_CASE("What is heard does not depend on pieces", "[analysis][encoder]")
{
    const auto x = bursts(2000.0, 0.2, 44100);
    const Clip whole = encode(x, 44100, 1, audibleParams(1.0));
    CHECK(encode(x, 44100, 1, audibleParams(1.0), 777) == whole);
    Encoder encoder(audibleParams(1.0));
    encoder.start(44100, 1, x.size());
    encoder.push(x);
    CHECK(encoder.finish() == whole);
    // The next sound begins anew.
    encoder.start(44100, 1);
    encoder.push(x);
    CHECK(encoder.finish() == whole);
}

TEST_CASE("What is heard of silence, of nothing and of extremes is a valid clip", "[analysis][encoder]")
{
    CHECK(encode(std::vector<float>(48000), 48000, 1, audibleParams(1.0)).envelope.empty());
    CHECK(validate(encode({}, 48000, 1, audibleParams(1.0))));
    CHECK(validate(encode(std::vector<float>(3, 0.5f), 8000, 1, audibleParams(1.0))));
    CHECK(validate(encode(std::vector<float>(48000, 1e12f), 48000, 2, audibleParams(1.0))));
    CHECK(validate(encode(test::noise(48000, 3, 1e12), 48000, 1, audibleParams(1.0))));
    CHECK(validate(encode(test::noise(768000, 3, 1.0), 768000, 1, audibleParams(1.0))));
    CHECK_FALSE(validate(audibleParams(1.01)));
    CHECK_FALSE(validate(audibleParams(-0.01)));
    CHECK_FALSE(validate(audibleParams(std::nan(""))));
}
