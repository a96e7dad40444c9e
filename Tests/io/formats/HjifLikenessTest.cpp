// How far an HJIF file is from its clip, in points.

#include "io/formats/hjif/HjifLikeness.h"

#include "support/Catch.h"

#include <cmath>

using namespace pacini;

namespace
{
Clip hum(double amplitude)
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{90.0, 100.0, 110.0, 0, {{0.0, amplitude}, {1.0, amplitude}}, {{0.0, 100.0}}}};
    return clip;
}

Clip tap()
{
    Clip clip;
    clip.duration = 1.0;
    clip.transients = {{0.5, 0.8, 0.0}};
    return clip;
}

/// A hum that begins at once at `start`.
Clip begin(double start)
{
    Clip clip = hum(0.0);
    clip.bands[0].amplitude = {{0.0, 0.0}, {start, 0.0}, {start, 0.5}, {1.0, 0.5}};
    return clip;
}

Clip silence()
{
    Clip clip;
    clip.duration = 1.0;
    return clip;
}
} // namespace

TEST_CASE("A file of the same waves is no distance from its clip, silence none from silence", "[formats]")
{
    const HjifDistance same = HjifLikeness(hum(0.5), {}).distanceTo(hum(0.5), hjifEventsOf(hum(0.5)));
    CHECK(std::abs(same.value) < 1e-6);
    CHECK(same.events.empty());
    const HjifDistance nothing = HjifLikeness(silence(), {}).distanceTo(silence(), hjifEventsOf(silence()));
    CHECK(nothing.value == 0.0);
    CHECK(nothing.events.empty());
}

TEST_CASE("An event that only one of clip and file has is far and told with its time", "[formats]")
{
    const HjifDistance lost = HjifLikeness(tap(), {}).distanceTo(silence(), hjifEventsOf(silence()));
    REQUIRE(lost.events.size() == 1);
    CHECK(lost.events[0] == Approx(0.5).margin(0.02));
    CHECK(lost.value >= 100.0); // as something else altogether
    const HjifDistance added = HjifLikeness(silence(), {}).distanceTo(tap(), hjifEventsOf(tap()));
    REQUIRE(added.events.size() == 1);
    CHECK(added.events[0] == Approx(0.5).margin(0.02));
    const HjifDistance kept = HjifLikeness(tap(), {}).distanceTo(tap(), hjifEventsOf(tap()));
    CHECK(kept.events.empty());
    CHECK(kept.value < 0.5 * lost.value);
}

TEST_CASE("Events within 6 ms of each other are the same, others are told both", "[formats]")
{
    HjifLikeness likeness(begin(0.5), {});
    for (const double apart : {-0.005, -0.003, 0.0, 0.003, 0.005})
    {
        CAPTURE(apart);
        CHECK(likeness.distanceTo(begin(0.5 + apart), hjifEventsOf(begin(0.5 + apart))).events.empty());
    }
    for (const double apart : {-0.2, -0.008, 0.008, 0.2})
    {
        CAPTURE(apart);
        const auto events = likeness.distanceTo(begin(0.5 + apart), hjifEventsOf(begin(0.5 + apart))).events;
        REQUIRE(events.size() == 2);
        CHECK(events[1] - events[0] == Approx(apart).margin(0.002));
    }
}
