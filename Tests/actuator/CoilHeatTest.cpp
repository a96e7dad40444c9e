#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/actuator/CoilHeat.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace pacini;

namespace
{

CoilHeat coilOf(const CoilHeatParams& params, double fs)
{
    CoilHeat heat;
    heat.design(params, fs);
    return heat;
}

/// The coil again, frame by frame, by its definition.
struct CoilByHand
{
    CoilHeatParams params;
    double fs;
    double temperature = 0.0, once = 0.0, twice = 0.0;

    [[nodiscard]] double share(double time) const { return 1.0 - std::exp(-1.0 / (time * fs)); }
    double measure(double wanted)
    {
        once += share(0.05) * (params.fullDrivePower * wanted * wanted - once);
        twice += share(0.05) * (once - twice);
        const double aim = 0.95 * params.maxPower;
        return twice / (temperature < aim ? 5.0 * aim - 4.0 * temperature : aim);
    }
    void advance(double drive)
    {
        temperature += share(params.thermalTime.value) * (params.fullDrivePower * drive * drive - temperature);
    }
    /// The drive that would bring the temperature to its limit with this frame.
    [[nodiscard]] double most() const
    {
        const double power = (params.maxPower - temperature) / share(params.thermalTime.value) + temperature;
        return std::sqrt(power / params.fullDrivePower);
    }
};

} // namespace

TEST_CASE("A coil is measured by its mean power over what a coil of its temperature may have", "[actuator][protection]")
{
    const CoilHeatParams params{3.0, 0.5, Seconds(0.04)};
    CoilHeat heat = coilOf(params, 1000.0);
    CoilByHand hand{params, 1000.0};
    bool bounded = false, warm = false;
    for (int n = 0; n < 700; ++n)
    {
        const double wanted = n < 300 ? 0.9 : n < 500 ? 0.2 : -0.7;
        CHECK(heat.measure(wanted) == Approx(hand.measure(wanted)).epsilon(1e-7));
        const double admitted = heat.admit(wanted);
        const double most = hand.most();
        CHECK(admitted == Approx(std::copysign(std::min(std::abs(wanted), most), wanted)).epsilon(1e-6));
        bounded |= std::abs(admitted) < 0.99 * std::abs(wanted);
        warm |= hand.temperature > 0.95 * params.maxPower;
        heat.advance(admitted);
        hand.advance(admitted);
        REQUIRE(hand.temperature <= params.maxPower * (1.0 + 1e-9));
    }
    CHECK(bounded);
    CHECK(warm);
}

TEST_CASE("A coil that was reset is cold and has no mean", "[actuator][protection]")
{
    const CoilHeatParams params{1.0, 0.1, Seconds(0.1)};
    CoilHeat heat = coilOf(params, 8000.0);
    for (int n = 0; n < 501; ++n)
    {
        (void)heat.measure(0.7);
        heat.advance(0.3);
    }
    heat.reset();
    CoilHeat fresh = coilOf(params, 8000.0);
    CHECK(heat.admit(1e9) == fresh.admit(1e9));
    for (int n = 0; n < 9; ++n)
    {
        CHECK(heat.measure(0.4) == fresh.measure(0.4));
        heat.advance(0.5);
        fresh.advance(0.5);
        CHECK(heat.admit(100.0) == fresh.admit(100.0));
    }
}

TEST_CASE("A coil goes on from its temperature and its means when its parameters change", "[actuator][protection]")
{
    CoilHeat heat = coilOf({1.0, 0.1, Seconds(0.1)}, 8000.0);
    for (int n = 0; n < 802; ++n)
    {
        (void)heat.measure(0.7);
        heat.advance(0.2);
    }
    CoilByHand hand{{1.0, 0.1, Seconds(0.1)}, 8000.0};
    for (int n = 0; n < 802; ++n)
    {
        (void)hand.measure(0.7);
        hand.advance(0.2);
    }
    heat.design({2.0, 0.2, Seconds(0.5)}, 8000.0);
    hand.params = {2.0, 0.2, Seconds(0.5)};
    for (int n = 0; n < 10; ++n)
    {
        CHECK(heat.measure(0.7) == Approx(hand.measure(0.7)).epsilon(1e-7));
        heat.advance(0.5);
        hand.advance(0.5);
        CHECK(heat.admit(1e3) == Approx(hand.most()).epsilon(1e-6));
    }
}

