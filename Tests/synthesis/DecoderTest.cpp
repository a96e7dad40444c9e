#include "support/Catch.h"
#include "support/ClipSamples.h"
#include "support/Golden.h"
#include "support/HeapGuard.h"
#include "support/Measure.h"
#include "support/Render.h"

#include <pacini/synthesis/Decoder.h>

#include <cmath>
#include <numbers>

using namespace pacini;
using test::render;

namespace
{
std::vector<float> render(const Clip& clip, const DecoderParams& params)
{
    Decoder decoder(clip, params);
    return test::render(decoder, 4096);
}

Clip toneClip(double frequency, double amplitude, double duration)
{
    Clip clip;
    clip.duration = duration;
    clip.bands = {{frequency * 0.9, frequency, frequency * 1.1, 0, {{0.0, amplitude}}, {}}};
    return clip;
}

} // namespace

TEST_CASE("The thesis readings of the decoder give the golden signals", "[synthesis][golden]")
{
    const auto golden = test::golden("resynthesis");
    const auto& c = golden["clip"];
    Clip clip;
    clip.duration = c["duration"].get<double>();
    const auto curve = [](const nlohmann::json& j)
    {
        Curve result;
        for (std::size_t i = 0; i < j["t"].size(); ++i)
            result.push_back({j["t"][i].get<double>(), j["v"][i].get<double>()});
        return result;
    };
    for (const auto& b : c["bands"])
        clip.bands.push_back({0.0, b["f"].get<double>(), 1000.0, 0, curve(b), {}});
    clip.centroid = curve(c["centroid"]);
    for (const auto& t : c["transients"])
        clip.transients.push_back({t[0].get<double>(), t[1].get<double>(), 0.5});

    for (const auto& g : golden["cases"])
    {
        if (g.contains("phases"))
            continue; // start phases are not part of a clip
        CAPTURE(g["mode"].get<std::string>(), g["transients"].get<bool>());
        auto params = thesisDecoderParams(golden["fs"].get<double>());
        if (g["mode"] == "centroid")
            params.carriers = CarrierMode::centroid;
        Clip wanted = clip;
        if (!g["transients"].get<bool>())
            wanted.transients.clear();
        const auto y = render(wanted, params);
        REQUIRE(y.size() == g["y"].size());
        for (std::size_t n = 0; n < y.size(); ++n)
            REQUIRE(std::abs(static_cast<double>(y[n]) - g["y"][n].get<double>()) < golden["tol"].get<double>());
    }
    const auto pulse = makePulse({TransientShape::square, 67.0, 1.0}, 0.0, 1.0, 48000.0, 1.0);
    CHECK(pulse.frames == golden["square_67_48000"]["n"].get<std::size_t>());
    std::vector<float> samples(pulse.frames, 0.0f);
    PulseVoice(pulse).addTo(samples, 1.0);
    CHECK(std::count_if(samples.begin(), samples.end(), [](float v) { return v > 0.0f; }) ==
          golden["square_67_48000"]["pos"].get<int>());
}

TEST_CASE("The output does not depend on the block size, and reset starts over", "[synthesis]")
{
    for (std::uint64_t seed = 1; seed < 12; ++seed)
    {
        CAPTURE(seed);
        DecoderParams params;
        params.sampleRate = seed % 2 == 0 ? 44100.0 : 8000.0;
        params.delay = 0.01 * static_cast<double>(seed % 3);
        params.variation = {0.3, VariationScope::breakpoint, seed};
        Decoder decoder(test::randomClip(seed), params);
        const auto whole = render(decoder, 1u << 20);
        for (std::size_t block : {std::size_t(1), std::size_t(7), std::size_t(64), std::size_t(511)})
        {
            decoder.reset();
            REQUIRE(render(decoder, block) == whole);
        }
    }
}

TEST_CASE("Playing makes no heap traffic", "[synthesis][realtime]")
{
    Decoder decoder(test::randomClip(6), {});
    std::vector<float> block(512);
    const test::HeapGuard guard;
    for (int i = 0; i < 200; ++i)
        decoder.process(block);
    decoder.reset();
    decoder.process(block);
    CHECK(guard.traffic() == 0);
}

