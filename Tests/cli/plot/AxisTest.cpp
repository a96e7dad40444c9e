#include "cli/plot/Axis.h"

#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace pacini::plot;

namespace
{
using Texts = std::vector<std::string>;

Texts labels(const std::vector<Tick>& ticks)
{
    Texts texts;
    for (const Tick& tick : ticks)
        if (!tick.label.empty())
            texts.push_back(tick.label);
    return texts;
}
} // namespace

TEST_CASE("Linear ticks are multiples of 1, 2 or 5 times a power of ten", "[plot]")
{
    CHECK(linearTicks(0.0, 1.0, 6) ==
          std::vector<Tick>{{0.0, "0.0"}, {0.2, "0.2"}, {0.4, "0.4"}, {0.6, "0.6"}, {0.8, "0.8"}, {1.0, "1.0"}});
    CHECK(linearTicks(0.0, 1.0, 11).size() == 11);
    CHECK(linearTicks(0.0, 1.0, 3) == std::vector<Tick>{{0.0, "0.0"}, {0.5, "0.5"}, {1.0, "1.0"}});
    CHECK(linearTicks(0.0, 1.0, 2) == std::vector<Tick>{{0.0, "0"}, {1.0, "1"}});
    CHECK(labels(linearTicks(-0.43, 0.43, 5)) == Texts{"\u22120.4", "\u22120.2", "0.0", "0.2", "0.4"});
    CHECK(labels(linearTicks(13.0, 4021.0, 5)) == Texts{"1000", "2000", "3000", "4000"});
    CHECK(labels(linearTicks(1.0, 1.05, 6)) == Texts{"1.00", "1.01", "1.02", "1.03", "1.04", "1.05"});
    CHECK(labels(linearTicks(0.0, 1.0 / 48000.0, 3)) == Texts{"0.00000", "0.00001", "0.00002"});
}

TEST_CASE("Linear ticks never number more than asked for and never leave the range", "[plot]")
{
    for (const double low : {-1234.5, -1e-9, 0.0, 0.1, 7.0, 86399.0})
        for (const double span : {1e-6, 0.003, 1.0, 17.0, 9e5})
            for (int most = 1; most <= 12; ++most)
            {
                INFO("low " << low << " span " << span << " most " << most);
                const auto ticks = linearTicks(low, low + span, most);
                CHECK(static_cast<int>(ticks.size()) <= most);
                for (const Tick& tick : ticks)
                {
                    CHECK(tick.value >= low - 1e-6 * span);
                    CHECK(tick.value <= low + span * (1.0 + 1e-6));
                }
                // The next finer step would have given more: with room for four there are always two.
                if (most >= 4)
                    CHECK(ticks.size() >= 2);
            }
}

TEST_CASE("Ranges that doubles hardly resolve have few ticks too", "[plot]")
{
    CHECK(linearTicks(1.0, std::nextafter(1.0, 2.0), 8).size() <= 8);
    CHECK(linearTicks(1e15, 1e15 + 0.25, 8).size() <= 8);
}

TEST_CASE("Logarithmic ticks are at 1, 2 and 5 while there is room, then at decades, then at every n-th", "[plot]")
{
    CHECK(labels(logarithmicTicks(25.0, 1200.0, 6)) == Texts{"50", "100", "200", "500", "1000"});
    CHECK(labels(logarithmicTicks(25.0, 1200.0, 4)) == Texts{"100", "1000"});
    CHECK(labels(logarithmicTicks(0.01, 10.0, 5)) == Texts{"0.01", "0.1", "1", "10"});
    CHECK(labels(logarithmicTicks(1e-7, 3e-6, 6)) == Texts{"10\u207b\u2077", "2\u00b710\u207b\u2077",
                                                           "5\u00b710\u207b\u2077", "10\u207b\u2076",
                                                           "2\u00b710\u207b\u2076"});
    CHECK(labels(logarithmicTicks(1e-12, 1.0, 5)) ==
          Texts{"10\u207b\u00b9\u00b2", "10\u207b\u2079", "10\u207b\u2076", "10\u207b\u00b3", "10\u2070"});
}

TEST_CASE("Minor logarithmic ticks are the other whole multiples within the range", "[plot]")
{
    std::vector<double> values;
    for (const Tick& tick : logarithmicTicks(25.0, 400.0, 10))
        values.push_back(tick.value);
    CHECK(values == std::vector<double>{30, 40, 50, 60, 70, 80, 90, 100, 200, 300, 400});
}

TEST_CASE("A logarithmic range within 1, 2 and 5 gets linear ticks", "[plot]")
{
    CHECK(labels(logarithmicTicks(310.0, 390.0, 5)) == Texts{"320", "340", "360", "380"});
}

TEST_CASE("Time ticks divide minutes and hours", "[plot]")
{
    CHECK(labels(timeTicks(0.0, 120.0, 7)) == Texts{"0", "20", "40", "60", "80", "100", "120"});
    CHECK(labels(timeTicks(0.0, 150.0, 6)) == Texts{"0:00", "0:30", "1:00", "1:30", "2:00", "2:30"});
    CHECK(labels(timeTicks(0.0, 3600.0, 8)) == Texts{"0:00", "10:00", "20:00", "30:00", "40:00", "50:00", "1:00:00"});
    CHECK(labels(timeTicks(0.0, 86400.0, 5)) == Texts{"0:00", "6:00:00", "12:00:00", "18:00:00", "24:00:00"});
}

TEST_CASE("Positions run from 0 to 1 over the axis", "[plot]")
{
    const Axis linear{"", Scale::linear, -2.0, 2.0, {}};
    CHECK(positionOn(linear, -2.0) == 0.0);
    CHECK(positionOn(linear, 1.0) == Approx(0.75));
    const Axis logarithmic{"", Scale::logarithmic, 10.0, 1000.0, {}};
    CHECK(positionOn(logarithmic, 100.0) == Approx(0.5));
    CHECK(positionOn(logarithmic, 1000.0) == Approx(1.0));
    for (const double none : {0.0, -1.0})
    {
        CHECK(std::isfinite(positionOn(logarithmic, none)));
        CHECK(positionOn(logarithmic, none) < 0.0);
    }
}

TEST_CASE("An axis around values shows them all, whatever they are", "[plot]")
{
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Scale scale : {Scale::linear, Scale::logarithmic})
        for (const auto& values : std::vector<std::vector<double>>{
                 {}, {0.0}, {5.0}, {1e-30}, {-3.0, 4.0}, {1e-8, 1e8}, {infinity, 2.0}, {1e20, 1e20 * (1.0 + 1e-15)}})
        {
            const Axis axis = axisAround("t", scale, values);
            CHECK(axis.high > axis.low);
            if (scale == Scale::logarithmic)
                CHECK(axis.low > 0.0);
            CHECK(ticksOf(axis, 8).size() >= 1);
            for (const double value : values)
                if (std::isfinite(value) && (scale == Scale::linear || value > 0.0))
                {
                    CHECK(positionOn(axis, value) > 0.0);
                    CHECK(positionOn(axis, value) < 1.0);
                }
        }
}
