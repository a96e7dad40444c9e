#include "analysis/SteadyBands.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/Encoder.h>
#include <pacini/analysis/HeardInstead.h>
#include <pacini/analysis/HeardSurvey.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

/// Half as loud in the second half. Of the power, `highShare` lies above.
std::vector<HeardFrame> heardOf(float highShare)
{
    std::vector<HeardFrame> heard(steadyFrames, {2.0f, 2.0f, 0.0f, 0.02f, 0.02f * highShare});
    for (std::size_t i = steadyFrames / 2; i < steadyFrames; ++i)
        heard[i].loudness = 1.0f;
    return heard;
}

/// A whole sound.
void blend(double audible, BandAnalysisResult& found, std::span<const HeardFrame> heard,
           std::span<const TrainSpan> trains = {})
{
    SoundScale scale{found.peak, 0.0, 0.0};
    for (const HeardFrame& frame : heard)
    {
        scale.loudest = std::max(scale.loudest, static_cast<double>(frame.loudness));
        scale.strongest = std::max(scale.strongest, static_cast<double>(frame.power));
    }
    HeardInstead(steadyEdges, audible).next(found, heard, heard.size(), trains, scale);
}
} // namespace

TEST_CASE("Where most of what is heard lies above, loudness is the level and the bands keep a quarter", "[analysis]")
{
    BandAnalysisResult found = steadyBands(0.8f);
    blend(1.0, found, heardOf(0.9f));
    CHECK(found.heardShare[100] == 1.0f);
    CHECK(found.envelope[100] == Approx(0.8));
    CHECK(found.envelope[steadyFrames - 100] == Approx(0.8 * (0.5 - 0.03) / 0.97));
    // A quarter of the lowest band at most, and less where the level is lower than a quarter of all bands.
    const double all = std::sqrt(3.0) * 0.8;
    CHECK(found.tracks[0].amplitude[25] == Approx(0.2));
    CHECK(found.tracks[0].amplitude[steadyFrames / 4 - 25] == Approx(0.2));
    // The tone of 150 Hz, which only the second band holds, brings what they lack.
    CHECK(found.tracks[1].amplitude[25] == Approx(std::sqrt(0.04 + 0.64 - 0.0625 * all * all)));
    CHECK(found.tracks[1].frequency[25] < 170.0f);
    CHECK(found.tracks[1].frequency[25] > 150.0f);
    // Bands of ten times the level are turned down to it.
    BandAnalysisResult loud = steadyBands(8.0f);
    blend(1.0, loud, heardOf(0.9f));
    CHECK(loud.tracks[0].amplitude[25] == Approx(0.8 / std::sqrt(3.0)));
    CHECK(loud.tracks[1].amplitude[25] == Approx(0.8 / std::sqrt(3.0)));
}

TEST_CASE("What is hardly heard beside the loudest is not felt", "[analysis]")
{
    for (const double share : {0.029, 0.031, 0.1})
    {
        CAPTURE(share);
        auto heard = heardOf(1.0f);
        for (std::size_t i = steadyFrames / 2; i < steadyFrames; ++i)
            heard[i].loudness = static_cast<float>(2.0 * share);
        BandAnalysisResult found = steadyBands(0.001f);
        blend(1.0, found, heard);
        const double level = share < 0.03 ? 0.0 : 0.8 * (share - 0.03) / 0.97;
        CHECK(found.envelope[steadyFrames - 100] == Approx(level).margin(1e-6));
        CHECK(found.tracks[1].amplitude[steadyFrames / 4 - 25] == Approx(level).margin(3e-4));
    }
}

TEST_CASE("Where little of what is heard lies above, nothing changes", "[analysis]")
{
    for (const float share : {0.0f, 0.19f})
    {
        BandAnalysisResult found = steadyBands(0.3f);
        const BandAnalysisResult before = found;
        blend(1.0, found, heardOf(share));
        CHECK(found.envelope == before.envelope);
        for (std::size_t k = 0; k < steadyEdges.size(); ++k)
        {
            CHECK(found.tracks[k].amplitude == before.tracks[k].amplitude);
            CHECK(found.tracks[k].frequency == before.tracks[k].frequency);
        }
        CHECK(found.heardShare == std::vector<float>(steadyFrames, 0.0f));
    }
}

TEST_CASE("What is loud for a moment does not change what leads some seconds away", "[analysis]")
{
    auto heard = heardOf(0.0f);
    for (std::size_t i = 1000; i < 1020; ++i)
        heard[i].highPower = heard[i].power = 2.0f;
    BandAnalysisResult found = steadyBands(0.3f);
    blend(0.5, found, heard);
    CHECK(found.heardShare[1010] == 0.5f);
    CHECK(found.heardShare[850] == 0.5f);
    CHECK(found.heardShare[100] == 0.0f);
    CHECK(found.heardShare[1900] == 0.0f);
}

