#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/Measure.h"
#include "support/Numbers.h"

#include <pacini/realtime/Translator.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
std::vector<float> translated(const TranslatorSetup& setup, const TranslatorParams& params, double fs,
                              const std::vector<float>& in, std::size_t block = 512)
{
    Translator translator;
    translator.setSetup(setup);
    translator.prepare({fs, block});
    translator.setParams(params);
    return runInBlocks(translator, in, block);
}

TranslatorParams carriersOnly()
{
    TranslatorParams params;
    params.direct = 0.0;
    params.transients.muted = true;
    params.brightness = -60.0;
    params.audible = 0.0;
    return params;
}

/// The frame at which the energy up to it is half of all.
double middleOf(const std::vector<float>& x)
{
    double all = 0.0;
    for (float v : x)
        all += static_cast<double>(v) * static_cast<double>(v);
    double sum = 0.0;
    std::size_t n = 0;
    while (n < x.size() && sum < 0.5 * all)
    {
        sum += static_cast<double>(x[n]) * static_cast<double>(x[n]);
        ++n;
    }
    return static_cast<double>(n);
}
} // namespace

TEST_CASE("the translator keeps the contract of blocks", "[realtime]")
{
    checkBlockContract<Translator>(TranslatorParams{}, {.bound = 1.0});
}

TEST_CASE("the translator with carriers keeps the contract of blocks", "[realtime]")
{
    TranslatorParams params = carriersOnly();
    params.transients.muted = false;
    params.transposition = -5.0;
    checkBlockContract<Translator>(params, {.bound = 1.0});
}

TEST_CASE("a bypassed translator gives the input back, later by its latency", "[realtime]")
{
    TranslatorParams params;
    params.bypass = true;
    checkBlockContract<Translator>(params, {.bound = 1.0, .delay = MeasuredDelay::firstFrame});
}

TEST_CASE("the translator adds at most two milliseconds at any rate", "[realtime]")
{
    for (double fs : {8000.0, 11025.0, 22050.0, 44100.0, 48000.0, 88200.0, 96000.0, 192000.0, 768000.0})
    {
        CAPTURE(fs);
        Translator translator;
        translator.prepare({fs, 64});
        CHECK(static_cast<double>(translator.latencyFrames()) <= 0.002 * fs);
    }
}

TEST_CASE("a click is felt within a millisecond of the reported place", "[realtime]")
{
    for (double fs : {8000.0, 44100.0, 48000.0, 96000.0, 192000.0, 768000.0})
    {
        CAPTURE(fs);
        Translator translator;
        translator.prepare({fs, 64});
        const auto at = static_cast<std::size_t>(0.1 * fs);
        std::vector<float> click(static_cast<std::size_t>(0.2 * fs), 0.0f);
        for (std::size_t n = at; n < at + static_cast<std::size_t>(fs / 4000.0); ++n)
            click[n] = 1.0f;
        const auto out = runInBlocks(translator, click, 64);
        const auto expected = static_cast<double>(at + translator.latencyFrames());
        // Where the drive first reaches half of its greatest size.
        const double half = 0.5 * peakOf(out);
        const auto onset =
            std::find_if(out.begin(), out.end(), [half](float v) { return std::abs(static_cast<double>(v)) >= half; });
        CHECK(std::abs(static_cast<double>(onset - out.begin()) - expected) <= 0.001 * fs);
        CHECK(translator.meters().read().events == 1);
        CHECK(std::abs(static_cast<double>(translator.meters().read().lastEventFrame) - static_cast<double>(at)) <=
              0.001 * fs);
    }
}

TEST_CASE("a burst of 100 Hz reaches half its envelope within 12 ms", "[realtime]")
{
    for (double fs : {8000.0, 44100.0, 48000.0, 96000.0, 192000.0, 768000.0})
        for (double direct : {0.0, 1.0})
        {
            CAPTURE(fs, direct);
            TranslatorParams params;
            params.direct = direct;
            params.transients.muted = true;
            Translator translator;
            translator.prepare({fs, 64});
            translator.setParams(params);
            const auto in = sine(static_cast<std::size_t>(0.3 * fs), 100.0, fs, 0.5);
            const auto out = runInBlocks(translator, in, 64);
            const auto latency = translator.latencyFrames();
            // Envelope: quadrature of the drive with itself a quarter of a period before.
            const auto quarter = static_cast<std::size_t>(fs / 400.0);
            const auto envelope = [&](std::size_t n)
            {
                const double q = n >= quarter ? static_cast<double>(out[n - quarter]) : 0.0;
                return std::hypot(static_cast<double>(out[n]), q);
            };
            const double final = envelope(out.size() - 1);
            CHECK(final > 0.3);
            std::size_t n = 0;
            while (n < out.size() && envelope(n) < 0.5 * final)
                ++n;
            // Bands are narrow and take their time: the carriers get 18 ms.
            CHECK(static_cast<double>(n) - static_cast<double>(latency) <= (direct == 1.0 ? 0.012 : 0.018) * fs);
        }
}

