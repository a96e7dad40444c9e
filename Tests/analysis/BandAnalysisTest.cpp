#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/BandAnalysis.h>

using namespace pacini;
using namespace pacini::test;

namespace
{

constexpr double bandRate = analysisRate;

BandAnalysisParams sixBands()
{
    return {.bands = tiledBands(6, 30.0, 1000.0, BandSpacing::logarithmic)};
}

BandAnalysisResult analysed(BandAnalysis& analysis, const std::vector<std::vector<float>>& channels,
                            std::size_t piece = 1 << 20)
{
    analysis.reset(channels.size());
    for (std::size_t i = 0; i < channels.front().size(); i += piece)
    {
        std::vector<std::span<const float>> parts;
        for (const auto& channel : channels)
            parts.push_back(std::span(channel).subspan(i, std::min(piece, channel.size() - i)));
        analysis.push(parts);
    }
    return analysis.finish();
}

BandAnalysisResult analysed(const std::vector<float>& mono)
{
    BandAnalysis analysis(sixBands());
    return analysed(analysis, {mono});
}

bool same(const BandAnalysisResult& a, const BandAnalysisResult& b)
{
    bool equal = a.peak == b.peak && a.envelope == b.envelope && a.tracks.size() == b.tracks.size();
    for (std::size_t k = 0; equal && k < a.tracks.size(); ++k)
        equal = a.tracks[k].amplitude == b.tracks[k].amplitude && a.tracks[k].frequency == b.tracks[k].frequency;
    return equal;
}

std::vector<float> plus(std::vector<float> a, const std::vector<float>& b)
{
    std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<float>());
    return a;
}

} // namespace

TEST_CASE("A steady tone is constant in its band, at its frequency, across all blocks", "[analysis]")
{
    const auto bands = sixBands().bands;
    for (std::size_t k = 0; k < bands.size(); ++k)
    {
        const double f = bands[k].centre;
        const auto result = analysed(sine(24000, f, bandRate, 0.4)); // 6 s: several blocks
        CAPTURE(f);
        REQUIRE(result.tracks.size() == 6);
        for (std::size_t i = 25; i < 275; ++i) // 0.5 s from the ends
        {
            REQUIRE(result.tracks[k].amplitude[i] == Approx(0.4).epsilon(2e-3));
            REQUIRE(result.tracks[k].frequency[i] == Approx(f).epsilon(1e-3));
            for (std::size_t other = 0; other < bands.size(); ++other)
                if (other != k)
                    REQUIRE(result.tracks[other].amplitude[i] < 0.4e-3f);
        }
        for (std::size_t i = 100; i < 1100; ++i)
            REQUIRE(result.envelope[i] == Approx(0.4).epsilon(2e-3));
    }
}

TEST_CASE("Two tones of one band beat, and its frequency is their mean weighted by power", "[analysis]")
{
    // 4 Hz apart: the mean of |z|^2 under a Hann window of 40 ms keeps this part of the beat.
    const double kept = [&]
    {
        double sum = 0.0, weights = 0.0;
        for (double t = -0.02; t <= 0.02; t += 1e-5)
        {
            const double w = 0.5 + 0.5 * std::cos(std::numbers::pi * t / 0.02);
            sum += w * std::cos(2.0 * std::numbers::pi * 4.0 * t);
            weights += w;
        }
        return sum / weights;
    }();
    const auto result = analysed(plus(sine(20000, 130.0, bandRate, 0.3), sine(20000, 134.0, bandRate, 0.1)));
    const auto& track = result.tracks[2]; // 97-173 Hz
    double meanFrequency = 0.0;
    double power = 0.0;
    for (std::size_t i = 50; i < 200; ++i)
    {
        const double t = 0.02 * static_cast<double>(i);
        const double expected = 0.09 + 0.01 + 2.0 * 0.3 * 0.1 * kept * std::cos(2.0 * std::numbers::pi * 4.0 * t);
        const auto a = static_cast<double>(track.amplitude[i]);
        REQUIRE(a * a == Approx(expected).epsilon(0.01));
        meanFrequency += a * a * static_cast<double>(track.frequency[i]);
        power += a * a;
    }
    CHECK(meanFrequency / power == Approx((0.09 * 130.0 + 0.01 * 134.0) / 0.1).epsilon(5e-4));
}