TEST_CASE("Even trains are left to their pulses", "[analysis]")
{
    BandAnalysisResult found = steadyBands(0.3f);
    blend(1.0, found, heardOf(1.0f), std::vector<TrainSpan>{{2.0, 3.0}, {9.99, 12.0}});
    CHECK(found.heardShare[391] == 1.0f);
    CHECK(found.heardShare[396] == Approx(0.5));
    CHECK(found.heardShare[400] == 0.0f);
    CHECK(found.envelope[500] == 0.3f);
    CHECK(found.heardShare[600] == 0.0f);
    CHECK(found.heardShare[604] == Approx(0.5));
    CHECK(found.heardShare[608] == Approx(1.0));
    CHECK(found.heardShare.back() == 0.0f);
}

TEST_CASE("The peak is that of what is felt in the end", "[analysis]")
{
    const auto peakOf = [](float highShare, double peak)
    {
        return HeardSurvey(1.0, HeardRole::instead).finish(heardOf(highShare), {}, peak).peak;
    };
    CHECK(peakOf(0.0f, 0.1) == 0.1);
    CHECK(peakOf(0.9f, 0.1) == Approx(std::sqrt(2.0 * 0.02)));
    CHECK(peakOf(0.9f, 1.0) == 1.0);
}

TEST_CASE("In parts a sound is blended as in one", "[analysis]")
{
    auto heard = heardOf(0.3f);
    for (std::size_t i = 0; i < steadyFrames; i += 7)
        heard[i] = {1.5f, 1.0f, 0.3f, 0.05f, 0.03f};
    const std::vector<TrainSpan> trains = {{2.0, 3.0}, {4.5, 5.5}};
    const SoundScale scale{1.0, 2.0, 0.05};
    BandAnalysisResult whole = steadyBands(0.3f);
    HeardInstead(steadyEdges, 1.0).next(whole, heard, steadyFrames, trains, scale);

    constexpr std::size_t cut = 1000; // at 5 s; what comes later is looked at to the end, which is 5 s away
    BandAnalysisResult rest = steadyBands(0.3f);
    HeardInstead parts(steadyEdges, 1.0);
    parts.next(rest, heard, cut + 1, trains, scale);
    BandAnalysisResult first = rest.takeFirst(5.0);
    std::vector<TrainSpan> later = trains;
    for (TrainSpan& train : later)
        train = {train.first - 5.0, train.last - 5.0};
    parts.next(rest, std::span(heard).subspan(cut), steadyFrames - cut, later, scale);
    const auto joined = [](std::vector<float> a, const std::vector<float>& b)
    {
        CHECK(a.back() == b.front());
        a.insert(a.end(), b.begin() + 1, b.end());
        return a;
    };
    CHECK(joined(first.envelope, rest.envelope) == whole.envelope);
    CHECK(joined(first.heardShare, rest.heardShare) == whole.heardShare);
    for (std::size_t k = 0; k < steadyEdges.size(); ++k)
    {
        CHECK(joined(first.tracks[k].amplitude, rest.tracks[k].amplitude) == whole.tracks[k].amplitude);
        CHECK(joined(first.tracks[k].frequency, rest.tracks[k].frequency) == whole.tracks[k].frequency);
    }
}

TEST_CASE("Silence and a sound that is shorter than its bands leave them alone", "[analysis]")
{
    BandAnalysisResult found = steadyBands(0.3f);
    const auto before = found.envelope;
    blend(1.0, found, {});
    blend(1.0, found, std::vector<HeardFrame>(steadyFrames));
    CHECK(found.envelope == before);
    auto heard = heardOf(1.0f);
    heard.resize(300);
    blend(1.0, found, heard);
    CHECK(found.envelope[299] == Approx(0.8));
    CHECK(found.envelope[300] == 0.3f);
    CHECK(found.heardShare.size() == steadyFrames);
    CHECK(found.heardShare[300] == 0.0f);
}

TEST_CASE("Uneven drops each rise out of the level, an even train is held down between its hits", "[analysis]")
{
    const auto encoded = [](std::span<const double> times)
    {
        std::vector<float> x(48000);
        for (std::size_t k = 0; k < times.size(); ++k)
            for (std::size_t n = 0; n < 960; ++n)
            {
                const double t = static_cast<double>(n) / 48000.0;
                x[static_cast<std::size_t>(48000.0 * times[k]) + n] +=
                    static_cast<float>(0.8 * std::exp(-t / 0.002) * std::sin(2.0 * std::numbers::pi * 5000.0 * t));
            }
        EncoderParams params;
        params.heard = HeardRole::instead;
        Encoder encoder(params);
        encoder.start(48000, 1);
        encoder.push(x);
        return encoder.finish();
    };
    const std::vector<double> uneven{0.500, 0.512, 0.552, 0.566, 0.604, 0.617, 0.655};
    const Clip drops = encoded(uneven);
    for (const double time : {0.552, 0.604, 0.655})
        CHECK(valueAt(drops.envelope, time + 0.004) > 1.3 * valueAt(drops.envelope, time - 0.006));
    const std::vector<double> even{0.500, 0.530, 0.560, 0.590, 0.620, 0.650, 0.680};
    const Clip train = encoded(even);
    CHECK(train.transients.size() == even.size());
    CHECK(valueAt(train.envelope, 0.595) < 0.1);
}
