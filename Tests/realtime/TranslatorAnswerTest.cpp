#include "support/ActuatorOf.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/Random.h>
#include <pacini/realtime/Translator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// Half a second: a chord, clicks, a noise that is far too loud, silence, a tone.
std::vector<float> answerSound(double fs)
{
    std::vector<float> x(static_cast<std::size_t>(0.5 * fs));
    Random random(4);
    const double turn = 2.0 * std::numbers::pi;
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        const double t = static_cast<double>(n) / fs;
        double y = 0.0;
        if (t < 0.1)
            y = 0.4 * std::sin(turn * 55.0 * t) + 0.3 * std::sin(turn * 310.0 * t);
        else if (t < 0.2)
            for (const double at : {0.11, 0.14, 0.17})
                y += t >= at ? 0.9 * std::exp((at - t) / 0.002) * std::sin(turn * 900.0 * (t - at)) : 0.0;
        else if (t < 0.25)
            y = 4.0 * random.uniform(-1.0, 1.0);
        else if (t >= 0.40)
            y = 0.5 * std::sin(turn * 140.0 * t);
        x[n] = static_cast<float>(y);
    }
    return x;
}

using BetweenCalls = std::function<void(Translator&, std::size_t)>;

void pinTranslator(const std::string& name, const TranslatorSetup& setup, const TranslatorParams& params, double fs,
                   const BetweenCalls& between = {})
{
    Translator translator;
    translator.setSetup(setup);
    translator.prepare({fs, 512});
    translator.setParams(params);
    const auto in = answerSound(fs);
    std::vector<float> out(in.size());
    std::vector<double> meters;
    std::size_t call = 0;
    for (std::size_t done = 0; done < in.size();)
    {
        const std::size_t n =
            std::min<std::size_t>(std::array<std::size_t, 5>{64, 500, 1, 333, 17}[call++ % 5], in.size() - done);
        if (between)
            between(translator, done);
        translator.process(std::span(in).subspan(done, n), std::span(out).subspan(done, n));
        done += n;
        if (call % 8 == 0)
        {
            const auto reading = translator.meters().read();
            meters.insert(meters.end(), {reading.outputPeak, reading.gainReduction, static_cast<double>(reading.events),
                                         static_cast<double>(reading.lastEventFrame) / fs, reading.lastEventLevel});
            for (std::size_t k = 0; k < reading.bands; ++k)
                meters.push_back(std::pow(10.0, 0.1 * reading.bandLevels[k]));
        }
    }
    const std::vector<double> drive(out.begin(), out.end());
    const std::size_t half = drive.size() / 2;
    checkPinned("realtime/translator, " + name + ", beginning", std::span(drive).first(half), 3e-6);
    checkPinned("realtime/translator, " + name + ", end", std::span(drive).subspan(half), 3e-6);
    checkPinned("realtime/translator, " + name + ", meters", meters, 3e-6);
}
} // namespace

TEST_CASE("the translator plays what it played before at every kind of rate", "[realtime]")
{
    pinTranslator("8 kHz", {}, {}, 8000.0);
    pinTranslator("44.1 kHz", {}, {}, 44100.0);
    TranslatorParams params;
    params.direct = 0.3;
    params.intensity = 6.0;
    pinTranslator("96 kHz", {}, params, 96000.0);
}

TEST_CASE("the translator guards, is bypassed and changes its actuator as before", "[realtime]")
{
    TranslatorSetup guarded;
    Profile& profile = guarded.profile.emplace(test::actuatorOf(Technology::vca, {67.0, 4.0}, {40.0, 400.0, 50.0}));
    profile.drive = {8.0, 1.0, 0.05, {}, 0.001, 0.0006}; // ohm, V, W, s, m, m
    TranslatorParams loud;
    loud.intensity = 9.0;
    pinTranslator("guarded", guarded, loud, 48000.0);
    pinTranslator("bypassed for a while", {}, {}, 48000.0,
                  [](Translator& translator, std::size_t done)
                  {
                      TranslatorParams params;
                      params.bypass = done > 3000 && done < 9000;
                      translator.setParams(params);
                  });
    int changes = 0;
    pinTranslator("changing its actuator", {}, {}, 48000.0,
                  [&](Translator& translator, std::size_t done)
                  {
                      if (done > 2000 && changes == 0)
                          ++changes, translator.setSetup(guarded);
                      if (done > 16000 && changes == 1)
                      {
                          ++changes;
                          auto hotter = guarded;
                          hotter.bands.bands = 4;
                          translator.setSetup(hotter);
                      }
                  });
    CHECK(changes == 2);
}