TEST_CASE("a tone between two bands stays one tone", "[realtime]")
{
    const double fs = 48000.0;
    const std::size_t frames = 96000;
    for (double f : {90.0, 45.0, 250.0, 610.0})
        for (double direct : {0.0, 1.0})
        {
            CAPTURE(f, direct);
            TranslatorParams params = carriersOnly();
            params.direct = direct;
            const auto out = translated({}, params, fs, sine(frames, f, fs, 0.5));
            const auto steady = std::span<const float>(out).last(frames / 2);
            const double n = static_cast<double>(steady.size());
            // A whole number of periods: what is not at f is everything else.
            const double tone = 2.0 * std::norm(spectrumAt(steady, f, fs)) / (n * n);
            const double all = rms(steady) * rms(steady);
            CHECK(tone / all > 0.99);
            CHECK(std::abs(std::sqrt(2.0 * all) / 0.5 - 1.0) < 0.15);
        }
}

TEST_CASE("transposition moves a tone by its interval", "[realtime]")
{
    const double fs = 48000.0;
    const std::size_t frames = 96000;
    TranslatorParams params = carriersOnly();
    params.transposition = -12.0;
    const auto out = translated({}, params, fs, sine(frames, 240.0, fs, 0.5));
    const auto steady = std::span<const float>(out).last(frames / 2);
    const double n = static_cast<double>(steady.size());
    const double tone = 2.0 * std::norm(spectrumAt(steady, 120.0, fs)) / (n * n);
    CHECK(tone / (rms(steady) * rms(steady)) > 0.99);
}

TEST_CASE("without changes the direct signal is the source's range as it was, but for the phase at its ends",
          "[realtime]")
{
    struct Tone
    {
        double frequency;
        double turned; ///< degrees by which the ends of the range may turn the phase
    };
    const double fs = 48000.0;
    TranslatorParams params;
    params.transients.muted = true;
    params.intensity = -6.0206;
    params.brightness = -60.0;
    params.audible = 0.0;
    Translator translator;
    translator.prepare({fs, 512});
    translator.setParams(params);
    // A frame of latency more or less is 1.5 degrees at 200 Hz.
    for (const auto& [f, turned] :
         {Tone{60.0, 30.0}, Tone{120.0, 10.0}, Tone{200.0, 1.4}, Tone{300.0, 10.0}, Tone{700.0, 35.0}})
    {
        CAPTURE(f);
        translator.reset();
        const auto in = sine(48000, f, fs, 0.5);
        const auto out = runInBlocks(translator, in, 512);
        const auto source = std::span(in).subspan(24000 - translator.latencyFrames(), 24000);
        const auto drive = std::span(out).last(24000);
        const auto answer = spectrumAt(drive, f, fs) / (0.5 * spectrumAt(source, f, fs));
        CHECK(std::abs(20.0 * std::log10(std::abs(answer))) < 0.15);
        CHECK(std::abs(std::arg(answer)) * 180.0 / std::numbers::pi < turned);
        // Half a second is a whole number of periods: all that is not the tone is error.
        const double all = rms(drive) * rms(drive);
        const double tone = 2.0 * std::norm(spectrumAt(drive, f, fs)) / (24000.0 * 24000.0);
        CHECK(10.0 * std::log10(std::abs(all - tone) / all) < -70.0);
    }
}

