#include "support/Catch.h"

#include <pacini/foundation/Fade.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

using namespace pacini;

TEST_CASE("a fade arrives exactly after its frames, without a corner", "[foundation]")
{
    Fade fade;
    fade.prepare(480);
    fade.jump(0.25);
    CHECK(fade.restsAt(0.25));
    CHECK(fade.framesLeft() == 0);
    fade.aim(1.0);
    CHECK_FALSE(fade.resting());
    double before = 0.25, slope = 0.0, corner = 0.0;
    for (std::size_t n = 0; n < 480; ++n)
    {
        CHECK(fade.framesLeft() == 480 - n);
        const double now = fade.next();
        CHECK(now > before);
        corner = std::max(corner, std::abs(now - before - slope));
        slope = now - before;
        before = now;
    }
    CHECK(fade.restsAt(1.0));
    CHECK(fade.next() == 1.0);
    CHECK(corner < 6.1 * 0.75 / (480.0 * 480.0)); // the curvature at its ends
}

TEST_CASE("a target that moves during a fade counts from its end on, and no fade leaves the range of its targets",
          "[foundation]")
{
    Fade fade;
    fade.prepare(10);
    fade.aim(1.0);
    for (int n = 0; n < 4; ++n)
        (void)fade.next();
    fade.aim(0.5);
    for (int n = 0; n < 6; ++n)
        (void)fade.next();
    CHECK(fade.value() == 1.0);
    CHECK_FALSE(fade.resting());
    for (int n = 0; n < 10; ++n)
    {
        const double level = fade.next();
        CHECK(level >= 0.5);
        CHECK(level <= 1.0);
    }
    CHECK(fade.restsAt(0.5));
    Fade shortest;
    shortest.prepare(0);
    shortest.aim(1.0);
    CHECK(shortest.next() == 1.0);
}
