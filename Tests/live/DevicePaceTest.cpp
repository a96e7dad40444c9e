#include "live/DevicePace.h"

#include "support/Catch.h"

#include <chrono>

using namespace pacini::live;
using namespace std::chrono_literals;

namespace
{
constexpr double block = 128.0 / 48000.0; // s

/// Blocks until `until`, each `share` of a block's time after the one before. Returns whether the device keeps its
/// pace.
bool plays(DevicePace& pace, DevicePace::Clock::time_point& now, std::chrono::seconds length, double share)
{
    const auto end = now + length;
    bool keeps = true;
    while (now < end)
    {
        now += std::chrono::duration_cast<DevicePace::Clock::duration>(std::chrono::duration<double>(share * block));
        keeps = pace.keeps(block, now);
    }
    return keeps;
}
} // namespace

TEST_CASE("A device whose clock is a hundredth too quick or too slow keeps its pace for hours")
{
    for (const double share : {0.99, 1.0, 1.01})
    {
        DevicePace pace;
        DevicePace::Clock::time_point now{};
        CHECK(plays(pace, now, 3h, share));
    }
}

TEST_CASE("A device that hands in blocks at once has gone after half a second of sound, however long it played")
{
    for (const std::chrono::seconds before : {0s, 1s, 3600s})
    {
        DevicePace pace;
        DevicePace::Clock::time_point now{};
        REQUIRE(plays(pace, now, before, 1.0));
        int taken = 0;
        while (taken < 100000 && pace.keeps(block, now))
            ++taken;
        CHECK(taken * block > 0.4);
        CHECK(taken * block < 0.6);
        CHECK_FALSE(plays(pace, now, 60s, 1.0));
    }
}

TEST_CASE("A device may catch up after the program stood still")
{
    DevicePace pace;
    DevicePace::Clock::time_point now{};
    REQUIRE(plays(pace, now, 10s, 1.0));
    for (const auto pause : {1s, 9s})
    {
        now += pause;
        bool keeps = true;
        for (double caughtUp = 0.0; caughtUp < static_cast<double>(pause.count()); caughtUp += block)
            keeps = pace.keeps(block, now);
        CHECK(keeps);
        CHECK(plays(pace, now, 20s, 1.0));
    }
}