TEST_CASE("roles play their own part", "[realtime]")
{
    const double fs = 48000.0;
    const auto low = sine(48000, 35.0, fs, 0.5);
    const auto high = sine(48000, 400.0, fs, 0.5);
    const auto level = [&](const TranslatorParams& params, const std::vector<float>& in)
    {
        const auto out = translated({}, params, fs, in);
        return 20.0 * std::log10(rms(std::span<const float>(out).last(24000)) / (0.5 / std::numbers::sqrt2));
    };
    TranslatorParams params;
    params.transients.muted = true;
    params.brightness = -60.0;
    params.audible = 0.0;
    CHECK(std::abs(level(params, low)) < 2.0);
    CHECK(std::abs(level(params, high)) < 2.0);
    params.rumble.muted = true;
    CHECK(level(params, low) < -12.0);
    CHECK(std::abs(level(params, high)) < 2.0);
    params.rumble.muted = false;
    params.texture.muted = true;
    CHECK(std::abs(level(params, low)) < 2.0);
    CHECK(level(params, high) < -12.0);
    params.direct = 0.0;
    CHECK(std::abs(level(params, low)) < 2.0);
    CHECK(level(params, high) < -40.0);
    params.rumble.level = -6.0;
    CHECK(std::abs(level(params, low) + 6.0) < 2.0);
}

TEST_CASE("what is too high for the skin is felt as a tone of 200 Hz, and only then", "[realtime]")
{
    const double fs = 48000.0;
    const std::size_t frames = 96000;
    const auto at200 = [&](double f, double brightness)
    {
        TranslatorParams params;
        params.transients.muted = true;
        params.brightness = brightness;
        params.audible = 0.0;
        const auto out = translated({}, params, fs, sine(frames, f, fs, 0.5));
        const auto steady = std::span<const float>(out).last(frames / 2);
        return 2.0 * std::abs(spectrumAt(steady, 200.0, fs)) / static_cast<double>(steady.size()) / 0.5;
    };
    CHECK(std::abs(at200(900.0, -6.0) - 0.5) < 0.1);
    CHECK(std::abs(at200(900.0, 0.0) - 1.0) < 0.2);
    CHECK(at200(900.0, -60.0) < 1e-3);
    CHECK(at200(90.0, -6.0) < 1e-3);
}

TEST_CASE("what is heard above the range of touch is felt in proportion to its level, at every rate", "[realtime]")
{
    double usual = 0.0;
    for (const double fs : {48000.0, 22050.0, 44100.0, 192000.0})
    {
        CAPTURE(fs);
        const auto frames = static_cast<std::size_t>(2.0 * fs);
        TranslatorParams params;
        params.transients.muted = true;
        const auto level = [&](double f, double amplitude, double audible)
        {
            params.audible = audible;
            const auto out = translated({}, params, fs, sine(frames, f, fs, amplitude));
            return std::numbers::sqrt2 * rms(std::span<const float>(out).last(frames / 2));
        };
        // Of 7 kHz nothing passes the range of touch; 12 kHz is a multiple of the inner rate of 48 kHz.
        for (const double f : {7000.0, 9000.0, 12000.0})
            if (f < 0.45 * fs)
            {
                CAPTURE(f);
                params.brightness = -60.0;
                CHECK(level(f, 0.5, 0.0) < 1e-3);
                const double loud = level(f, 0.5, 1.0);
                usual = usual > 0.0 ? usual : loud;
                CHECK(loud == Approx(usual).epsilon(0.15));
                CHECK(loud > 0.2);
                CHECK(level(f, 0.25, 1.0) == Approx(0.5 * loud).epsilon(0.15));
            }
        CHECK(level(200.0, 0.5, 1.0) == level(200.0, 0.5, 0.0));
        // A muted texture mutes it too, and leaves the rumble as it is.
        params.texture.muted = true;
        CHECK(level(9000.0, 0.5, 1.0) < 1e-3);
        params.texture.muted = false;
    }
}

TEST_CASE("the low part of a sound stays as it is beside what is heard above", "[realtime]")
{
    const double fs = 48000.0;
    auto in = sine(96000, 50.0, fs, 0.15);
    const auto bright = sine(96000, 5000.0, fs, 0.5);
    std::transform(in.begin(), in.end(), bright.begin(), in.begin(), std::plus<>());
    TranslatorParams params;
    params.brightness = -60.0;
    params.transients.muted = true;
    params.audible = 0.0;
    const auto alone = translated({}, params, fs, in);
    params.audible = 1.0;
    const auto both = translated({}, params, fs, in);
    const auto steady = std::span<const float>(both).last(48000);
    const auto before = std::span<const float>(alone).last(48000);
    CHECK(std::abs(spectrumAt(steady, 50.0, fs)) == Approx(std::abs(spectrumAt(before, 50.0, fs))).epsilon(0.01));
    CHECK(rms(steady) > 1.02 * rms(before));
}

