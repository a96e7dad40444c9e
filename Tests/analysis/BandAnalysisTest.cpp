#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Pinned.h"

#include <pacini/analysis/BandAnalysis.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

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

TEST_CASE("A new analysis is ready for a sound of one channel", "[analysis]")
{
    const auto x = noise(9000, 5);
    BandAnalysis analysis(sixBands());
    CHECK(analysis.found().tracks.size() == 6);
    CHECK(analysis.found().envelope.empty());
    const std::span<const float> channel(x);
    analysis.push({&channel, 1});
    CHECK(same(analysis.finish(), analysed(x)));
    BandAnalysis silent(sixBands());
    BandAnalysis started(sixBands());
    CHECK(same(silent.finish(), analysed(started, {{}})));
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

TEST_CASE("What the band analysis finds in sounds of every length and channel count is what it was", "[analysis]")
{
    const auto sound = [](std::size_t frames, std::size_t channel)
    {
        const auto hiss = noise(frames, 40 + channel);
        std::vector<float> x(frames);
        for (std::size_t n = 0; n < frames; ++n)
        {
            const double t = 2.0 * std::numbers::pi * static_cast<double>(n) / bandRate;
            // The second channel has the low tone in antiphase.
            x[n] = static_cast<float>((channel == 1 ? -0.4 : 0.4) * std::sin(52.0 * t + 0.3) +
                                      0.3 * (1.0 + 0.6 * std::sin(4.0 * t)) *
                                          std::sin(333.0 * t + static_cast<double>(channel))) +
                   0.2f * hiss[n];
        }
        return x;
    };
    const auto pin = [](const std::string& name, const BandAnalysisResult& found)
    {
        checkPinned("analysis/" + name + ", peak", {found.peak}, 1e-5);
        const auto pinTrack = [](const std::string& of, const std::vector<float>& frames)
        {
            const std::vector<double> all(frames.begin(), frames.end());
            checkPinned(of, all, 2e-5);
            std::vector<double> ends(all.begin(), all.begin() + std::min<std::ptrdiff_t>(std::ssize(all), 6));
            ends.insert(ends.end(), all.end() - std::min<std::ptrdiff_t>(std::ssize(all), 6), all.end());
            checkPinned(of + ", ends", ends, 1e-4);
        };
        pinTrack("analysis/" + name + ", envelope", found.envelope);
        for (std::size_t k = 0; k < found.tracks.size(); ++k)
        {
            pinTrack("analysis/" + name + ", amplitude " + std::to_string(k), found.tracks[k].amplitude);
            pinTrack("analysis/" + name + ", frequency " + std::to_string(k), found.tracks[k].frequency);
        }
    };
    BandAnalysis analysis(sixBands());
    for (const std::size_t frames : {1u, 700u, 6144u, 6145u, 18000u})
        pin("bands of " + std::to_string(frames) + " samples", analysed(analysis, {sound(frames, 0)}));
    pin("bands of two channels", analysed(analysis, {sound(9000, 0), sound(9000, 1)}));
    pin("bands of three channels", analysed(analysis, {sound(3000, 2), sound(3000, 0), sound(3000, 1)}));
    BandAnalysisParams params{.bands = tiledBands(3, 20.0, 1700.0, BandSpacing::linear)};
    params.overlap = 1.0;
    params.envelopeWindow = Seconds(0.02);
    params.bandWindow = Seconds(0.03);
    BandAnalysis wide(params);
    pin("three wide bands", analysed(wide, {sound(7000, 0)}));
    BandAnalysis narrow({.bands = tiledBands(32, 30.0, 1000.0, BandSpacing::logarithmic)});
    pin("narrow bands",
        [&]
        {
            auto found = analysed(narrow, {sound(3000, 0)});
            found.tracks.erase(found.tracks.begin() + 1, found.tracks.end() - 2);
            return found;
        }());
}

TEST_CASE("An analysis of nothing but the peak finds the same peak and nothing else", "[analysis]")
{
    const auto x = noise(20000, 9);
    auto params = sixBands();
    BandAnalysis whole(params);
    params.onlyPeak = true;
    BandAnalysis peak(params);
    const auto expected = analysed(whole, {x, noise(20000, 10)});
    const auto found = analysed(peak, {x, noise(20000, 10)});
    CHECK(found.peak == expected.peak);
    CHECK(found.envelope.empty());
    for (const auto& track : found.tracks)
    {
        CHECK(track.amplitude.empty());
        CHECK(track.frequency.empty());
    }
}

TEST_CASE("A result is taken from its front frame by frame, and both parts share the frame at the cut", "[analysis]")
{
    BandAnalysisResult found;
    found.peak = 3.0;
    for (int i = 0; i < 121; ++i)
        found.envelope.push_back(static_cast<float>(i));
    found.tracks.resize(2);
    for (auto& track : found.tracks)
        for (int i = 0; i < 31; ++i)
        {
            track.amplitude.push_back(static_cast<float>(i));
            track.frequency.push_back(static_cast<float>(100 + i));
        }
    CHECK(found.seconds() == Approx(0.605)); // of the envelope
    found.tracks[1].amplitude.pop_back();
    CHECK(found.seconds() == Approx(0.6)); // of the shortest band
    found.tracks[1].amplitude.push_back(30.0f);
    const auto first = found.takeFirst(0.24);
    CHECK(first.peak == 3.0);
    CHECK(found.peak == 3.0);
    CHECK(first.envelope.size() == 49);
    CHECK(first.envelope.back() == 48.0f);
    CHECK(found.envelope.size() == 73);
    CHECK(found.envelope.front() == 48.0f);
    REQUIRE(first.tracks.size() == 2);
    for (std::size_t k = 0; k < 2; ++k)
    {
        CHECK(first.tracks[k].amplitude.size() == 13);
        CHECK(first.tracks[k].frequency.back() == 112.0f);
        CHECK(found.tracks[k].frequency.front() == 112.0f);
        CHECK(found.tracks[k].amplitude.size() == 19);
    }
    const BandAnalysisParams usual;
    CHECK(usual.overlap == 0.5);
    CHECK(usual.envelopeWindow.value == 0.010);
    CHECK(usual.bandWindow.value == 0.040);
    CHECK_FALSE(usual.onlyPeak);
    CHECK(BandAnalysisResult{}.peak == 0.0);
}

TEST_CASE("Room that was asked for saves moving, and does not show", "[analysis]")
{
    BandAnalysis analysis(sixBands());
    const auto x = noise(9000, 3);
    const auto expected = analysed(analysis, {x});
    const std::span<const float> span(x);
    for (const std::size_t room : {std::size_t(0), std::size_t(9000), std::size_t(1) << 50})
    {
        if (room == std::size_t(1) << 50)
            continue; // hours of it are reserved, which some machines do not like
        analysis.reset(1, room);
        CHECK(analysis.found().envelope.capacity() >= room / 20 + 2);
        CHECK(analysis.found().tracks[0].amplitude.capacity() >= room / 80 + 2);
        CHECK(analysis.found().tracks[5].frequency.capacity() >= room / 80 + 2);
        CHECK(analysis.found().envelope.capacity() <= room / 20 + 3);
        CHECK(analysis.found().tracks[0].amplitude.capacity() <= room / 80 + 3);
        analysis.push(std::span(&span, 1));
        CHECK(same(analysis.finish(), expected));
    }
    auto params = sixBands();
    params.onlyPeak = true;
    BandAnalysis peak(params);
    peak.reset(1, 9000);
    CHECK(peak.found().envelope.capacity() <= 2);
}

TEST_CASE("Unrelated channels keep their mean, antiphase ones the strongest", "[analysis]")
{
    // In antiphase by half: the mean keeps (1 - g)^2 / (2 (1 + g^2)) of what n channels would.
    BandAnalysis analysis(sixBands());
    const double f = sixBands().bands[3].centre;
    const auto tone = sine(16000, f, bandRate, 0.4);
    for (const double g : {1.0, 0.2, 0.0, -0.2, -0.3, -0.5, -1.0})
    {
        std::vector<float> other(tone.size());
        for (std::size_t n = 0; n < tone.size(); ++n)
            other[n] = static_cast<float>(g * static_cast<double>(tone[n]));
        const double mean = 0.5 * (1.0 + g);
        const double kept = 4.0 * mean * mean / (1.0 + g * g);
        const double share = std::clamp((0.5 - kept) / 0.25, 0.0, 1.0);
        const auto found = analysed(analysis, {tone, other});
        CAPTURE(g);
        CHECK(found.tracks[3].amplitude[100] == Approx(0.4 * (mean + share * (1.0 - mean))).epsilon(2e-3));
        CHECK(found.envelope[400] == Approx(0.4 * (mean + share * (1.0 - mean))).epsilon(2e-3));
    }
}

TEST_CASE("Frames of the band analysis are there as soon as no later block can change them", "[analysis]")
{
    // A block of 6144 samples is analysed when more than it is there; 5632 - 1024 samples of it are then complete, less
    // the half window of 20 or 5 ms.
    BandAnalysis analysis(sixBands());
    analysis.reset(1);
    const auto x = noise(12000, 3);
    const auto push = [&](std::size_t begin, std::size_t end)
    {
        const auto part = std::span(x).subspan(begin, end - begin);
        analysis.push(std::span(&part, 1));
        return std::pair(analysis.found().envelope.size(), analysis.found().tracks[0].amplitude.size());
    };
    CHECK(push(0, 6144) == std::pair<std::size_t, std::size_t>(0, 0));
    const auto first = push(6144, 6145);
    CHECK(static_cast<double>(first.first) == Approx((4608.0 - 20.0) / 20.0).margin(1.5));
    CHECK(static_cast<double>(first.second) == Approx((4608.0 - 80.0) / 80.0).margin(1.5));
    CHECK(push(6145, 11776) == first);
    const auto second = push(11776, 11777);
    CHECK(static_cast<double>(second.first) == Approx((10240.0 - 20.0) / 20.0).margin(1.5));
    CHECK(static_cast<double>(second.second) == Approx((10240.0 - 80.0) / 80.0).margin(1.5));
    checkPinned("analysis/frames that are there early",
                {static_cast<double>(first.first), static_cast<double>(first.second), static_cast<double>(second.first),
                 static_cast<double>(second.second)});
}
