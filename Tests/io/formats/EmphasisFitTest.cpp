// Events as emphases under players that duck the voice.

#include "io/formats/EmphasisFit.h"

#include "support/Catch.h"

#include <cmath>
#include <cstddef>
#include <vector>

using namespace pacini;

namespace
{
struct Fitted
{
    std::vector<Transient> emphases;
};

Fitted fitted(const std::vector<Transient>& events, const Curve& amplitude, const EmphasisPlayer& player = questPlayer)
{
    return {emphasesOf(events, amplitude, player)};
}
} // namespace

TEST_CASE("An emphasis makes up for the voice that is ducked under it", "[formats]")
{
    const Curve voice{{0.0, 0.4}, {1.0, 0.4}};
    for (const double beyond : {0.0, 0.3})
    {
        const Fitted found = fitted({{0.5, beyond, 0.2}}, voice);
        REQUIRE(found.emphases.size() == 1);
        // Measured on one period of the player's oscillator; means of squares, a sine of 1 is 0.5.
        const auto& [time, level, sharpness] = found.emphases[0];
        double pulse = 0.0;
        for (int i = 0; i < 1000; ++i)
        {
            const double sine = std::sin(2.0 * 3.14159265358979 * (i + 0.5) / 1000.0);
            const double wave = sine + sharpness * ((sine > 0.0 ? 1.0 : -1.0) - sine);
            pulse += level * level * wave * wave / 1000.0;
        }
        CHECK(pulse + 0.5 * std::pow(0.5 * 0.4, 2.0) == Approx(0.5 * (0.4 * 0.4 + beyond * beyond)).epsilon(0.01));
    }
}

TEST_CASE("An event that the voice reaches is left out where the pulse would be longer or stronger than it",
          "[formats]")
{
    const Curve tick{{0.0, 0.0}, {0.5, 0.0}, {0.503, 0.8}, {0.508, 0.0}, {1.0, 0.0}};
    const Fitted reached = fitted({{0.5, 0.0, 0.2}}, tick);
    CHECK(reached.emphases.empty());
    CHECK(fitted({{0.5, 0.2, 0.2}}, tick).emphases.size() == 1); // but not what it does not reach
    CHECK(fitted({{0.5, 0.0, 0.2}}, {{0.0, 0.0}, {1.0, 0.0}}).emphases.empty());
}

TEST_CASE("Emphases of fast trains are over before the next one", "[formats]")
{
    const Curve voice{{0.0, 0.4}, {1.0, 0.4}};
    const auto lengthAt = [&](double gap)
    {
        const Fitted found = fitted({{0.5, 0.5, 0.0}, {0.5 + gap, 0.5, 0.0}}, voice);
        return questPlayer.lengthOf(found.emphases.at(0).sharpness);
    };
    CHECK(lengthAt(0.2) > 0.02);
    CHECK(lengthAt(0.05) == Approx(0.015));
    CHECK(lengthAt(0.022) == Approx(0.6 * 0.022));
    CHECK(lengthAt(0.015) == Approx(questPlayer.crispLength));
}

TEST_CASE("Events that are played on top of the voice are those that it does not reach, none below it", "[formats]")
{
    const Curve voice{{0.0, 0.4}, {1.0, 0.4}};
    const Fitted found = fitted({{0.2, 0.0, 0.5}, {0.5, 0.1, 0.5}, {0.8, 0.9, 0.5}}, voice, {.range = {65.0, 300.0}});
    REQUIRE(found.emphases.size() == 2);
    CHECK(found.emphases[0].amplitude == Approx(0.4));
    CHECK(found.emphases[1].amplitude == Approx(0.9));
    CHECK(found.emphases[0].sharpness == Approx((100.0 * std::sqrt(2.8) - 65.0) / 235.0));
}

TEST_CASE("Every event has an emphasis, which the voice that comes back after it does not top", "[formats]")
{
    const Curve tick{{0.0, 0.0}, {0.5, 0.0}, {0.503, 0.8}, {0.508, 0.0}, {1.0, 0.0}};
    CHECK(emphasisOfEach({{0.5, 0.6, 0.2}}, {0.0}, tick, questPlayer).size() == 1);
    const Curve silence{{0.0, 0.0}, {1.0, 0.0}};
    CHECK(emphasisOfEach({{0.5, 0.6, 0.2}}, {0.0}, silence, questPlayer).at(0).amplitude == Approx(1.0 / 255.0));

    const EmphasisPlayer sine{.range = {65.0, 300.0}, .ducking = 0.15, .separation = 0.01, .periods = 2.0};
    CHECK(sine.lengthOf(0.0) == Approx(2.0 / 65.0));
    CHECK(sine.sharpnessOfLength(2.0 / 300.0) == Approx(1.0));
    const Curve steady{{0.0, 0.4}, {1.0, 0.4}};
    for (const double beyond : {0.0, 0.3})
        CHECK(emphasisOfEach({{0.5, 0.6, 0.2}}, {beyond}, steady, sine).at(0).amplitude ==
              Approx(std::sqrt(0.16 * (1.0 - 0.15 * 0.15) + beyond * beyond)));
    const Curve rising{{0.0, 0.0}, {0.5, 0.0}, {0.6, 1.0}, {1.0, 1.0}};
    const Transient tap = emphasisOfEach({{0.5, 0.6, 0.5}}, {0.0}, rising, sine).at(0);
    CHECK(tap.amplitude > valueAt(rising, 0.5 + sine.lengthOf(tap.sharpness)));
}

TEST_CASE("Of events that are too near to each other the stronger ones stay", "[formats]")
{
    using Kept = std::vector<std::size_t>;
    CHECK(separated({}, 0.01).empty());
    CHECK(separated({{0.1, 0.5, 0.0}, {0.105, 0.6, 0.0}, {0.2, 0.1, 0.0}}, 0.01) == Kept{1, 2});
    CHECK(separated({{0.1, 0.6, 0.0}, {0.108, 0.5, 0.0}, {0.116, 0.6, 0.0}}, 0.01) == Kept{0, 2});
    CHECK(separated({{0.25, 0.5, 0.0}, {0.5, 0.5, 0.0}}, 0.25) == Kept{0, 1});
    CHECK(separated({{0.1, 0.5, 0.0}, {0.1, 0.5, 0.0}}, 0.01) == Kept{0});
}