TEST_CASE("events alone are felt when all else is muted", "[realtime]")
{
    const double fs = 48000.0;
    TranslatorParams params;
    params.rumble.muted = params.texture.muted = true;
    std::vector<float> in(96000, 0.0f);
    for (std::size_t at : {20000u, 40000u, 60000u})
        for (std::size_t n = 0; n < 480; ++n)
            in[at + n] =
                static_cast<float>(std::exp(-static_cast<double>(n) / 100.0) * std::sin(0.7 * static_cast<double>(n)));
    Translator translator;
    translator.prepare({fs, 256});
    translator.setParams(params);
    const auto out = runInBlocks(translator, in, 256);
    CHECK(translator.meters().read().events == 3);
    for (std::size_t at : {20000u, 40000u, 60000u})
    {
        const auto part = std::vector<float>(out.begin() + static_cast<std::ptrdiff_t>(at),
                                             out.begin() + static_cast<std::ptrdiff_t>(at + 2400));
        CHECK(peakOf(part) > 0.04);
        CHECK(middleOf(part) < 0.015 * fs);
    }
    params.transients.muted = true;
    CHECK(peakOf(translated({}, params, fs, in)) == 0.0);
}

TEST_CASE("every event of a fast train is noticed, and a tone has only its beginning", "[realtime]")
{
    const double fs = 48000.0;
    for (double rate : {5.0, 20.0, 50.0})
    {
        CAPTURE(rate);
        std::vector<float> in(48000, 0.0f);
        unsigned events = 0;
        for (double at = 0.05; at < 0.95; at += 1.0 / rate, ++events)
            for (std::size_t n = 0; n < 480; ++n)
                in[static_cast<std::size_t>(at * fs) + n] =
                    static_cast<float>(0.8 * std::exp(-static_cast<double>(n) / (0.004 * fs)) *
                                       std::sin(2.0 * std::numbers::pi * 300.0 * static_cast<double>(n) / fs));
        Translator translator;
        translator.prepare({fs, 256});
        (void)runInBlocks(translator, in, 256);
        CHECK(translator.meters().read().events == events);
    }
    for (double f : {30.0, 60.0, 200.0})
    {
        CAPTURE(f);
        Translator translator;
        translator.prepare({fs, 256});
        (void)runInBlocks(translator, sine(96000, f, fs, 0.8), 256);
        CHECK(translator.meters().read().events <= 1);
    }
}

TEST_CASE("silence ends in exact silence soon after a sound", "[realtime]")
{
    for (double direct : {0.0, 1.0})
    {
        CAPTURE(direct);
        TranslatorParams params;
        params.direct = direct;
        auto in = noise(48000, 3);
        in.resize(4 * 48000, 0.0f);
        const auto out = translated({}, params, 48000.0, in);
        for (std::size_t n = 3 * 48000; n < out.size(); ++n)
            REQUIRE(out[n] == 0.0f);
    }
    checkSilenceIsCheap<Translator>(TranslatorParams{});
}

TEST_CASE("after a silence a sound is felt as if it were the first", "[realtime]")
{
    for (const double direct : {0.0, 0.5, 1.0})
    {
        CAPTURE(direct);
        TranslatorParams params;
        params.direct = direct;
        params.transients.muted = true;
        params.gateThreshold = -120.0;
        Translator translator;
        translator.prepare({48000.0, 256});
        translator.setParams(params);
        auto in = noise(48000, 11);
        std::fill(in.begin() + 4800, in.end(), 0.0f);
        const auto other = sine(48000, 620.0, 48000.0, 0.7);
        (void)runInBlocks(translator, other, 256);
        (void)runInBlocks(translator, std::vector<float>(2 * 48000, 0.0f), 256);
        const auto asleep = translator.meters().read();
        for (std::size_t k = 0; k < asleep.bands; ++k)
            CHECK(asleep.bandLevels[k] == -std::numeric_limits<double>::infinity());
        const auto after = runInBlocks(translator, in, 256);
        translator.reset();
        (void)runInBlocks(translator, std::vector<float>(3 * 48000, 0.0f), 256);
        CHECK(after == runInBlocks(translator, in, 256));
    }
}

