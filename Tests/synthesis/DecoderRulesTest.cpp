#include "support/Catch.h"
#include "support/ClipSamples.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/DecoderChoice.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
/// A clip with all that a decoder plays.
Clip decodedClip()
{
    Clip clip;
    clip.duration = 0.15;
    clip.bands = {
        {60.0, 80.0, 100.0, 0, {{0.0, 0.0}, {0.03, 0.5}, {0.03, 0.2}, {0.15, 0.4}}, {{0.0, 70.0}, {0.1, 99.0}}},
        {150.0, 200.0, 250.0, 1, {{0.02, 0.3}, {0.12, 0.1}}, {}},
        {350.0, 400.0, 450.0, 2, {{0.0, 0.0}, {0.1, 0.0}}, {{0.0, 390.0}}}};
    clip.centroid = {{0.0, 90.0}, {0.1, 180.0}};
    clip.transients = {{0.004, 0.9, 0.2}, {0.05, 0.7, 1.0}, {0.065, 0.8, 0.5}, {0.09, 0.0, 0.5}, {0.149, 0.6, 0.0}};
    clip.noise = {{100.0, 200.0, {{0.0, 0.05}, {0.15, 0.2}}}, {100.0, 200.0, {}}};
    return clip;
}

std::vector<float> heard(const Clip& clip, const DecoderParams& params, std::vector<DecoderChange> changes = {})
{
    Decoder decoder(clip, params, std::move(changes));
    std::vector<float> y(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(y);
    return y;
}

void pinSound(const std::string& name, const std::vector<float>& y)
{
    checkPinned("synthesis/decoded " + name, std::vector<double>(y.begin(), y.end()), 2e-6);
}

DecoderParams at8kHz()
{
    DecoderParams params;
    params.sampleRate = 8000.0;
    return params;
}
} // namespace

TEST_CASE("What a decoder does unless told otherwise", "[synthesis]")
{
    const DecoderParams params;
    CHECK(params.sampleRate == 48000.0);
    CHECK(params.carriers == CarrierMode::pitch);
    CHECK(test::asNumbers(params.followEnvelope, params.fullRate, params.transposition, params.stretch) ==
          test::Numbers{true, false, 0.0, 1.0});
    CHECK(test::asNumbers(params.gain, params.delay, params.headroom, params.reach) ==
          test::Numbers{1.0, 0.0, 0.0, 0.0});
    const DecoderReport report;
    CHECK(report.innerRate == 0.0);
    CHECK(report.carriers + report.silentBands + report.noiseBands + report.pulses + report.maskedTransients == 0);
    CHECK_FALSE(report.levelled);
    const DecoderParams thesis = thesisDecoderParams(44100.0);
    CHECK(thesis.sampleRate == 44100.0);
    CHECK(thesis.carriers == CarrierMode::fixed);
    CHECK_FALSE(thesis.followEnvelope);
    CHECK(thesis.fullRate);
    CHECK(thesis.pulses == PulseParams{TransientShape::square, 67.0, 1.0});
    CHECK(thesisDecoderParams(44100.0, 80.0).pulses.frequency == 80.0);
    CHECK(DecoderChoice{}.pulseCycles == 1.0);
}

TEST_CASE("The reference frequency is the geometric mean of the centres", "[synthesis]")
{
    Clip clip;
    CHECK(referenceFrequency(clip) == 1.0);
    clip.bands.resize(3);
    clip.bands[0].centreFrequency = 50.0;
    clip.bands[1].centreFrequency = 200.0;
    clip.bands[2].centreFrequency = 800.0;
    CHECK(referenceFrequency(clip) == Approx(200.0));
    clip.bands.resize(1);
    clip.bands[0].centreFrequency = 0.0;
    CHECK(referenceFrequency(clip) == Approx(1e-3));
}

