// Comparisons by all measures: each pair by itself, whatever was compared before.

#include "support/Catch.h"

#include <pacini/evaluate/Comparison.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <string_view>
#include <vector>

using namespace pacini;

namespace
{
constexpr int rate = 8000;

std::vector<float> toneAt(double frequency, double seconds)
{
    std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] =
            static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(i) / rate) *
                               (i % 2000 < 1000 ? 1.0 : 0.1));
    return samples;
}

Comparison compared(Comparer& comparer, const std::vector<float>& reference, const std::vector<float>& candidate)
{
    REQUIRE(comparer.setReference(reference, rate));
    REQUIRE(comparer.setCandidate(candidate, rate));
    return comparer.compare();
}

std::vector<double> figuresOf(const Comparison& comparison)
{
    std::vector<double> figures;
    for (const ComparisonFigure& figure : comparisonFigures)
        figures.push_back(figure.value(comparison).value_or(-1e9));
    return figures;
}
} // namespace

TEST_CASE("a comparison does not depend on those before it", "[comparison]")
{
    const auto a = toneAt(120.0, 1.0);
    const auto b = toneAt(200.0, 1.5);
    Comparer fresh, used(UnsoundFrames::silence);
    (void)compared(used, b, b);
    (void)compared(used, std::vector<float>(100), a);
    auto broken = b;
    broken[7] = std::nanf("");
    CHECK(compared(used, broken, a).notFinite == 1);
    const Comparison wanted = compared(fresh, a, b);
    const Comparison found = compared(used, a, b);
    CHECK(figuresOf(found) == figuresOf(wanted));
    CHECK(found.notFinite == 0);
    CHECK(found.matchLag == wanted.matchLag);
}

TEST_CASE("a sound is like itself", "[comparison]")
{
    const auto sound = toneAt(120.0, 1.0);
    Comparer comparer;
    const Comparison itself = compared(comparer, sound, sound);
    CHECK(itself.hts.score == itself.ceiling);
    CHECK(itself.htsFidelity.score > 99.0);
    CHECK(itself.measures.logSpectralDistance < 0.01);
    const Comparison other = compared(comparer, sound, toneAt(400.0, 1.0));
    CHECK(other.htsFidelity.score < itself.htsFidelity.score);
    CHECK(other.measures.logSpectralDistance > 3.0);
}

TEST_CASE("what says nothing has no figure", "[comparison]")
{
    Comparer comparer;
    const auto sound = toneAt(120.0, 0.5);
    Comparison silent = compared(comparer, std::vector<float>(sound.size()), sound);
    std::set<std::string_view> keys;
    for (const ComparisonFigure& figure : comparisonFigures)
    {
        CHECK(keys.insert(figure.key).second);
        if (figure.key == "lsd" || figure.key == "wideSnr" || figure.key == "centroidError" || figure.key == "f1")
            CHECK_FALSE(figure.value(silent));
    }
    scoreEvents(silent, {0.1, 0.2}, {0.101, 0.3});
    CHECK(silent.events->truePositives == 1);
    CHECK(silent.events->falseNegatives == 1);
}

TEST_CASE("rates that nothing is compared at are errors", "[comparison]")
{
    Comparer comparer;
    const auto result = comparer.setReference(toneAt(100.0, 0.1), 1000);
    REQUIRE_FALSE(result);
    CHECK(result.error().code == ErrorCode::invalidArgument);
}

TEST_CASE("the two jobs of an analysis do not need each other", "[comparison]")
{
    const auto a = toneAt(120.0, 1.0);
    const auto b = toneAt(200.0, 1.5);
    const auto secondFirst = [](const auto& first, const auto& second)
    {
        second();
        first();
    };
    Comparer usual, reversed;
    REQUIRE(reversed.setReference(a, rate, secondFirst));
    REQUIRE(reversed.setCandidate(b, rate, secondFirst));
    CHECK(figuresOf(reversed.compare()) == figuresOf(compared(usual, a, b)));
    CHECK_FALSE(reversed.setReference(a, 1000, secondFirst));
}