TEST_CASE("what is below the gate is not felt", "[realtime]")
{
    TranslatorParams params;
    params.gateThreshold = -40.0;
    CHECK(peakOf(translated({}, params, 48000.0, sine(48000, 100.0, 48000.0, 0.009))) == 0.0);
    CHECK(peakOf(translated({}, params, 48000.0, sine(48000, 100.0, 48000.0, 0.011))) > 0.005);
}

TEST_CASE("parameters that jump leave no jump in the drive", "[realtime]")
{
    const double fs = 48000.0;
    const auto in = sine(static_cast<std::size_t>(2.0 * fs), 100.0, fs, 0.4);
    TranslatorParams base;
    base.transients.muted = true;
    std::vector<TranslatorParams> jumps(11, base);
    jumps[1].intensity = -60.0;
    jumps[2].rumble.muted = true;
    jumps[3].texture.muted = true;
    jumps[4].direct = 0.0;
    jumps[5].transposition = 7.0;
    jumps[6].inputGain = -20.0;
    jumps[7].bypass = true;
    jumps[8].gateThreshold = 0.0;
    jumps[9].brightness = 12.0;
    jumps[10].audible = 1.0;
    // A 100 Hz sine of 0.4 moves by 0.0052 in a frame, its own carriers by as much; a click would be 0.1 and more.
    const double steepest = 0.4 * 2.0 * std::numbers::pi * 150.0 / fs;
    for (std::size_t j = 1; j < jumps.size(); ++j)
    {
        CAPTURE(j);
        Translator translator;
        translator.prepare({fs, 64});
        std::vector<float> out(in.size());
        for (std::size_t i = 0, block = 0; i + 64 <= in.size(); i += 64, ++block)
        {
            translator.setParams(block / 30 % 2 == 0 ? base : jumps[j]);
            translator.process(std::span(in).subspan(i, 64), std::span(out).subspan(i, 64));
        }
        double largest = 0.0;
        for (std::size_t n = 2400; n + 64 < in.size(); ++n)
            largest = std::max(largest, std::abs(static_cast<double>(out[n + 1]) - static_cast<double>(out[n])));
        CHECK(largest < 3.0 * steepest);
    }
}