TEST_CASE("The highest frequency is that of noise, centres and, as they are played, pitches or centroid", "[synthesis]")
{
    Clip clip;
    for (const CarrierMode mode : {CarrierMode::fixed, CarrierMode::pitch, CarrierMode::centroid, CarrierMode::none})
        CHECK(highestFrequency(clip, mode) == 50.0);
    clip.noise = {{10.0, 70.0, {}}};
    CHECK(highestFrequency(clip, CarrierMode::fixed) == 70.0);
    clip.bands = {{20.0, 100.0, 900.0, 0, {}, {{0.0, 300.0}, {1.0, 120.0}}}, {20.0, 25.0, 900.0, 0, {}, {}}};
    CHECK(highestFrequency(clip, CarrierMode::fixed) == 100.0);
    CHECK(highestFrequency(clip, CarrierMode::none) == 100.0);
    CHECK(highestFrequency(clip, CarrierMode::pitch) == 300.0);
    CHECK(highestFrequency(clip, CarrierMode::centroid) == 100.0);
    clip.centroid = {{0.0, 40.0}, {1.0, 75.0}};
    CHECK(highestFrequency(clip, CarrierMode::pitch) == 300.0);
    CHECK(highestFrequency(clip, CarrierMode::centroid) == Approx(150.0)); // 75 Hz times 100 / 50
    clip.bands.resize(1);
    clip.bands[0].centreFrequency = 0.5;
    clip.noise.clear();
    clip.centroid = {{0.0, 3.0}};
    CHECK(highestFrequency(clip, CarrierMode::centroid) == Approx(150.0)); // the mean counts 1 Hz at least
}

TEST_CASE("A clip is decoded as its method wants and the user changes it", "[synthesis]")
{
    Clip clip;
    DecoderParams base;
    base.sampleRate = 12345.0;
    base.transposition = 4.0;
    CHECK(decoderParamsFor(clip, base, {}, 80.0) == base);
    clip.encoder = {{"method", std::string("thesis")}};
    DecoderParams thesis = base;
    thesis.carriers = CarrierMode::fixed;
    thesis.followEnvelope = false;
    thesis.fullRate = true;
    thesis.pulses = {TransientShape::square, 80.0, 1.0};
    CHECK(decoderParamsFor(clip, base, {}, 80.0) == thesis);
    DecoderChoice choice;
    choice.carriers = CarrierMode::centroid;
    choice.followEnvelope = true;
    choice.pulseCycles = 3.0;
    choice.pulseFrequency = 90.0;
    thesis.carriers = CarrierMode::centroid;
    thesis.followEnvelope = true;
    CHECK(decoderParamsFor(clip, base, choice, 80.0) == thesis); // frequency and cycles are those of a chosen shape
    choice.pulseShape = TransientShape::sine;
    thesis.pulses = {TransientShape::sine, 90.0, 3.0};
    CHECK(decoderParamsFor(clip, base, choice, 80.0) == thesis);
    choice.pulseFrequency.reset();
    thesis.pulses.frequency = 80.0;
    CHECK(decoderParamsFor(clip, base, choice, 80.0) == thesis);
}