TEST_CASE("A band sounds at its frequency and amplitude at every output rate", "[synthesis]")
{
    for (double fs : {2000.0, 8000.0, 11025.0, 44100.0, 48000.0, 192000.0})
    {
        CAPTURE(fs);
        DecoderParams params;
        params.sampleRate = fs;
        const auto y = render(toneClip(200.0, 0.8, 1.0), params);
        REQUIRE(y.size() == static_cast<std::size_t>(fs));
        double re = 0.0, im = 0.0;
        const auto from = static_cast<std::size_t>(0.25 * fs), to = static_cast<std::size_t>(0.75 * fs);
        for (std::size_t n = from; n < to; ++n)
        {
            const double angle = 2.0 * std::numbers::pi * 200.0 * static_cast<double>(n) / fs;
            re += static_cast<double>(y[n]) * std::cos(angle);
            im += static_cast<double>(y[n]) * std::sin(angle);
        }
        const double scale = 2.0 / static_cast<double>(to - from);
        CHECK(im * scale == Approx(0.8).epsilon(1e-3)); // a sine, in phase with the clip's start
        CHECK(std::abs(re * scale) < 2e-3);
        CHECK(test::rms(std::span(y).subspan(from, to - from)) == Approx(0.8 / std::sqrt(2.0)).epsilon(1e-3));
    }
}

TEST_CASE("Transposition moves pitch, stretch moves time, delay shifts, gain scales", "[synthesis]")
{
    Clip clip = toneClip(100.0, 0.5, 1.0);
    clip.bands[0].amplitude = {{0.0, 0.0}, {0.5, 0.5}, {0.5, 0.0}, {1.0, 0.0}};
    DecoderParams params;
    params.transposition = 12.0;
    params.stretch = 2.0;
    params.delay = 0.25;
    params.gain = 0.5;
    const auto y = render(clip, params);
    REQUIRE(y.size() == 108000);
    CHECK(test::rms(std::span(y).first(12000)) == 0.0);
    int crossings = 0;
    for (std::size_t n = 36001; n < 60000; ++n)
        crossings += (y[n] >= 0.0f) != (y[n - 1] >= 0.0f) ? 1 : 0;
    CHECK(std::abs(crossings - 200) <= 1); // 200 Hz for half a second
    CHECK(*std::max_element(y.begin(), y.end()) == Approx(0.25).epsilon(0.01));
    CHECK(test::rms(std::span(y).subspan(60100, 40000)) < 1e-4);
}

TEST_CASE("What transposition pushes out of the range does not fold back", "[synthesis]")
{
    DecoderParams params;
    params.sampleRate = 4000.0;
    params.transposition = 36.0;
    const auto y = render(toneClip(900.0, 1.0, 0.5), params);
    for (float v : y)
        REQUIRE(std::abs(v) <= 1.2f);
}

TEST_CASE("The sum of bands follows the envelope where there is one", "[synthesis]")
{
    Clip clip = toneClip(100.0, 0.3, 1.0);
    clip.bands.push_back({117.0, 120.0, 130.0, 0, {{0.0, 0.3}}, {}}); // beats at 20 Hz
    clip.envelope = {{0.0, 0.4}, {0.5, 0.4}, {1.0, 0.1}};
    DecoderParams params;
    const auto smoothed = [](const std::vector<float>& y)
    {
        std::vector<double> e;
        for (std::size_t i = 0; i + 960 <= y.size(); i += 480)
            e.push_back(std::sqrt(2.0) * test::rms(std::span(y).subspan(i, 960)));
        return e;
    };
    const auto levelled = smoothed(render(clip, params));
    params.followEnvelope = false;
    const auto plain = smoothed(render(clip, params));
    double worstLevelled = 0.0, worstPlain = 0.0;
    for (std::size_t i = 3; i + 3 < levelled.size(); ++i)
    {
        const double wanted = valueAt(clip.envelope, 0.01 * static_cast<double>(i + 1));
        worstLevelled = std::max(worstLevelled, std::abs(20.0 * std::log10(levelled[i] / wanted)));
        worstPlain = std::max(worstPlain, std::abs(20.0 * std::log10(plain[i] / wanted)));
    }
    CHECK(worstLevelled < 2.5);
    CHECK(worstPlain > 10.0);
}

TEST_CASE("A decoder says whether it levels the bands, and what it leaves out", "[synthesis]")
{
    Clip clip = toneClip(100.0, 0.3, 1.0);
    clip.bands.push_back({180.0, 200.0, 220.0, 0, {{0.0, 0.0}, {1.0, 0.0}}, {}});
    clip.transients = {{0.2, 0.5, 0.5}, {0.6, 0.0, 0.5}};
    DecoderParams params;
    CHECK_FALSE(Decoder(clip, params).report().levelled);
    CHECK(Decoder(clip, params).report().carriers == 1);
    CHECK(Decoder(clip, params).report().silentBands == 1);
    CHECK(Decoder(clip, params).report().pulses == 1);
    CHECK(Decoder(clip, params).report().maskedTransients == 1);
    clip.envelope = {{0.0, 0.3}};
    CHECK(Decoder(clip, params).report().levelled);
    CHECK(Decoder(clip, params).report().maskedTransients == 2); // bands peak at twice the envelope
    params.followEnvelope = false;
    CHECK_FALSE(Decoder(clip, params).report().levelled);
}

