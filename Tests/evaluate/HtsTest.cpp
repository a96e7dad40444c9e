#include "evaluate/SyntheticSignal.h"
#include "support/Catch.h"
#include "support/Golden.h"

#include <pacini/evaluate/Hts.h>
#include <pacini/evaluate/PowerEnvelope.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
void checkScore(const HtsScore& found, const std::vector<double>& expected)
{
    CHECK(found.score == Approx(expected[0]).margin(0.1));
    CHECK(found.wide == Approx(expected[1]).margin(0.002));
    CHECK(found.band == Approx(expected[2]).margin(0.002));
    CHECK(found.spectrum == Approx(expected[3]).margin(0.002));
    CHECK(found.event == Approx(expected[4]).margin(0.002));
}

std::vector<double> hits(double gain, std::size_t frames = 6000)
{
    return test::syntheticSignal(
        {{"rate", 4000.0},
         {"frames", frames},
         {"partials", {{0.2, 80.0, gain, 15.0}, {0.5, 160.0, gain, 40.0}, {0.9, 230.0, gain * 0.5, 20.0}}},
         {"noise", {3, gain * 0.001}}});
}
} // namespace

TEST_CASE("The similarity equals its golden values at 4 kHz", "[evaluate]")
{
    const auto file = test::golden("hts");
    HtsAnalyzer analyzer;
    const auto reference = file["reference"].get<std::vector<double>>();
    const auto source = analyzer.analyze(std::span<const double>(reference), HtsRole::source);
    const auto events = file["ref_events"].get<std::vector<double>>();
    REQUIRE(source.feltEvents.size() == events.size());
    for (std::size_t i = 0; i < events.size(); ++i)
        CHECK(source.feltEvents[i] == Approx(events[i]).margin(1e-9));
    const auto wide = file["ref_wide"].get<std::vector<double>>();
    REQUIRE(source.felt.size() == wide.size());
    const double scale = peakScale(std::span<const double>(reference));
    for (std::size_t i = 0; i < wide.size(); ++i)
        CHECK(static_cast<double>(source.felt[i]) * scale == Approx(wide[i]).margin(1e-5));
    for (const auto& c : file["cases"])
    {
        CAPTURE(c["name"].get<std::string>());
        const auto samples = c["samples"].get<std::vector<double>>();
        const auto candidate = analyzer.analyze(std::span<const double>(samples), HtsRole::candidate);
        checkScore(compare(source, candidate, HtsMode::translation),
                   {c["score"], c["wide"], c["band"], c["spec"], c["event"]});
        CHECK(compare(source, candidate, HtsMode::fidelity).score == Approx(c["fidelity"].get<double>()).margin(0.1));
    }
}

TEST_CASE("The similarity of sounds at any rate and length equals the reference", "[evaluate]")
{
    const auto file = test::golden("judge");
    HtsAnalyzer analyzer;
    for (const auto& c : file["cases"])
    {
        if (!c["expected"].contains("hts"))
            continue;
        CAPTURE(c["name"].get<std::string>());
        const auto x = test::syntheticSignal(c["reference"]);
        const auto y = test::syntheticSignal(c["candidate"]);
        const auto source = htsSourceFeatures(analyzer, std::span<const double>(x), c["reference"]["rate"]).value();
        const auto candidate =
            htsCandidateFeatures(analyzer, std::span<const double>(y), c["candidate"]["rate"]).value();
        checkScore(compare(source, candidate, HtsMode::translation), c["expected"]["hts"]);
        checkScore(compare(source, candidate, HtsMode::fidelity), c["expected"]["htsFidelity"]);
    }
}

TEST_CASE("A felt sound is fully similar to itself, whatever its gain and polarity", "[evaluate]")
{
    HtsAnalyzer analyzer;
    const auto x = hits(0.7);
    const auto source = analyzer.analyze(std::span<const double>(x), HtsRole::source);
    for (const double gain : {0.7, -0.7, 1e-4, -1e6})
    {
        CAPTURE(gain);
        const auto y = hits(gain);
        const auto score =
            compare(source, analyzer.analyze(std::span<const double>(y), HtsRole::candidate), HtsMode::fidelity);
        CHECK(score.score == Approx(100.0).margin(1e-6));
    }
}

