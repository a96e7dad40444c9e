#include "support/Catch.h"

#include <pacini/foundation/Glide.h>

#include <cmath>
#include <cstddef>
#include <limits>

using namespace pacini;

TEST_CASE("A glide reaches its goal in a straight line, exactly and on its frame, from wherever it is", "[glide]")
{
    Glide glide(1.0);
    CHECK(glide.restsAt(1.0));
    CHECK(glide.next() == 1.0);
    glide.glideTo(0.5, 10);
    CHECK_FALSE(glide.resting());
    CHECK(glide.goal() == 0.5);
    CHECK(glide.framesLeft() == 10);
    for (int n = 0; n < 10; ++n)
        CHECK(glide.next() == Approx(1.0 - 0.05 * n));
    CHECK(glide.restsAt(0.5));
    // Halfway it turns to where it is sent next.
    glide.glideTo(0.0, 10);
    glide.skip(5);
    CHECK(glide.now() == Approx(0.25));
    glide.glideTo(1.0, 4);
    Glide twin = glide;
    glide.skip(3);
    for (int n = 0; n < 3; ++n)
        twin.next();
    CHECK(glide.now() == twin.now()); // to the last bit
    glide.skip(100);
    CHECK(glide.restsAt(1.0));
    glide.glideTo(0.25, 0);
    CHECK(glide.restsAt(0.25));
    glide.glideTo(0.25, 1000); // it is there
    CHECK(glide.resting());
}

TEST_CASE("The frames of a glide are rounded, at most an hour, and none for what is no time", "[glide]")
{
    CHECK(framesOfGlide(Seconds(0.005), 48000.0) == 240);
    CHECK(framesOfGlide(Seconds(0.00001), 48000.0) == 0);
    CHECK(framesOfGlide(Seconds(0.0), 48000.0) == 0);
    CHECK(framesOfGlide(Seconds(-1.0), 48000.0) == 0);
    CHECK(framesOfGlide(Seconds(std::nan("")), 48000.0) == 0);
    CHECK(framesOfGlide(Seconds(std::numeric_limits<double>::infinity()), 10.0) == 36000);
}