TEST_CASE("the translator's delay is that of its two filters, and its bypass is as late", "[realtime]")
{
    for (const double fs : {2000.0, 8000.0, 12000.0, 44100.0, 48000.0, 192000.0})
    {
        CAPTURE(fs);
        Translator translator;
        translator.prepare({fs, 64});
        const std::size_t factor = translatorFactor(fs);
        const WholeDecimator decimator(factor, fs, 1000.0);
        const PolyphaseInterpolator interpolator(factor, std::min(1000.0 * static_cast<double>(factor) / fs, 0.44));
        const std::size_t latency = decimator.latencyFrames() + interpolator.latencyFrames();
        CHECK(translator.latencyFrames() == latency);
        CHECK(static_cast<double>(latency) <= 0.0014 * fs);
        TranslatorParams params;
        params.bypass = true;
        translator.setParams(params);
        auto in = answerSound(fs);
        for (float& x : in)
            x *= 0.2f;
        std::vector<float> out(in.size());
        translator.process(std::span(in).first(700), std::span(out).first(700));
        translator.process(std::span(in).subspan(700), std::span(out).subspan(700));
        for (std::size_t n = 0; n < out.size(); ++n)
            REQUIRE(out[n] == (n < latency ? 0.0f : in[n - latency]));
    }
}

TEST_CASE("the bypass comes and goes within 10 ms, without a corner", "[realtime]")
{
    const double fs = 48000.0;
    Translator translator;
    translator.prepare({fs, 64});
    TranslatorParams params;
    params.intensity = -60.0;
    params.rumble.muted = params.texture.muted = params.transients.muted = true;
    translator.setParams(params);
    std::vector<float> in(4800, 0.5f), out(4800);
    translator.process(in, out);
    CHECK(out.back() == 0.0f);
    params.bypass = true;
    translator.setParams(params);
    translator.process(in, out);
    const auto shareAt = [](std::size_t n)
    {
        const double u = std::min(1.0, static_cast<double>(n + 1) / 480.0);
        return u * u * (3.0 - 2.0 * u);
    };
    for (std::size_t n = 0; n < out.size(); ++n)
        REQUIRE(static_cast<double>(out[n]) == Approx(0.5 * shareAt(n)).margin(1e-4));
    params.bypass = false;
    translator.setParams(params);
    translator.process(in, out);
    for (std::size_t n = 0; n < out.size(); ++n)
        REQUIRE(static_cast<double>(out[n]) == Approx(0.5 * (1.0 - shareAt(n))).margin(1e-4));
    // Before the first frame it is there at once.
    translator.reset();
    params.bypass = true;
    translator.setParams(params);
    translator.process(in, out);
    CHECK(out[translator.latencyFrames()] == 0.5f);
}

TEST_CASE("no frames change nothing, and a reset translator is a new one in its drive and its meters", "[realtime]")
{
    const auto in = answerSound(48000.0);
    TranslatorParams params;
    params.direct = 0.5;
    const auto run = [&](Translator& translator)
    {
        std::vector<float> out(in.size());
        translator.process(std::span(in).first(1000), std::span(out).first(1000));
        const auto before = translator.meters().read();
        translator.process(std::span<const float>{}, std::span<float>{});
        const auto after = translator.meters().read();
        CHECK(after.outputPeak == before.outputPeak);
        CHECK(after.gainReduction == before.gainReduction);
        translator.process(std::span(in).subspan(1000), std::span(out).subspan(1000));
        return out;
    };
    Translator fresh, used;
    for (Translator* translator : {&fresh, &used})
    {
        translator->prepare({48000.0, 512});
        translator->setParams(params);
    }
    const auto expected = run(fresh);
    for (const std::size_t frames : {std::size_t(3), std::size_t(2777), in.size()})
    {
        std::vector<float> out(frames);
        used.process(std::span(in).first(frames), out);
        used.reset();
        const auto reading = used.meters().read();
        CHECK(reading.events == 0);
        CHECK(reading.outputPeak == 0.0);
        CHECK(reading.bands == 6);
        CHECK(run(used) == expected);
    }
    CHECK(used.meters().read().events == fresh.meters().read().events);
    CHECK(used.meters().read().lastEventFrame == fresh.meters().read().lastEventFrame);
    CHECK(used.meters().read().bandLevels == fresh.meters().read().bandLevels);
}
