#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/evaluate/Hts.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
std::vector<double> similarSound(std::size_t frames, double rate, std::uint64_t seed, double brightness)
{
    std::vector<double> x(frames);
    Random random(seed);
    for (std::size_t n = 0; n < frames; ++n)
    {
        const double t = static_cast<double>(n) / rate;
        const double knock = 0.06 + std::exp(-std::fmod(t + 0.1, 0.31) / 0.04);
        x[n] = knock * (0.5 * std::sin(2.0 * std::numbers::pi * 61.0 * t) + random.uniform(-0.3, 0.3)) +
               brightness * std::sin(2.0 * std::numbers::pi * 900.0 * t) * std::exp(-std::fmod(t, 0.17) / 0.02);
    }
    return x;
}

void pinScore(const std::string& name, const HtsScore& s)
{
    checkPinned("evaluate/" + name, {s.score, s.wide, s.band, s.spectrum, s.event}, 1e-4);
}
} // namespace

TEST_CASE("Features for the similarity are what they were", "[evaluate]")
{
    HtsAnalyzer analyzer;
    for (const std::size_t length : {1u, 37u, 900u, 4100u})
    {
        const auto x = similarSound(length, 4000.0, 3, 0.3);
        const auto found = analyzer.analyze(std::span<const double>(x), HtsRole::source);
        const std::string name = "evaluate/similarity features of " + std::to_string(length);
        CHECK(found.duration == static_cast<double>(length) / 4000.0);
        checkPinned(name + ", felt", std::vector<double>(found.felt.begin(), found.felt.end()), 1e-5);
        checkPinned(name + ", audible", std::vector<double>(found.audible.begin(), found.audible.end()), 1e-5);
        checkPinned(name + ", felt events", found.feltEvents);
        checkPinned(name + ", audible events", found.audibleEvents);
        for (std::size_t k = 0; k < found.bands.size(); ++k)
            checkPinned(name + ", band " + std::to_string(k),
                        std::vector<double>(found.bands[k].begin(), found.bands[k].end()), 1e-5);
        std::vector<double> cells;
        for (const auto& frame : found.spectrum)
            cells.insert(cells.end(), frame.begin(), frame.end());
        checkPinned(name + ", spectrum", cells, 1e-5);

        const auto candidate = analyzer.analyze(std::span<const double>(x), HtsRole::candidate);
        CHECK(candidate.audible.empty());
        CHECK(candidate.audibleEvents.empty());
        CHECK(candidate.felt == found.felt);
        CHECK(candidate.bands == found.bands);
    }
}

TEST_CASE("Features do not depend on the level by powers of two, and not on what is not finite", "[evaluate]")
{
    HtsAnalyzer analyzer;
    auto x = similarSound(1000, 4000.0, 4, 0.1);
    x[500] = 0.0;
    const auto expected = analyzer.analyze(std::span<const double>(x), HtsRole::source);
    auto y = x;
    for (double& v : y)
        v *= 0x1p-20;
    y[500] = std::numeric_limits<double>::quiet_NaN();
    const auto found = analyzer.analyze(std::span<const double>(y), HtsRole::source);
    CHECK(found.felt == expected.felt);
    CHECK(found.audible == expected.audible);
    CHECK(found.spectrum == expected.spectrum);
    CHECK(found.bands == expected.bands);
}

TEST_CASE("Scores of unlike pairs of sounds are what they were", "[evaluate]")
{
    HtsAnalyzer analyzer;
    struct Pair
    {
        const char* name;
        std::vector<double> source, candidate;
    };
    const auto x = similarSound(6000, 4000.0, 7, 0.2);
    auto late = x;
    std::rotate(late.begin(), late.end() - 45, late.end());
    auto early = x;
    std::rotate(early.begin(), early.begin() + 75, early.end());
    auto half = x;
    std::fill(half.begin() + 3000, half.end(), 0.0);
    const Pair pairs[] = {{"other noise", x, similarSound(6000, 4000.0, 8, 0.0)},
                          {"late", x, late},
                          {"early", x, early},
                          {"half silent", x, half},
                          {"silent half missing", half, x},
                          {"shorter", x, similarSound(4333, 4000.0, 7, 0.2)},
                          {"longer", similarSound(2500, 4000.0, 9, 0.4), x},
                          {"bright", similarSound(6000, 4000.0, 10, 3.0), x}};
    for (const Pair& pair : pairs)
    {
        const auto source = analyzer.analyze(std::span<const double>(pair.source), HtsRole::source);
        const auto candidate = analyzer.analyze(std::span<const double>(pair.candidate), HtsRole::candidate);
        pinScore(std::string("similarity, ") + pair.name, compare(source, candidate, HtsMode::translation));
        pinScore(std::string("fidelity, ") + pair.name, compare(source, candidate, HtsMode::fidelity));
    }
}