TEST_CASE("Parameters of a coil beyond their ranges count as the ends", "[actuator][protection]")
{
    const auto numbers = [](const CoilHeatParams& params)
    {
        CoilHeat heat = coilOf(params, 2000.0);
        std::vector<double> result;
        for (int n = 0; n < 40; ++n)
        {
            result.push_back(heat.measure(0.5));
            result.push_back(heat.admit(n % 2 == 0 ? 1e30 : -1e30));
            heat.advance(0.5);
        }
        return result;
    };
    const auto same = [&](const CoilHeatParams& a, const CoilHeatParams& b)
    {
        return numbers(a) == numbers(b);
    };
    CHECK(same({1e-13, 1.0, Seconds(1.0)}, {1e-12, 1.0, Seconds(1.0)}));
    CHECK_FALSE(same({1.1e-12, 1.0, Seconds(1.0)}, {1e-12, 1.0, Seconds(1.0)}));
    CHECK(same({3e12, 1.0, Seconds(1.0)}, {1e12, 1.0, Seconds(1.0)}));
    CHECK_FALSE(same({0.9e12, 1.0, Seconds(1.0)}, {1e12, 1.0, Seconds(1.0)}));
    CHECK(same({1.0, 1e-13, Seconds(1.0)}, {1.0, 1e-12, Seconds(1.0)}));
    CHECK_FALSE(same({1.0, 1.1e-12, Seconds(1.0)}, {1.0, 1e-12, Seconds(1.0)}));
    CHECK(same({1.0, 3e12, Seconds(1.0)}, {1.0, 1e12, Seconds(1.0)}));
    CHECK_FALSE(same({1.0, 0.9e12, Seconds(1.0)}, {1.0, 1e12, Seconds(1.0)}));
    CHECK(same({1.0, 1.0, Seconds(0.001)}, {1.0, 1.0, Seconds(0.01)}));
    CHECK_FALSE(same({1.0, 1.0, Seconds(0.0101)}, {1.0, 1.0, Seconds(0.01)}));
    CHECK(same({1.0, 1.0, Seconds(1e5)}, {1.0, 1.0, Seconds(1e4)}));
    CHECK_FALSE(same({1.0, 1.0, Seconds(0.9e4)}, {1.0, 1.0, Seconds(1e4)}));
}

TEST_CASE("A coil that nobody designed bears a drive of 1 and follows no measure", "[actuator][protection]")
{
    CoilHeat heat;
    CHECK(heat.admit(1.0) == 1.0);
    CHECK(heat.admit(2.0) == 1.0);
    CHECK(heat.admit(-2.0) == -1.0);
    CHECK(heat.measure(1.0) == 0.0);
    heat.advance(1.0);
    CHECK(heat.admit(2.0) == 1.0);
}

TEST_CASE("A coil that is too hot already admits nothing", "[actuator][protection]")
{
    CoilHeat heat = coilOf({1.0, 1.0, Seconds(0.01)}, 2000.0);
    for (int n = 0; n < 400; ++n)
        heat.advance(0.9);
    heat.design({1.0, 0.01, Seconds(0.01)}, 2000.0);
    CHECK(heat.admit(0.5) == 0.0);
    CHECK(heat.admit(-0.5) == 0.0);
}

