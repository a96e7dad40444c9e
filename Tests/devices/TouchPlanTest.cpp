#include "devices/TouchPlan.h"

#include "support/Catch.h"
#include "support/RandomClip.h"

#include <cstdint>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
Clip tone(double amplitude, double seconds = 2.0)
{
    Clip clip;
    clip.duration = seconds;
    clip.bands.push_back({100.0, 150.0, 200.0, 0, {{0.0, amplitude}, {seconds, amplitude}}, {}});
    return clip;
}

Clip roll(double gap, int count)
{
    Clip clip;
    clip.duration = gap * count + 0.1;
    for (int i = 0; i < count; ++i)
        clip.transients.push_back({0.05 + gap * i, 0.8, 0.5});
    return clip;
}

// The share of the time in which the motor is on.
double shareOf(const Clip& clip)
{
    double on = 0.0;
    for (const Touch& touch : touchPlan(clip).touches)
        on += touch.end - touch.start;
    return on / clip.duration;
}
} // namespace

TEST_CASE("Every push is long enough to be felt, and so is every gap", "[devices]")
{
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        CAPTURE(seed);
        Clip clip = test::randomFullClip(seed);
        clip.duration = std::max(clip.duration, 0.1);
        const auto plan = touchPlan(clip);
        for (std::size_t i = 0; i < plan.touches.size(); ++i)
        {
            CHECK(plan.touches[i].end - plan.touches[i].start >= touchLength.value - 1e-9);
            if (i > 0)
                CHECK(plan.touches[i].start - plan.touches[i - 1].end >= touchGap.value - 1e-9);
        }
        CHECK(plan.leftOut <= plan.events);
    }
}

TEST_CASE("A drum roll is counted by hand", "[devices]")
{
    const auto all = touchPlan(roll(0.057, 44));
    CHECK(all.events == 44);
    CHECK(all.leftOut == 0);
    REQUIRE(all.touches.size() == 44);
    for (std::size_t i = 0; i < 44; ++i)
        CHECK(all.touches[i].start == Approx(0.05 + 0.057 * static_cast<double>(i)).margin(0.010));

    const auto dense = touchPlan(roll(0.030, 44)); // every second of them
    CHECK(dense.events == 44);
    CHECK(dense.leftOut == 22);
    CHECK(dense.touches.size() == 22);
}

TEST_CASE("A tap is one push that is felt", "[devices]")
{
    Clip clip;
    clip.duration = 0.1;
    clip.transients.push_back({0.0, 1.0, 1.0});
    const auto plan = touchPlan(clip);
    REQUIRE(plan.touches.size() == 1);
    CHECK(plan.touches[0].start == 0.0);
    CHECK(plan.touches[0].end == Approx(0.035));
}

TEST_CASE("The share of the time in which the motor is on is the level", "[devices]")
{
    CHECK(touchPlan(tone(0.02)).touches.empty());
    CHECK(shareOf(tone(0.2)) == Approx(0.2).margin(0.05));
    CHECK(shareOf(tone(0.4)) == Approx(0.4).margin(0.05));
    CHECK(shareOf(tone(0.6)) == Approx(0.6).margin(0.05));
    CHECK(touchPlan(tone(0.9)).touches.size() == 1);
    CHECK(shareOf(tone(0.9)) > 0.97);
}

TEST_CASE("Noise and envelopes are felt, and an event stands out of what is felt already", "[devices]")
{
    Clip noise;
    noise.duration = 1.0;
    noise.noise.push_back({80.0, 300.0, {{0.0, 0.4}, {1.0, 0.4}}});
    CHECK(shareOf(noise) > 0.3);

    Clip quiet = tone(0.9);
    quiet.envelope = {{0.0, 0.2}, {2.0, 0.2}};
    CHECK(shareOf(quiet) == Approx(0.2).margin(0.05));

    Clip buzz = tone(0.9);
    buzz.transients.push_back({1.0, 1.0, 1.0});
    const auto plan = touchPlan(buzz);
    REQUIRE(plan.touches.size() >= 2);
    CHECK(plan.touches[0].end <= 0.9801);
    CHECK(plan.touches[1].start == Approx(1.0));
}

TEST_CASE("Of a clip of a day the first hour is felt, and an empty one is silent", "[devices]")
{
    CHECK(touchPlan(Clip{}).touches.empty());
    Clip day = roll(0.057, 3);
    day.duration = 86400.0;
    day.transients.push_back({4000.0, 1.0, 1.0});
    const auto plan = touchPlan(day);
    CHECK(plan.events == 3);
    CHECK(plan.touches.size() == 3);
}