TEST_CASE("The score weighs envelope, events, bands and spectrum by 35, 25, 20 and 20", "[evaluate]")
{
    HtsFeatures source;
    source.duration = 1.0;
    source.felt.assign(10, 1.0f);
    source.audible.assign(10, 1.0f);
    for (auto& band : source.bands)
        band.assign(10, 1.0f);
    source.spectrum.assign(2, {});
    source.spectrum[0].fill(1.0f);
    source.spectrum[1].fill(1.0f);
    source.feltEvents = source.audibleEvents = {0.2, 0.6};
    CHECK(compare(source, source, HtsMode::fidelity) == HtsScore{100.0, 1.0, 1.0, 1.0, 1.0});
    CHECK(compare(source, source, HtsMode::translation) == HtsScore{100.0, 1.0, 1.0, 1.0, 1.0});

    auto candidate = source;
    candidate.feltEvents.clear();
    const auto noEvents = compare(source, candidate, HtsMode::fidelity);
    CHECK(noEvents.event == 0.0);
    CHECK(noEvents.score == Approx(75.0));
    candidate = source;
    for (auto& band : candidate.bands)
        band.assign(10, 0.0f);
    CHECK(compare(source, candidate, HtsMode::fidelity).score == Approx(80.0));
    candidate = source;
    for (auto& frame : candidate.spectrum)
        frame.fill(0.0f);
    CHECK(compare(source, candidate, HtsMode::fidelity).score == Approx(80.0));

    // The felt part of a source at -17.5 dB of the audible one is half of the range: bands and spectrum weigh half.
    auto bright = source;
    const auto fadeFelt = [&](double level)
    {
        const auto v = static_cast<float>(level);
        bright.felt.assign(10, v);
        for (auto& band : bright.bands)
            band.assign(10, v);
        for (auto& frame : bright.spectrum)
            frame.fill(v);
    };
    fadeFelt(std::pow(10.0, -17.5 / 20.0));
    candidate = source;
    candidate.feltEvents.clear();
    CHECK(compare(bright, candidate, HtsMode::translation).score == Approx(100.0 * (1.0 - 0.25 / 0.8)).epsilon(1e-6));
    fadeFelt(1e-6);
    CHECK(compare(bright, candidate, HtsMode::translation).score == Approx(100.0 * (1.0 - 0.25 / 0.6)).epsilon(1e-6));
}

TEST_CASE("Sensation levels end at 0 dB, 35 dB below the strongest", "[evaluate]")
{
    CHECK(detail::sensationLevel(2.0, 2.0) == Approx(35.0));
    CHECK(detail::sensationLevel(0.2, 2.0) == Approx(15.0));
    CHECK(detail::sensationLevel(20.0, 2.0) == Approx(55.0));
    CHECK(detail::sensationLevel(2.0 * std::pow(10.0, -34.9 / 20.0), 2.0) == Approx(0.1));
    CHECK(detail::sensationLevel(2.0 * std::pow(10.0, -35.1 / 20.0), 2.0) == 0.0);
    CHECK(detail::sensationLevel(0.0, 1.0) == 0.0);
    CHECK(detail::sensationLevel(0.0, 1e-12) == Approx(35.0)); // nothing is as strong as next to nothing
    CHECK(detail::sensationLevel(0.0, 1e-13) == Approx(55.0));
}

TEST_CASE("Envelopes are compared at their lag and as silence outside", "[evaluate]")
{
    const std::vector<float> a{1.0f, 1.0f, 1.0f, 1.0f};
    const auto similarity = [&](const std::vector<float>& b, std::size_t frames, std::ptrdiff_t lag, double gain)
    {
        detail::LevelSimilarity sum;
        detail::addEnvelopes(sum, a, b, frames, lag, gain, 1.0);
        return sum.value();
    };
    CHECK(similarity(a, 4, 0, 1.0) == 1.0);
    CHECK(similarity(a, 4, 1, 1.0) == Approx(0.75));
    CHECK(similarity(a, 4, -1, 1.0) == Approx(0.75));
    CHECK(similarity(a, 4, 4, 1.0) == Approx(0.0).margin(1e-12));
    CHECK(similarity(a, 3, -3, 1.0) == Approx(0.0).margin(1e-12));
    CHECK(similarity({0.1f, 0.1f, 0.1f, 0.1f}, 4, 0, 10.0) == Approx(1.0));
    CHECK(similarity({0.0f, 1.0f, 1.0f, 1.0f}, 3, 1, 1.0) == Approx(2.0 / 3.0));
    CHECK(similarity({0.0f, 0.0f, 0.0f, 0.0f}, 0, 0, 1.0) == 1.0);
}

