#include "io/MotionFile.h"

#include "support/Catch.h"
#include "support/Refused.h"

#include <string>

using namespace pacini;

TEST_CASE("Speed and force are read from any usual table of numbers")
{
    const Curve speed = {{0.0, 10.0}, {0.5, 250.0}, {2.0, 0.0}};
    const Curve force = {{0.0, 1.0}, {0.5, 2.5}, {2.0, 0.25}};
    for (const char* text :
         {"0,10,1\n0.5,250,2.5\n2,0,0.25\n", "time;speed;force\n0;10;1\n0,5;250;2,5\n2;0;0,25",
          "# a hand\n0\t10\t1\r\n.5\t250\t2.5\r\n2\t0\t.25\r\n", "0 10 1 x\n0.5 250 2.5 y\n2 0 0.25 z"})
    {
        CAPTURE(text);
        const auto motion = readMotionTable(text);
        REQUIRE(motion);
        CHECK(motion->speed == speed);
        CHECK(motion->force == force);
    }
    const auto alone = readMotionTable("time,speed\n0,10\n0.5,250\n2,0\n");
    REQUIRE(alone);
    CHECK(alone->speed == speed);
    CHECK(alone->force.empty());
}

TEST_CASE("A wrong line of a table of speeds is named")
{
    const auto where = [](const std::string& text)
    {
        return test::refusedAt(readMotionTable(text));
    };
    CHECK(where("").empty());
    CHECK(where("time,speed\n").empty());
    CHECK(where("a,b\nc,d\n") == "line 2: time");
    CHECK(where("0,1\n1,x\n") == "line 2: speed");
    CHECK(where("0,1\n1\n") == "line 2: speed");
    CHECK(where("0,1\n\n0,1\n") == "line 3: time");
    CHECK(where("0,1\n-1,1\n") == "line 2: time");
    CHECK(where("0,nan\n") == "line 1: speed");
    CHECK(where("0,1e999\n").starts_with("line 1: speed"));
    CHECK(where("0,1,1\n1,1\n") == "line 2: force");
    CHECK(where("0,1\n1,1,1\n") == "line 2: force");
    CHECK(where("0,1,1\n1,1,x\n") == "line 2: force");
}

TEST_CASE("A curve in words is a number or points in order")
{
    const auto points = curveOfText("0:0 .5:1,1:0.3");
    REQUIRE(points);
    CHECK(*points == Curve{{0.0, 0.0}, {0.5, 1.0}, {1.0, 0.3}});
    CHECK(*curveOfText("0.25") == Curve{{0.0, 0.25}});
    CHECK(*curveOfText("0:1 1:1 1:0") == Curve{{0.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}}); // a step
    for (const char* text : {"", " ", "x", "0:", ":1", "0:2", "-1:0", "0:-0.1", "0:nan", "inf:1", "1:0 0:1", "0.5 0.6",
                             "0:1:2", "1e999:1", "\x80:1"})
    {
        CAPTURE(text);
        const auto curve = curveOfText(text);
        REQUIRE_FALSE(curve);
        CHECK(curve.error().message.find('\n') == std::string::npos);
    }
}