TEST_CASE("Up to 20 ms of lag are aligned, more costs events", "[evaluate]")
{
    HtsAnalyzer analyzer;
    const auto x = hits(0.7);
    const auto source = analyzer.analyze(std::span<const double>(x), HtsRole::source);
    const auto late = [&](std::size_t frames)
    {
        std::vector<double> y(x.size());
        std::copy(x.begin(), x.end() - static_cast<std::ptrdiff_t>(frames),
                  y.begin() + static_cast<std::ptrdiff_t>(frames));
        return compare(source, analyzer.analyze(std::span<const double>(y), HtsRole::candidate), HtsMode::fidelity);
    };
    CHECK(late(60).wide > 0.999);
    CHECK(late(60).event == Approx(1.0));
    CHECK(late(200).event == 0.0);
}

TEST_CASE("Silence is similar to silence only, and nothing is ever not a number", "[evaluate]")
{
    HtsAnalyzer analyzer;
    const auto features = [&](const std::vector<float>& x, HtsRole role)
    {
        return analyzer.analyze(std::span<const float>(x), role);
    };
    const auto soundInDouble = hits(0.7);
    const std::vector<float> sound(soundInDouble.begin(), soundInDouble.end());
    const std::vector<std::vector<float>> signals{{}, {0.5f}, std::vector<float>(4000), sound};
    for (const HtsMode mode : {HtsMode::translation, HtsMode::fidelity})
    {
        for (const auto& x : signals)
            for (const auto& y : signals)
            {
                const auto s = compare(features(x, HtsRole::source), features(y, HtsRole::candidate), mode);
                CAPTURE(x.size(), y.size(), s.score);
                CHECK((s.score >= 0.0 && s.score <= 100.0 + 1e-9));
            }
        const auto silence = features(signals[2], HtsRole::source);
        CHECK(compare(silence, features({}, HtsRole::candidate), mode).score == 100.0);
        CHECK(compare(silence, features(signals[2], HtsRole::candidate), mode).score == 100.0);
        CHECK(compare(silence, features(sound, HtsRole::candidate), mode).score == 0.0);
    }
}

TEST_CASE("Levels are similar within 1.5 dB, unlike from 12 dB on, and the louder ones count more", "[evaluate]")
{
    const auto similarity = [](std::initializer_list<std::pair<double, double>> levels)
    {
        detail::LevelSimilarity sum;
        for (const auto& [reference, candidate] : levels)
            sum.add(reference, candidate);
        return sum.value();
    };
    CHECK(similarity({}) == 1.0);
    CHECK(similarity({{0.0, 0.0}}) == 1.0); // nothing is felt of either
    CHECK(similarity({{20.0, 21.5}}) == 1.0);
    CHECK(similarity({{20.0, 13.25}}) == Approx(0.5));
    CHECK(similarity({{13.25, 20.0}}) == Approx(0.5));
    CHECK(similarity({{20.0, 8.0}}) == Approx(0.0).margin(1e-12));
    CHECK(similarity({{20.0, 0.0}}) == Approx(0.0).margin(1e-12));
    CHECK(similarity({{30.0, 30.0}, {10.0, 0.0}}) == Approx(1.0 - 10.0 * (8.5 / 10.5) / 40.0));
}

TEST_CASE("The envelope of a long steady tone is steady where its pieces meet", "[evaluate]")
{
    // Three transforms; a cut without a fade would ripple far into the pieces.
    std::vector<float> tone(150000);
    for (std::size_t n = 0; n < tone.size(); ++n)
        tone[n] = static_cast<float>(0.5 * std::cos(2.0 * std::numbers::pi * 20.3 / 4000.0 * static_cast<double>(n)));
    const PowerEnvelope found = PowerEnvelopeAnalyzer().analyze(tone);
    REQUIRE(found.envelope.size() == 7500);
    double worst = 0.0;
    for (std::size_t t = 2900; t < 3250; ++t)
        worst = std::max(worst, std::abs(static_cast<double>(found.envelope[t]) * std::sqrt(8.0) - 1.0));
    INFO(worst);
    CHECK(worst < 2e-4);
}