TEST_CASE("The lag of the similarity is found up to 4 frames on either side, the earliest of equals", "[evaluate]")
{
    const auto peakAt = [](std::size_t at, std::size_t size = 20)
    {
        std::vector<float> x(size, 0.0f);
        x[at] = 1.0f;
        return x;
    };
    for (std::ptrdiff_t lag = -4; lag <= 4; ++lag)
        CHECK(detail::htsLag(peakAt(10), peakAt(static_cast<std::size_t>(10 + lag))) == lag);
    CHECK(detail::htsLag(peakAt(10), peakAt(15)) == -4);
    CHECK(detail::htsLag(peakAt(10), peakAt(5)) == -4);
    CHECK(detail::htsLag(peakAt(0, 3), peakAt(2, 3)) == 2);
    CHECK(detail::htsLag(peakAt(2, 3), peakAt(0, 3)) == -2);
    CHECK(detail::htsLag(peakAt(0, 1), peakAt(0, 1)) == 0);
    CHECK(detail::htsLag({}, {}) == -4);
    // Louder by less than a billionth is no better.
    std::vector<float> two(20, 0.0f);
    two[9] = two[12] = 1.0f;
    CHECK(detail::htsLag(peakAt(10), two) == -1);
}

TEST_CASE("Event skill is 0 at chance and counts hits within 8 ms", "[evaluate]")
{
    const std::vector<double> events{0.1, 0.5, 0.9};
    CHECK(detail::eventSkill({}, {}, 1.0) == 1.0);
    CHECK(detail::eventSkill(events, {}, 1.0) == 0.0);
    CHECK(detail::eventSkill({}, events, 1.0) == 0.0);
    CHECK(detail::eventSkill(events, events, 1.0) == Approx(1.0));
    CHECK(detail::eventSkill(events, std::vector<double>{0.1079, 0.5079, 0.9079}, 1.0) == Approx(1.0));
    CHECK(detail::eventSkill(events, std::vector<double>{0.1081, 0.5081, 0.9081}, 1.0) == 0.0);
    const double chance = 2.0 * 3.0 * (1.0 - std::exp(-0.016 * 2.0 / 1.5)) / 5.0;
    CHECK(detail::eventSkill(events, std::vector<double>{0.1, 0.7}, 1.5) == Approx((0.4 - chance) / (1.0 - chance)));
    // No more hits by chance than there are candidates.
    const std::vector<double> many{0.001, 0.1, 0.2, 0.3, 0.4, 0.5};
    const double all = 2.0 / 7.0;
    CHECK(detail::eventSkill(many, std::vector<double>{0.1}, 0.005) ==
          Approx(std::max(0.0, (2.0 / 7.0 - all) / (1.0 - all))).margin(1e-12));
    CHECK(detail::eventSkill(std::vector<double>{0.1}, std::vector<double>{0.1}, 0.0) == Approx(0.0).margin(1e-12));
}

TEST_CASE("Highest value and energy of an envelope", "[evaluate]")
{
    CHECK(detail::highest({}) == 0.0);
    CHECK(detail::highest(std::vector<float>{0.25f, 2.0f, 1.0f}) == 2.0);
    CHECK(detail::energy(std::vector<float>{0.5f, 2.0f, 1.0f}) == 5.25);
}

TEST_CASE("Sources are band-limited and normalised before they are compared, candidates only resampled", "[evaluate]")
{
    HtsAnalyzer analyzer;
    const auto x = similarSound(5000, 8000.0, 12, 0.5);
    for (const int rate : {2000, 8000, 11025, 768000})
    {
        const auto source = htsSourceFeatures(analyzer, std::span<const double>(x), rate);
        REQUIRE(source.ok());
        const auto prepared = prepareSource(std::span<const double>(x), rate, 4000).value();
        const auto expected = analyzer.analyze(std::span<const double>(prepared), HtsRole::source);
        CHECK(source.value().audible == expected.audible);
        CHECK(source.value().felt == expected.felt);
        auto bad = x;
        bad[77] = 0.0;
        const auto resampled = resample(std::span<const double>(bad), rate, 4000).value();
        bad[77] = std::numeric_limits<double>::infinity();
        const auto candidate = htsCandidateFeatures(analyzer, std::span<const double>(bad), rate);
        REQUIRE(candidate.ok());
        CHECK(candidate.value().felt == analyzer.analyze(std::span<const double>(resampled), HtsRole::candidate).felt);
        CHECK(candidate.value().audible.empty());
    }
    for (const int rate : {1999, 768001})
    {
        CHECK(htsSourceFeatures(analyzer, std::span<const double>(x), rate).error().code == ErrorCode::invalidArgument);
        CHECK(htsCandidateFeatures(analyzer, std::span<const double>(x), rate).error().code ==
              ErrorCode::invalidArgument);
    }
}