TEST_CASE("parameters outside their ranges count as the nearest end, those that are not finite not at all",
          "[realtime]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    TranslatorParams params;
    params.inputGain = 1e9;
    params.intensity = nan;
    params.rumble.level = inf;
    params.transposition = -inf;
    params.direct = -3.0;
    params.attack = -1.0;
    params.release = nan;
    params.gateThreshold = nan;
    params.transientSensitivity = nan;
    const auto valid = clamped(params);
    CHECK(test::asNumbers(valid.inputGain, valid.intensity, valid.transposition, valid.direct, valid.attack) ==
          test::Numbers{48.0, 0.0, 0.0, 0.0, 0.0});
    struct Range
    {
        double TranslatorParams::*value;
        double low, high;
    };
    for (const auto& [value, low, high] :
         {Range{&TranslatorParams::inputGain, -60.0, 48.0}, Range{&TranslatorParams::intensity, -60.0, 24.0},
          Range{&TranslatorParams::brightness, -60.0, 12.0}, Range{&TranslatorParams::audible, 0.0, 1.0},
          Range{&TranslatorParams::speech, 0.0, 1.0}, Range{&TranslatorParams::transposition, -48.0, 48.0},
          Range{&TranslatorParams::direct, 0.0, 1.0}, Range{&TranslatorParams::attack, 0.0, 200.0},
          Range{&TranslatorParams::release, 0.0, 1000.0}, Range{&TranslatorParams::transientSensitivity, 0.0, 1.0},
          Range{&TranslatorParams::transientSharpness, -1.0, 1.0}, Range{&TranslatorParams::gateThreshold, -120.0, 0.0},
          Range{&TranslatorParams::gateRelease, 1.0, 2000.0}})
    {
        TranslatorParams wild;
        wild.*value = -1e9;
        CHECK(clamped(wild).*value == low);
        wild.*value = 1e9;
        CHECK(clamped(wild).*value == high);
        wild.*value = 0.3 * low + 0.7 * high;
        CHECK(clamped(wild).*value == wild.*value);
    }
    for (RoleParams TranslatorParams::*role :
         {&TranslatorParams::rumble, &TranslatorParams::texture, &TranslatorParams::transients})
    {
        TranslatorParams wild;
        (wild.*role).level = -1e9;
        CHECK((clamped(wild).*role).level == -60.0);
        (wild.*role).level = 1e9;
        CHECK((clamped(wild).*role).level == 24.0);
    }
    TranslatorParams before;
    before.intensity = -7.0;
    before.rumble.level = 3.0;
    CHECK(clamped(params, before).intensity == -7.0);
    CHECK(clamped(params, before).rumble.level == 3.0);
    const auto out = translated({}, params, 48000.0, noise(24000, 4));
    CHECK(allFinite(out));
    CHECK(peakOf(out) <= 1.0);

    // While it plays: what is not finite changes nothing, anything else leaves the drive within full scale.
    const auto in = noise(24000, 5);
    const auto played = [&](auto&& paramsOf)
    {
        Translator translator;
        translator.prepare({48000.0, 240});
        translator.setParams(before);
        std::vector<float> y(in.size());
        for (std::size_t i = 0; i < in.size(); i += 240)
        {
            translator.process(std::span(in).subspan(i, 240), std::span(y).subspan(i, 240));
            translator.setParams(paramsOf());
        }
        return y;
    };
    TranslatorParams bad;
    for (double* value :
         {&bad.inputGain, &bad.intensity, &bad.rumble.level, &bad.texture.level, &bad.transients.level, &bad.brightness,
          &bad.audible, &bad.speech, &bad.transposition, &bad.direct, &bad.attack, &bad.release,
          &bad.transientSensitivity, &bad.transientSharpness, &bad.gateThreshold, &bad.gateRelease})
        *value = value == &bad.attack ? inf : nan;
    CHECK(played([&] { return bad; }) == played([&] { return before; }));
    Random random(8);
    const auto any = [&]
    {
        return anyNumber[random.next() % std::size(anyNumber)];
    };
    const auto wild = played(
        [&]
        {
            TranslatorParams p;
            p.inputGain = any();
            p.intensity = any();
            p.rumble.level = any();
            p.brightness = any();
            p.audible = any();
            p.transposition = any();
            p.direct = any();
            p.attack = any();
            p.release = any();
            p.transientSensitivity = any();
            p.gateThreshold = any();
            p.gateRelease = any();
            return p;
        });
    CHECK(allFinite(wild));
    CHECK(peakOf(wild) <= 1.0);
}

TEST_CASE("blocks of any length work, longer ones than prepared too", "[realtime]")
{
    const auto in = noise(200000, 6);
    const double audible = GENERATE(0.0, 1.0);
    Translator a, b;
    TranslatorParams params;
    params.audible = audible;
    a.setParams(params);
    b.setParams(params);
    a.prepare({48000.0, 64});
    b.prepare({48000.0, 64});
    const auto expected = runInBlocks(a, in, 64);
    CHECK(runInBlocks(b, in, 65536) == expected);
    b.reset();
    CHECK(runInBlocks(b, in, 7919) == expected);
    b.reset();
    CHECK(runInBlocks(b, in, in.size()) == expected);
}

TEST_CASE("no parameter or set-up touches the heap on the audio thread", "[realtime]")
{
    Translator translator;
    translator.prepare({48000.0, 512});
    const auto in = noise(48000, 9);
    std::vector<float> out(in.size());
    TranslatorSetup eight;
    eight.bands.bands = 8;
    translator.setSetup(eight);
    TranslatorParams params;
    const HeapGuard guard;
    for (std::size_t i = 0; i + 512 <= in.size(); i += 512)
    {
        params.direct = static_cast<double>(i % 3) / 2.0;
        params.transposition = static_cast<double>(i % 5);
        params.audible = static_cast<double>(i % 4) / 3.0;
        params.bypass = i % 7 == 0;
        translator.setParams(params);
        translator.process(std::span(in).subspan(i, 512), std::span(out).subspan(i, 512));
        (void)translator.meters().read();
    }
    CHECK(guard.traffic() == 0);
    CHECK(translator.meters().read().bands == 8);
}
