#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/actuator/LevelLimiter.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
std::vector<float> limited(const std::vector<float>& x, double fs, LevelLimiterParams params = {})
{
    LevelLimiter limiter;
    limiter.prepare({fs, 512});
    limiter.setParams(params);
    auto y = runInBlocks(limiter, x, 512);
    y.erase(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(limiter.latencyFrames()));
    return y;
}

std::vector<float> scaled(std::vector<float> x, double factor)
{
    for (float& v : x)
        v = static_cast<float>(factor * static_cast<double>(v));
    return x;
}
} // namespace

TEST_CASE("The level limiter keeps the contract of blocks", "[actuator][contract]")
{
    checkBlockContract<LevelLimiter>({}, {.bound = 1.0, .delay = MeasuredDelay::firstFrame});
    checkBlockContract<LevelLimiter>({20_Hz, 0_s}, {.bound = 1.0, .delay = MeasuredDelay::firstFrame});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    checkBlockContract<LevelLimiter>({Hertz(nan), Seconds(nan)}, {.bound = 1.0});
    checkModulation<LevelLimiter>({{}, {1000_Hz, 0_s}, {1_Hz, Seconds(1e9)}, {Hertz(nan), Seconds(nan)}}, 1.0);
}

TEST_CASE("What stays within full drive passes the level limiter bit for bit", "[actuator]")
{
    auto x = noise(20000, 3);
    x[500] = 1.0f;
    x[501] = -1.0f;
    auto y = limited(x, 48000.0);
    CHECK(std::equal(y.begin(), y.end(), x.begin()));
    CHECK(y.size() == x.size() - 48);
}

TEST_CASE("Nothing leaves the level limiter above full drive, and little below it is lost", "[actuator]")
{
    for (const double fs : {8000.0, 48000.0, 768000.0})
        for (const double decibels : {0.1, 3.0, 20.0, 200.0, 700.0})
        {
            CAPTURE(fs, decibels);
            const auto x = scaled(sine(static_cast<std::size_t>(fs), 60.0, fs, 1.0),
                                  std::min(std::pow(10.0, decibels / 20.0), 3e38));
            const auto y = limited(x, fs);
            CHECK(std::all_of(y.begin(), y.end(), [](float v) { return std::abs(v) <= 1.0f; }));
            // A loud tone becomes a tone of full drive, not a square wave.
            const auto steady = std::span(y).subspan(y.size() / 2, y.size() / 2 / 60 * 60);
            CHECK(rms(steady) == Approx(1.0 / std::sqrt(2.0)).epsilon(0.01));
        }
}

TEST_CASE("The level limiter reports what it takes", "[actuator]")
{
    LevelLimiter limiter;
    limiter.prepare({48000.0, 512});
    auto x = sine(4800, 100.0, 48000.0, 2.0);
    limiter.process(x, x);
    CHECK(limiter.meter().gainReduction == Approx(20.0 * std::log10(2.0)).epsilon(1e-3));
    CHECK(limiter.meter().level);
    limiter.setParams({100_Hz, 0.0005_s}); // which plays nothing
    CHECK(limiter.meter().level);
    limiter.reset();
    CHECK(limiter.meter().gainReduction == 0.0);
    CHECK_FALSE(limiter.meter().level);
    x = sine(4800, 100.0, 48000.0, 0.99);
    limiter.process(x, x);
    CHECK(limiter.meter().gainReduction == 0.0);
    CHECK_FALSE(limiter.meter().level);
}