TEST_CASE("An event tops the bands up to its amplitude and costs nothing where they reach it", "[synthesis]")
{
    Clip clip;
    clip.duration = 0.4;
    clip.envelope = {{0.0, 0.0}, {0.4, 0.0}};
    clip.transients = {{0.1, 0.6, 0.5}};
    const auto alone = render(clip, {});
    CHECK(*std::max_element(alone.begin(), alone.end()) == Approx(0.6).epsilon(0.15));
    clip.envelope = {{0.0, 0.7}, {0.4, 0.7}};
    const auto masked = render(clip, {});
    CHECK(test::rms(masked) == 0.0);
}

TEST_CASE("Fast events keep apart: adaptive pulses end before the next begins", "[synthesis]")
{
    for (double rate : {5.0, 30.0, 60.0, 80.0})
        for (double sharpness : {0.0, 1.0})
        {
            const auto pulse = makePulse({}, sharpness, 1.0 / rate, 48000.0, 1.0);
            CHECK(static_cast<double>(pulse.frames) <= std::max(0.0051, 0.62 / rate) * 48000.0);
        }
}

TEST_CASE("An adaptive pulse is its closed form", "[synthesis]")
{
    for (double gap : {0.02, 1.0})
    {
        const auto pulse = makePulse({}, 0.7, gap, 192000.0, 1.0);
        std::vector<float> samples(pulse.frames + 5, 0.0f);
        PulseVoice(pulse).addTo(samples, 1.0);
        for (std::size_t n = 0; n < samples.size(); ++n)
        {
            const double t = static_cast<double>(n) + 0.5;
            const double wanted =
                n < pulse.frames ? std::pow(std::sin(std::numbers::pi * t / static_cast<double>(pulse.frames)), 2) *
                                       std::sin(2.0 * std::numbers::pi * pulse.cyclesPerFrame * t)
                                 : 0.0;
            REQUIRE(std::abs(static_cast<double>(samples[n]) - wanted) < 1e-7);
        }
    }
}

TEST_CASE("Variation is reproducible, bounded and absent at 0", "[synthesis]")
{
    const Clip clip = test::randomClip(21);
    CHECK(vary(clip, {0.0, VariationScope::breakpoint, 1}) == clip);
    CHECK(vary(clip, {0.5, VariationScope::breakpoint, 1}) == vary(clip, {0.5, VariationScope::breakpoint, 1}));
    CHECK_FALSE(vary(clip, {0.5, VariationScope::breakpoint, 1}) == vary(clip, {0.5, VariationScope::breakpoint, 2}));
    for (auto scope : {VariationScope::breakpoint, VariationScope::band})
    {
        const Clip varied = vary(clip, {0.25, scope, 3});
        for (std::size_t k = 0; k < clip.bands.size(); ++k)
        {
            double factor = -1.0;
            for (std::size_t i = 0; i < clip.bands[k].amplitude.size(); ++i)
            {
                const double a = clip.bands[k].amplitude[i].value, b = varied.bands[k].amplitude[i].value;
                REQUIRE(b >= 0.7499 * a);
                REQUIRE(b <= 1.2501 * a);
                if (scope == VariationScope::band && a > 0.0)
                {
                    if (factor < 0.0)
                        factor = b / a;
                    REQUIRE(b / a == Approx(factor));
                }
            }
        }
    }
}

TEST_CASE("Any valid clip gives finite output under any parameters", "[synthesis]")
{
    for (std::uint64_t seed = 100; seed < 160; ++seed)
    {
        CAPTURE(seed);
        Random random(seed);
        DecoderParams params;
        params.sampleRate = random.uniform(1000.0, 250000.0);
        params.transposition = random.uniform(-100.0, 100.0);
        params.stretch = std::pow(10.0, random.uniform(-4.0, 0.3));
        params.gain = random.uniform(0.0, 10.0);
        params.carriers = static_cast<CarrierMode>(static_cast<int>(random.uniform(0.0, 3.0)));
        params.followEnvelope = random.uniform() < 0.5;
        params.pulses = {static_cast<TransientShape>(static_cast<int>(random.uniform(0.0, 3.0))),
                         random.uniform(-10.0, 1e6), random.uniform(-1.0, 200.0)};
        for (float v : render(test::randomClip(seed), params))
            REQUIRE(std::isfinite(v));
    }
    CHECK(render(Clip{}, {}).empty());
}