TEST_CASE("Parameters of a decoder end where they are said to, and what is not finite is the default", "[synthesis]")
{
    Clip clip = test::steadyClip(900.0, 0.5, 0.02);
    clip.transients = {{0.001, 0.5, 0.5}, {0.012, 0.4, 1.0}};
    struct Limit
    {
        const char* name;
        double DecoderParams::*value;
        double low, insideLow, high, insideHigh, usual;
    };
    DecoderParams base = at8kHz();
    base.pulses = {TransientShape::sine, 2000.0, 3.0};
    for (const Limit& limit : {Limit{"transposition", &DecoderParams::transposition, -96.0, -95.0, 96.0, 0.0, 0.0},
                               Limit{"gain", &DecoderParams::gain, 0.0, 0.1, 1000.0, 999.0, 1.0},
                               Limit{"stretch", &DecoderParams::stretch, 1e-3, 2e-1, 1e3, 9.9e2, 1.0}})
    {
        CAPTURE(limit.name);
        const auto with = [&](double value)
        {
            DecoderParams params = base;
            params.*limit.value = value;
            return heard(clip, params);
        };
        CHECK(with(limit.low - 0.0005) == with(limit.low));
        CHECK(with(-1e9) == with(limit.low));
        CHECK_FALSE(with(limit.insideLow) == with(limit.low));
        CHECK(with(limit.high + 1.0) == with(limit.high));
        CHECK(with(1e9) == with(limit.high));
        CHECK_FALSE(with(limit.insideHigh) == with(limit.high));
        for (const double odd : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
            CHECK(with(odd) == with(limit.usual));
    }
    const auto framesWith = [&](double delay)
    {
        DecoderParams params = base;
        params.delay = delay;
        return Decoder(clip, params).totalFrames();
    };
    CHECK(framesWith(0.0) == 160);
    CHECK(framesWith(-1.0) == 160);
    CHECK(framesWith(10.4 / 8000.0) == 170);
    CHECK(framesWith(10.6 / 8000.0) == 171);
    CHECK(framesWith(3600.0) == 160 + 3600 * 8000);
    CHECK(framesWith(3601.0) == 160 + 3600 * 8000);
    CHECK(framesWith(std::numeric_limits<double>::quiet_NaN()) == 160);

    const auto pulsed = [&](double PulseParams::*member, double value, TransientShape shape)
    {
        DecoderParams params = base;
        params.sampleRate = 96000.0;
        params.pulses.shape = shape;
        params.pulses.*member = value;
        Clip events = clip;
        events.duration = shape == TransientShape::sine ? 3.5 : 0.1;
        events.bands.clear();
        return heard(events, params);
    };
    const double odd = std::numeric_limits<double>::quiet_NaN();
    CHECK(pulsed(&PulseParams::frequency, 0.5, TransientShape::sine) ==
          pulsed(&PulseParams::frequency, 1.0, TransientShape::sine));
    CHECK_FALSE(pulsed(&PulseParams::frequency, 1.1, TransientShape::sine) ==
                pulsed(&PulseParams::frequency, 1.0, TransientShape::sine));
    CHECK(pulsed(&PulseParams::frequency, 21000.0, TransientShape::sine) ==
          pulsed(&PulseParams::frequency, 20000.0, TransientShape::sine));
    CHECK_FALSE(pulsed(&PulseParams::frequency, 19000.0, TransientShape::sine) ==
                pulsed(&PulseParams::frequency, 20000.0, TransientShape::sine));
    CHECK(pulsed(&PulseParams::frequency, odd, TransientShape::sine) ==
          pulsed(&PulseParams::frequency, 67.0, TransientShape::sine));
    CHECK(pulsed(&PulseParams::cycles, -1.0, TransientShape::sine) ==
          pulsed(&PulseParams::cycles, 0.0, TransientShape::sine));
    CHECK_FALSE(pulsed(&PulseParams::cycles, 0.2, TransientShape::sine) ==
                pulsed(&PulseParams::cycles, 0.0, TransientShape::sine));
    CHECK(pulsed(&PulseParams::cycles, 110.0, TransientShape::sine) ==
          pulsed(&PulseParams::cycles, 100.0, TransientShape::sine));
    CHECK_FALSE(pulsed(&PulseParams::cycles, 90.0, TransientShape::sine) ==
                pulsed(&PulseParams::cycles, 100.0, TransientShape::sine));
    CHECK(pulsed(&PulseParams::cycles, odd, TransientShape::sine) ==
          pulsed(&PulseParams::cycles, 1.0, TransientShape::sine));
    const TransientShape own = TransientShape::adaptive;
    CHECK(pulsed(&PulseParams::lowest, 0.5, own) == pulsed(&PulseParams::lowest, 1.0, own));
    CHECK(pulsed(&PulseParams::lowest, odd, own) == pulsed(&PulseParams::lowest, 1.0, own));
    CHECK(pulsed(&PulseParams::lowest, 21000.0, own) == pulsed(&PulseParams::lowest, 20000.0, own));
    CHECK_FALSE(pulsed(&PulseParams::lowest, 19000.0, own) == pulsed(&PulseParams::lowest, 20000.0, own));
    CHECK(pulsed(&PulseParams::highest, 0.5, own) == pulsed(&PulseParams::highest, 1.0, own)); // not below the lowest
    CHECK_FALSE(pulsed(&PulseParams::highest, 1.5, own) == pulsed(&PulseParams::highest, 1.0, own));
    CHECK(pulsed(&PulseParams::highest, odd, own) == pulsed(&PulseParams::highest, 20000.0, own));
    CHECK_FALSE(pulsed(&PulseParams::highest, 150.0, own) == pulsed(&PulseParams::highest, 20000.0, own));
}

TEST_CASE("Sinusoids are summed at 4 kHz or 3.3 times their highest frequency, at whole parts of the rate",
          "[synthesis]")
{
    const auto innerRate = [](const Clip& clip, const DecoderParams& params, std::vector<DecoderChange> changes = {})
    {
        return Decoder(clip, params, std::move(changes)).report().innerRate;
    };
    DecoderParams params;
    CHECK(innerRate(test::steadyClip(100.0, 0.5, 0.1), params) == 4000.0);
    CHECK(innerRate(test::steadyClip(1500.0, 0.5, 0.1), params) == Approx(48000.0 / 9.0)); // 4950 Hz and more
    params.sampleRate = 44100.0;
    CHECK(innerRate(test::steadyClip(100.0, 0.5, 0.1), params) == Approx(44100.0 / 11.0));
    params.sampleRate = 7900.0;
    CHECK(innerRate(test::steadyClip(100.0, 0.5, 0.1), params) == 7900.0);
    params.sampleRate = 2000.0;
    CHECK(innerRate(test::steadyClip(100.0, 0.5, 0.1), params) == 2000.0);
    params.sampleRate = 48000.0;
    params.reach = 1500.0;
    CHECK(innerRate(test::steadyClip(100.0, 0.5, 0.1), params) == Approx(48000.0 / 9.0));
    params.reach = 0.0;
    params.transposition = 12.0;
    CHECK(innerRate(test::steadyClip(750.0, 0.5, 0.1), params) == Approx(48000.0 / 9.0));
    params.transposition = -12.0;
    params.headroom = 24.0;
    CHECK(innerRate(test::steadyClip(750.0, 0.5, 0.1), params) == Approx(48000.0 / 9.0));
    params.headroom = -5.0; // counts 0
    CHECK(innerRate(test::steadyClip(3000.0, 0.5, 0.1), params) == Approx(48000.0 / 9.0));
    params.headroom = 0.0;
    CHECK(innerRate(test::steadyClip(750.0, 0.5, 0.1), params, {{0.01, 12.0, 1.0}, {0.05, -50.0, 1.0}}) ==
          Approx(48000.0 / 9.0));
    CHECK(innerRate(test::steadyClip(6.0, 0.5, 0.1), params, {{0.01, 500.0, 1.0}}) == 48000.0);
    CHECK(innerRate(test::steadyClip(750.0, 0.5, 0.1), params,
                    {{0.01, std::numeric_limits<double>::infinity(), 1.0}}) == 4000.0);
    params.fullRate = true;
    CHECK(innerRate(test::steadyClip(100.0, 0.5, 0.1), params) == 48000.0);
    params.fullRate = false;
    params.sampleRate = 768000.0;
    params.transposition = -96.0;
    params.reach = 1e6; // 400 kHz are the most
    CHECK(innerRate(test::steadyClip(100.0, 0.5, 0.1), params) == Approx(768000.0 / 148.0));
}

TEST_CASE("A steady tone comes out as its sine, in time, at the rate itself and below it", "[synthesis]")
{
    for (const bool full : {true, false})
        for (const double fs : {8000.0, 48000.0})
        {
            CAPTURE(full, fs);
            DecoderParams params;
            params.sampleRate = fs;
            params.fullRate = full;
            params.gain = 2.0;
            params.delay = 0.01;
            Clip clip = test::steadyClip(100.0, 0.25, 0.2);
            clip.bands.push_back(clip.bands[0]);
            clip.bands[1].pitch = {{0.0, 130.0}};
            const auto y = heard(clip, params);
            REQUIRE(y.size() == static_cast<std::size_t>(0.21 * fs + 0.5));
            const auto from = static_cast<std::size_t>(0.01 * fs);
            for (std::size_t n = 0; n < from; ++n)
                REQUIRE(y[n] == 0.0f);
            const double margin = full ? 2e-6 : 2e-3;
            // What is not at the full rate settles and ends with its filter.
            for (std::size_t n = full ? from : from + static_cast<std::size_t>(0.03 * fs); n < y.size(); ++n)
            {
                const double t = static_cast<double>(n - from) / fs;
                const double wanted =
                    0.5 * (std::sin(2.0 * std::numbers::pi * 100.0 * t) + std::sin(2.0 * std::numbers::pi * 130.0 * t));
                REQUIRE(static_cast<double>(y[n]) == Approx(wanted).margin(margin));
            }
        }
}

TEST_CASE("Bands stand at their centre, pitch or part of the centroid, 5 Hz to 0.45 of the rate", "[synthesis]")
{
    DecoderParams params = at8kHz();
    params.fullRate = true;
    const auto same = [&](CarrierMode mode, const Clip& clip, double first, double second)
    {
        params.carriers = mode;
        const auto y = heard(clip, params);
        for (std::size_t n = 0; n < y.size(); ++n)
        {
            const double t = static_cast<double>(n) / 8000.0;
            const double wanted = mode == CarrierMode::none ? 0.5
                                                            : 0.25 * (std::sin(2.0 * std::numbers::pi * first * t) +
                                                                      std::sin(2.0 * std::numbers::pi * second * t));
            if (static_cast<double>(y[n]) != Approx(wanted).margin(2e-6))
                return false;
        }
        return y.size() == 800;
    };
    Clip clip = test::steadyClip(100.0, 0.25, 0.1);
    clip.bands.push_back({400.0, 400.0, 400.0, 0, {{0.0, 0.25}}, {{0.0, 330.0}}});
    clip.centroid = {{0.0, 120.0}};
    CHECK(same(CarrierMode::fixed, clip, 100.0, 400.0));
    CHECK(same(CarrierMode::pitch, clip, 100.0, 330.0));
    CHECK(same(CarrierMode::centroid, clip, 60.0, 240.0)); // the mean of the centres is 200 Hz
    CHECK(same(CarrierMode::none, clip, 0.0, 0.0));
    params.transposition = 12.0;
    CHECK(same(CarrierMode::fixed, clip, 200.0, 800.0));
    params.transposition = 48.0;
    CHECK(same(CarrierMode::fixed, clip, 1600.0, 3600.0));
    params.transposition = -60.0;
    CHECK(same(CarrierMode::fixed, clip, 5.0, 12.5));
    clip.centroid.clear();
    params.transposition = 0.0;
    CHECK(same(CarrierMode::centroid, clip, 100.0, 400.0));
}

TEST_CASE("Curves of bands follow stretch and gain, and a silent band is not played", "[synthesis]")
{
    DecoderParams params = at8kHz();
    params.fullRate = true;
    params.stretch = 2.0;
    params.gain = 3.0;
    params.carriers = CarrierMode::none;
    Clip clip = test::steadyClip(100.0, 0.0, 0.1);
    clip.bands[0].amplitude = {{0.0, 0.0}, {0.05, 0.2}, {0.1, 0.1}};
    const auto y = heard(clip, params);
    REQUIRE(y.size() == 1600);
    for (std::size_t n = 0; n < y.size(); ++n)
        REQUIRE(static_cast<double>(y[n]) ==
                Approx(3.0 * valueAt(clip.bands[0].amplitude, static_cast<double>(n) / 16000.0)).margin(1e-6));
    Clip silent = decodedClip();
    const DecoderReport report = Decoder(silent, at8kHz()).report();
    CHECK(report.carriers == 2);
    CHECK(report.silentBands == 2); // and the noise without a curve
    CHECK(report.noiseBands == 1);
    CHECK(report.pulses == 4);
    CHECK(report.maskedTransients == 1);
    CHECK_FALSE(report.levelled);
}

TEST_CASE("A clip with everything sounds as it did, in every mode and at every speed", "[synthesis]")
{
    const Clip clip = decodedClip();
    Clip levelled = clip;
    levelled.envelope = {{0.0, 0.1}, {0.06, 0.5}, {0.1, 0.5}, {0.1, 0.05}};
    for (const bool envelope : {false, true})
    {
        const Clip& played = envelope ? levelled : clip;
        const std::string what = envelope ? ", levelled" : "";
        DecoderParams params = at8kHz();
        pinSound("clip" + what, heard(played, params));
        params.sampleRate = 44100.0;
        params.transposition = 5.0;
        params.stretch = 1.3;
        params.gain = 0.7;
        params.delay = 0.0123;
        pinSound("clip, higher and slower" + what, heard(played, params));
        params.carriers = CarrierMode::centroid;
        params.variation = {0.4, VariationScope::breakpoint, 5};
        params.pulses = {TransientShape::square, 90.0, 1.5};
        pinSound("clip by its centroid, varied" + what, heard(played, params));
        params.carriers = CarrierMode::none;
        params.followEnvelope = false;
        params.pulses = {TransientShape::adaptive, 67.0, 1.0, 120.0, 210.0};
        pinSound("clip of strengths" + what, heard(played, params));
        params = at8kHz();
        params.transposition = 60.0; // all ends at 0.45 of the rate
        pinSound("clip far too high" + what, heard(played, params));
        params.transposition = 3.0;
        params.delay = 0.005;
        pinSound(
            "clip with changes" + what,
            heard(played, params,
                  {{0.0, -2.0, 1.1}, {0.021, 7.0, 0.8}, {0.0213, 5.0, 2.0}, {0.09, -5.0, 0.5}, {0.1, 120.0, 1e-9}}));
        pinSound("clip with early changes" + what, heard(played, params, {{-1.0, 4.0, 1.0}, {0.002, 1.0, 1.5}}));
    }
}

TEST_CASE("Changes that are not finite are as if they were not there", "[synthesis]")
{
    const double odd = std::numeric_limits<double>::quiet_NaN();
    const auto plain = heard(decodedClip(), at8kHz(), {{0.05, 3.0, 1.2}});
    CHECK(heard(decodedClip(), at8kHz(), {{odd, 5.0, 1.0}, {0.01, odd, 1.0}, {0.02, 5.0, odd}, {0.05, 3.0, 1.2}}) ==
          plain);
    CHECK_FALSE(heard(decodedClip(), at8kHz()) == plain);
    // Scheduled ones end where parameters do.
    CHECK(heard(test::steadyClip(6.0, 0.5, 0.1), at8kHz(), {{0.01, 300.0, 1.0}}) ==
          heard(test::steadyClip(6.0, 0.5, 0.1), at8kHz(), {{0.01, 96.0, 1.0}}));
    CHECK(Decoder(test::steadyClip(100.0, 0.5, 0.1), at8kHz(), {{0.05, 0.0, 1e9}}).totalFrames() == 400 + 400 * 1000);
    CHECK(Decoder(test::steadyClip(100.0, 0.5, 0.1), at8kHz(), {{0.05, 0.0, 1e-9}}).totalFrames() == 400);
    CHECK(Decoder(test::steadyClip(100.0, 0.5, 1.0), at8kHz(), {{0.05, 0.0, 0.0}}).totalFrames() == 408);
}

TEST_CASE("Live changes move the end, drop scheduled ones, and sound as they did", "[synthesis]")
{
    Clip clip = decodedClip();
    for (const bool envelope : {false, true})
    {
        if (envelope)
            clip.envelope = {{0.0, 0.1}, {0.06, 0.5}, {0.1, 0.5}, {0.1, 0.05}};
        DecoderParams params = at8kHz();
        params.delay = 0.004;
        params.headroom = 24.0;
        Decoder decoder(clip, params, {{0.08, -7.0, 3.0}});
        std::vector<float> y(3000, 9.0f);
        std::vector<double> ends = {static_cast<double>(decoder.totalFrames())};
        std::size_t done = 0;
        const auto next = [&](std::size_t n)
        {
            decoder.process(std::span(y).subspan(done, n));
            done += n;
            ends.push_back(static_cast<double>(decoder.totalFrames()));
        };
        next(10);
        decoder.change(5.0, 1.2); // while it is still silent
        next(90);
        decoder.change(12.0, 0.8);
        next(200);
        decoder.change(std::numeric_limits<double>::quiet_NaN(), 1.0);
        decoder.change(1.0, std::numeric_limits<double>::infinity());
        next(77);
        for (int i = 0; i < 100; ++i) // more than are remembered
        {
            decoder.change(0.1 * i, 1.0 + 0.01 * i);
            next(3);
        }
        decoder.change(-200.0, 0.5);
        next(500);
        next(1823);
        pinSound(std::string("clip with live changes") + (envelope ? ", levelled" : ""), y);
        checkPinned(std::string("synthesis/ends of a clip with live changes") + (envelope ? ", levelled" : ""), ends);
        // From the start again there are only the scheduled changes.
        decoder.reset();
        std::vector<float> again(static_cast<std::size_t>(decoder.totalFrames()));
        decoder.process(again);
        CHECK(again == heard(clip, params, {{0.08, -7.0, 3.0}}));
    }
}

TEST_CASE("Two events that stand near each other are both shortened, and one before a change is as it was",
          "[synthesis]")
{
    Clip clip;
    clip.duration = 0.1;
    clip.transients = {{0.01, 0.5, 0.5}, {0.03, 0.5, 0.5}};
    DecoderParams params;
    const auto y = heard(clip, params);
    for (std::size_t n = 0; n < 900; ++n)
        REQUIRE(y[480 + n] == y[1440 + n]);
    const auto changed = heard(clip, params, {{0.025, 12.0, 1.0}});
    for (std::size_t n = 0; n < 1200; ++n)
        REQUIRE(changed[n] == y[n]);
    CHECK_FALSE(changed == y);
}