TEST_CASE("A coil goes ahead freely exactly as far as its bounds tell", "[actuator][protection]")
{
    const CoilHeatParams params{2.0, 0.25, Seconds(0.05)};
    const double fs = 4000.0;
    const std::size_t count = 32;
    std::vector<double> wanted(count), played(count);
    for (std::size_t n = 0; n < count; ++n)
    {
        wanted[n] = 0.1 + 0.01 * static_cast<double>(n % 7);
        played[n] = 0.3 * std::sin(0.4 * static_cast<double>(n));
    }
    double playedPeak = 0.0;
    for (const double drive : played)
        playedPeak = std::max(playedPeak, std::abs(drive));

    for (const int warming : {0, 400, 4000})
    {
        CAPTURE(warming);
        CoilHeat start = coilOf(params, fs);
        CoilByHand hand{params, fs};
        for (int n = 0; n < warming; ++n)
        {
            (void)start.measure(0.2);
            (void)hand.measure(0.2);
            start.advance(0.25);
            hand.advance(0.25);
        }
        // The least measure for which it goes ahead, by halving, and what it should be.
        const auto goes = [&](double most)
        {
            CoilHeat heat = start;
            return heat.advanceFreely(wanted, played, playedPeak, most);
        };
        double low = 0.0, high = 10.0;
        REQUIRE(goes(high));
        for (int i = 0; i < 60; ++i)
            (goes(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
        const double peakPower = 2.0 * playedPeak * playedPeak;
        const double hottest =
            std::min(hand.temperature + 32.0 * hand.share(0.05) * peakPower, std::max(hand.temperature, peakPower));
        CoilByHand after = hand;
        double highest = 0.0;
        for (std::size_t n = 0; n < count; ++n)
        {
            (void)after.measure(wanted[n]);
            after.advance(played[n]);
            if (n % groupFrames == groupFrames - 1)
                highest = std::max(highest, after.twice);
        }
        const double aim = 0.95 * 0.25;
        const double allowed = hottest < aim ? 5.0 * aim - 4.0 * hottest : aim;
        const double fall = 1.0 - static_cast<double>(groupFrames) * hand.share(0.05);
        CHECK(high == Approx(highest / (fall * allowed * (1.0 - 1e-6))).epsilon(1e-7));

        // Having gone it is where single frames lead.
        CoilHeat heat = start;
        REQUIRE(heat.advanceFreely(wanted, played, playedPeak, 1.001 * high));
        CHECK(heat.admit(100.0) == Approx(after.most()).epsilon(1e-6));
        CHECK(heat.measure(0.6) == Approx(after.measure(0.6)).epsilon(1e-7));
        // Not having gone it is where it was.
        heat = start;
        REQUIRE_FALSE(heat.advanceFreely(wanted, played, playedPeak, 0.999 * high));
        CHECK(heat.admit(100.0) == start.admit(100.0));
        CHECK(heat.measure(0.6) == CoilHeat(start).measure(0.6));

        // Each half goes as it does with the other, the first whatever is played.
        heat = start;
        const double warmed = hand.temperature + 32.0 * hand.share(0.05) * 2.0;
        const double whateverIsPlayed = std::min(warmed, std::max(hand.temperature, 2.0));
        const double allowedThen = whateverIsPlayed < aim ? 5.0 * aim - 4.0 * whateverIsPlayed : aim;
        const double least = highest / (fall * allowedThen * (1.0 - 1e-6));
        CHECK_FALSE(heat.measureFreely(wanted, 0.999 * least));
        CHECK(heat.measure(0.6) == CoilHeat(start).measure(0.6));
        heat = start;
        REQUIRE(heat.measureFreely(wanted, 1.001 * least));
        REQUIRE(heat.advanceFreely(played, playedPeak));
        CHECK(heat.admit(100.0) == Approx(after.most()).epsilon(1e-6));

        // Of the peak, too, it takes as much as keeps the coil within its limit.
        const auto goesWithPeak = [&](double peak)
        {
            CoilHeat copy = start;
            return copy.advanceFreely(wanted, played, peak, 1e9);
        };
        low = 0.0, high = 10.0;
        REQUIRE(goesWithPeak(low));
        for (int i = 0; i < 60; ++i)
            (goesWithPeak(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
        const double room = (1.0 - 1e-6) * 0.25;
        const double byTime = std::sqrt((room - hand.temperature) / (32.0 * hand.share(0.05) * 2.0));
        CHECK(low == Approx(std::max(byTime, std::sqrt(room / 2.0))).epsilon(1e-6));
    }
}

TEST_CASE("A coil that bears any drive for a while admits it and goes ahead freely", "[actuator][protection]")
{
    const CoilHeatParams params{2.0, 0.5, Seconds(0.05)};
    CoilHeat heat = coilOf(params, 4000.0);
    const std::vector<double> full(32, 1.0);
    int groups = 0;
    for (; heat.bears(full.size()); ++groups)
    {
        REQUIRE(groups < 1000);
        CoilHeat copy = heat;
        for (const double drive : full)
        {
            REQUIRE(copy.admit(drive) == drive);
            copy.advance(drive);
        }
        REQUIRE(heat.advanceFreely(full, 1.0));
        CHECK(heat.admit(100.0) == copy.admit(100.0));
    }
    // The bound takes each stretch as if its coil did not cool: it ends less than two stretches before the limit.
    const double share = -std::expm1(-1.0 / (0.05 * 4000.0));
    const double frames = std::log1p(-0.25) / std::log1p(-share); // to 0.5 W of 2 W
    CHECK(32.0 * groups <= frames);
    CHECK(32.0 * groups > frames - 64.0);
}

TEST_CASE("What is left of a coil's heat far below all that matters becomes 0", "[actuator][protection]")
{
    CoilHeat heat = coilOf({1.0, 1.0, Seconds(0.01)}, 2000.0);
    for (int n = 0; n < 8; ++n)
    {
        CHECK(heat.measure(1e-52) > 0.0);
        heat.advance(1e-52);
    }
    heat.flush();
    CHECK(heat.measure(0.0) == 0.0);
    heat = coilOf({1.0, 1.0, Seconds(0.01)}, 2000.0);
    CHECK(heat.measure(1e-40) > 0.0);
    heat.flush();
    CHECK(heat.measure(0.0) > 0.0);
}
