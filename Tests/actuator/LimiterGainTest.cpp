#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/actuator/LimiterGain.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("The sliding maximum is that of the newest values", "[actuator]")
{
    for (const std::size_t length : {std::size_t(1), std::size_t(2), std::size_t(7), std::size_t(100)})
    {
        Random random(length);
        SlidingMaximum sliding;
        sliding.prepare(100);
        sliding.setLength(length);
        std::vector<double> values; // -1: a frame without
        for (std::size_t n = 0; n < 5000; ++n)
        {
            // Runs that rise, fall, stand and have gaps.
            const double rounded = std::floor(8.0 * random.uniform(0.0, 1.0));
            const bool none = n % 700 > 500 || random.uniform(0.0, 1.0) < 0.2;
            values.push_back(none ? -1.0 : n % 300 < 150 ? rounded + static_cast<double>(n % 150) : rounded);
            if (none)
                sliding.skip();
            else
                sliding.push(values.back());
            const auto from = values.end() - static_cast<std::ptrdiff_t>(std::min(length, values.size()));
            const double wanted = *std::max_element(from, values.end());
            CAPTURE(length, n);
            REQUIRE(sliding.empty() == (wanted < 0.0));
            if (!sliding.empty())
                REQUIRE(sliding.largest() == wanted);
        }
        // A shorter window forgets at once.
        sliding.push(1000.0);
        sliding.push(1.0);
        sliding.setLength(1);
        CHECK(sliding.largest() == 1.0);
    }
}

namespace
{
/// What leaves a limiter with a look-ahead of 48 and a hold of 1200 frames, without its delay.
template <typename Knee>
std::vector<double> behindLimiter(const std::vector<double>& x)
{
    KneeLimiterGain<Knee> gain;
    gain.prepare(48, 1200);
    gain.design(48, 1200, 48000.0);
    std::vector<double> y;
    for (std::size_t n = 0; n < x.size() + 48; ++n)
    {
        const double level = n < x.size() ? x[n] : 0.0;
        const double g = gain.tick(level * level);
        if (n >= 48)
            y.push_back(g * x[n - 48]);
    }
    return y;
}

/// Tones that beat and swell through the limit, with peaks nearly alike: what thresholds stumble over.
std::vector<double> beating(std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> x(24000, 0.0);
    for (int tone = 0; tone < 4; ++tone)
    {
        const double step = 2.0 * 3.14159265358979 * random.uniform(30.0, 300.0) / 48000.0;
        const double level = random.uniform(0.2, 1.0), swell = random.uniform(1e-4, 1e-3);
        for (std::size_t n = 0; n < x.size(); ++n)
            x[n] += level * (1.0 + std::sin(swell * static_cast<double>(n))) * std::sin(step * static_cast<double>(n));
    }
    return x;
}

/// The largest value of late, with what the gain holds, lets go and looks ahead.
std::vector<double> largestOfLate(const std::vector<double>& e)
{
    std::vector<double> largest(e.size(), 0.0);
    const double decay = std::pow(10.0, -40.0 / (20.0 * 48000.0));
    SlidingMaximum window;
    window.prepare(1201 + 49);
    window.setLength(1201 + 49);
    double late = 0.0;
    for (std::size_t n = 0; n < e.size() + 48; ++n)
    {
        window.push(n < e.size() ? std::abs(e[n]) : 0.0);
        late = std::max(late * decay, window.largest());
        if (n >= 48)
            largest[n - 48] = late;
    }
    return largest;
}

template <typename Knee>
void checkContinuity()
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        for (const double size : {0.1, 1e-3, 1e-6})
        {
            CAPTURE(seed, size);
            const auto x = beating(seed);
            auto y = x, e = beating(seed + 100);
            for (std::size_t n = 0; n < x.size(); ++n)
            {
                e[n] *= size;
                y[n] -= e[n];
            }
            const auto whole = behindLimiter<Knee>(x), some = behindLimiter<Knee>(y), late = largestOfLate(e);
            double worst = 0.0, change = 0.0;
            for (std::size_t n = 0; n < x.size(); ++n)
            {
                worst = std::max(worst, std::abs(whole[n] - some[n]) - std::abs(e[n]) - late[n]);
                change = std::max(change, std::abs(whole[n] - x[n]));
            }
            CHECK(worst <= 1e-12);
            CHECK(change > 0.1); // it did limit
        }
}
} // namespace

TEST_CASE("A limiter changes an error by no more than its largest value of late", "[actuator]")
{
    checkContinuity<HardKnee>();
    checkContinuity<SoftKnee>();
}

TEST_CASE("The limiter's gain holds for its time and lets go by 40 dB a second", "[actuator]")
{
    LimiterGain gain;
    gain.prepare(0, 480);
    gain.design(0, 480, 48000.0);
    CHECK(gain.tick(16.0) == 0.25);
    for (int n = 0; n < 480; ++n)
        REQUIRE(gain.tick(1.0) == 0.25);
    double g = 0.25;
    for (int n = 0; n < 4800; ++n)
        g = gain.tick(1.0);
    CHECK(20.0 * std::log10(g / 0.25) == Approx(4.0).margin(0.01));
    for (int n = 0; n < 48000; ++n)
        g = gain.tick(0.5);
    CHECK(g == 1.0);
    CHECK(gain.idle());
}