TEST_CASE("The envelope of a modulated tone is its modulation", "[analysis]")
{
    auto x = sine(16000, 250.0, bandRate, 0.5);
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] *=
            static_cast<float>(1.0 + 0.6 * std::sin(2.0 * std::numbers::pi * 5.0 * static_cast<double>(n) / bandRate));
    const auto result = analysed(x);
    for (std::size_t i = 100; i < 700; ++i)
    {
        const double t = 0.005 * static_cast<double>(i);
        REQUIRE(result.envelope[i] ==
                Approx(0.5 * (1.0 + 0.6 * std::sin(2.0 * std::numbers::pi * 5.0 * t))).margin(0.005));
    }
    CHECK(result.peak == Approx(0.8).epsilon(0.01));
}

TEST_CASE("Bands add up: power of noise is that of all bands and their overlaps", "[analysis]")
{
    // Two bands that fade into each other share a tone in proportion of their weights at its frequency.
    const auto bands = sixBands().bands;
    const auto result = analysed(sine(16000, bands[2].high, bandRate, 0.4));
    for (std::size_t i = 50; i < 150; ++i)
    {
        REQUIRE(result.tracks[2].amplitude[i] == Approx(0.2).epsilon(5e-3));
        REQUIRE(result.tracks[3].amplitude[i] == Approx(0.2).epsilon(5e-3));
        REQUIRE(result.tracks[3].frequency[i] == Approx(bands[2].high).epsilon(2e-3));
    }
}

TEST_CASE("How the sound is cut into calls does not show in the analysis", "[analysis]")
{
    const std::vector<std::vector<float>> channels{noise(15000, 1), noise(15000, 2)};
    BandAnalysis analysis(sixBands());
    const auto whole = analysed(analysis, channels);
    for (const std::size_t piece : {1u, 777u, 6144u, 14999u})
    {
        CAPTURE(piece);
        CHECK(same(analysed(analysis, channels, piece), whole)); // the same object again: reset() forgets
    }
}

TEST_CASE("Frames cover the sound whatever its length", "[analysis]")
{
    BandAnalysis analysis(sixBands());
    for (const std::size_t length : {0u, 1u, 19u, 20u, 79u, 80u, 4000u, 6144u, 6145u, 5632u, 11776u, 20001u})
    {
        const auto result = analysed(analysis, {std::vector<float>(length, 0.0f)});
        CAPTURE(length);
        CHECK(result.envelope.size() == length / 20 + 1);
        CHECK(result.peak == 0.0);
        for (const auto& track : result.tracks)
        {
            CHECK(track.amplitude.size() == length / 80 + 1);
            CHECK(track.frequency.size() == length / 80 + 1);
            CHECK(std::all_of(track.amplitude.begin(), track.amplitude.end(), [](float a) { return a == 0.0f; }));
            CHECK(std::all_of(track.frequency.begin(), track.frequency.end(), [](float f) { return f == 0.0f; }));
        }
    }
}

TEST_CASE("Channels in antiphase are analysed as if they were in phase", "[analysis]")
{
    const auto x = plus(sine(12000, 75.0, bandRate, 0.3), sine(12000, 420.0, bandRate, 0.2));
    auto minus = x;
    for (float& v : minus)
        v = -v;
    BandAnalysis analysis(sixBands());
    const auto alone = analysed(analysis, {x});
    const auto opposed = analysed(analysis, {x, minus});
    for (const std::size_t k : {std::size_t(1), std::size_t(4)})
        for (std::size_t i = 10; i < 140; ++i)
            REQUIRE(opposed.tracks[k].amplitude[i] == Approx(alone.tracks[k].amplitude[i]).epsilon(0.02));
}
