// Events as emphases under players that duck the voice.

#include "io/formats/EmphasisFit.h"

#include "support/Catch.h"

#include <cmath>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
struct Fitted
{
    std::vector<Transient> emphases;
    std::vector<FormatLoss> losses;
};

Fitted fitted(const std::vector<Transient>& events, const Curve& amplitude, const EmphasisPlayer& player = questPlayer)
{
    LossList losses;
    Fitted result;
    result.emphases = emphasesOf(events, amplitude, player, losses);
    result.losses = std::move(losses).sorted();
    return result;
}
} // namespace

TEST_CASE("An emphasis makes up for the voice that is ducked under it", "[formats]")
{
    const Curve voice{{0.0, 0.4}, {1.0, 0.4}};
    for (const double beyond : {0.0, 0.3})
    {
        const Fitted found = fitted({{0.5, beyond, 0.2}}, voice);
        REQUIRE(found.emphases.size() == 1);
        REQUIRE(found.losses.empty());
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
    REQUIRE(reached.losses.size() == 1);
    CHECK(reached.losses[0].kind == LossKind::event);
    CHECK(reached.losses[0].time == 0.5);
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
    REQUIRE(found.losses.size() == 1);
    CHECK(found.losses[0].time == 0.2);
}
