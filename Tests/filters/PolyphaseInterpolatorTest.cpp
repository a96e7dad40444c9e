#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Pinned.h"

#include <pacini/filters/PolyphaseInterpolator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

std::vector<float> raised(PolyphaseInterpolator& interpolator, const std::vector<float>& in,
                          std::size_t piece = 1 << 20)
{
    std::vector<float> out(in.size() * interpolator.factor());
    for (std::size_t i = 0; i < in.size(); i += piece)
    {
        const std::size_t n = std::min(piece, in.size() - i);
        interpolator.process(std::span(in).subspan(i, n),
                             std::span(out).subspan(i * interpolator.factor(), n * interpolator.factor()));
    }
    return out;
}

} // namespace

TEST_CASE("Interpolators that share a design are as ones of their own", "[filters]")
{
    InterpolatorDesigns designs;
    const auto first = designs.get(12, 0.3);
    CHECK(designs.get(12, 0.3) == first);
    CHECK(designs.get(12, 0.30001) != first);
    CHECK(designs.get(11, 0.3) != first);
    CHECK(designs.get(1, 0.3) == designs.get(1, 0.2)); // nothing is filtered
    for (int i = 0; i < 100; ++i)                      // more than are kept
        CHECK(designs.get(7, 0.2 + 1e-3 * i)->isOf(7, 0.2 + 1e-3 * i));
    CHECK(designs.get(12, 0.3) != first); // made anew
    const auto x = sine(300, 0.1, 1.0, 0.7, 0.4), y = sine(300, 0.05, 1.0, 0.5, 0.1);
    PolyphaseInterpolator a(first), b(first), alone(12, 0.3), other(12, 0.3);
    CHECK(raised(a, x, 50) == raised(alone, x));
    CHECK(raised(b, y, 50) == raised(other, y));
    CHECK(a.latencyFrames() == alone.latencyFrames());
}

TEST_CASE("A tone of the pass band comes out at the higher rate as it was, images 70 dB down", "[filters]")
{
    for (const std::size_t factor : {2u, 3u, 5u, 12u, 24u})
        for (const double pass : {0.1, 0.25, 0.4, 0.44})
            for (const double share : {0.02, 0.5, 0.9, 1.0})
            {
                const double f = share * pass; // cycles per input frame
                const std::size_t frames = 3000;
                PolyphaseInterpolator interpolator(factor, pass);
                const auto out = raised(interpolator, sine(frames, f, 1.0, 0.7, 0.4));
                const std::size_t settled = 2 * interpolator.latencyFrames() + factor;
                REQUIRE(settled < out.size() / 2);
                double worst = 0.0;
                for (std::size_t n = settled; n < out.size(); ++n)
                {
                    const double position =
                        (static_cast<double>(n) - static_cast<double>(interpolator.latencyFrames())) /
                        static_cast<double>(factor);
                    const double expected = 0.7 * std::sin(2.0 * std::numbers::pi * f * position + 0.4);
                    worst = std::max(worst, std::abs(static_cast<double>(out[n]) - expected));
                }
                CAPTURE(factor, pass, share, 20.0 * std::log10(worst / 0.7));
                // The level (0.01 dB = 1.15e-3) and the images together.
                CHECK(worst < 0.7 * 1.4e-3);

                // Images around the multiples of the input rate, by a Hann window over many periods.
                std::vector<double> windowed;
                for (std::size_t n = settled; n < out.size(); ++n)
                {
                    const double turn = 2.0 * std::numbers::pi * static_cast<double>(n - settled) /
                                        static_cast<double>(out.size() - settled);
                    windowed.push_back(static_cast<double>(out[n]) * (0.5 - 0.5 * std::cos(turn)));
                }
                const auto level = [&](double frequency)
                {
                    return std::abs(
                        spectrumAt(std::span<const double>(windowed), frequency, static_cast<double>(factor)));
                };
                const double most = (pass < 0.3 ? 3.2e-4 : 1.2e-4) * level(f);
                for (std::size_t k = 1; 2 * k <= factor; ++k)
                {
                    CHECK(level(static_cast<double>(k) - f) < most);
                    if (2 * k < factor)
                        CHECK(level(static_cast<double>(k) + f) < most);
                }
            }
}

TEST_CASE("A constant stays exactly constant", "[filters]")
{
    PolyphaseInterpolator interpolator(7, 0.3);
    const auto out = raised(interpolator, std::vector<float>(500, 0.25f));
    for (std::size_t n = 2 * interpolator.latencyFrames() + 7; n < out.size(); ++n)
        REQUIRE(out[n] == Approx(0.25).epsilon(1e-6));
}

TEST_CASE("A factor of one changes nothing and delays nothing", "[filters]")
{
    PolyphaseInterpolator interpolator(1, 0.3);
    const auto x = noise(300, 3);
    CHECK(interpolator.latencyFrames() == 0);
    CHECK((raised(interpolator, x) == x));
}

TEST_CASE("Pieces of any size and a reset do not show, and processing makes no heap traffic", "[filters]")
{
    const auto x = noise(2000, 4);
    for (const std::size_t factor : {1u, 4u, 6u})
    {
        PolyphaseInterpolator interpolator(factor, 0.3);
        const auto whole = raised(interpolator, x);
        for (const std::size_t piece : {1u, 13u, 512u})
        {
            interpolator.reset();
            CHECK((raised(interpolator, x, piece) == whole));
        }
        interpolator.reset();
        std::vector<float> out(x.size() * factor);
        const HeapGuard guard;
        interpolator.process(x, out);
        interpolator.reset();
        CHECK(guard.traffic() == 0);
    }
}

TEST_CASE("The taps of an interpolator are Kaiser's for 80 dB and as they were before", "[filters]")
{
    struct Design
    {
        std::size_t factor;
        double pass;
    };
    for (const auto& [factor, pass] : {Design{2, 0.1}, {3, 0.3}, {8, 1.0 / 6.0}, {5, 0.44}})
    {
        CAPTURE(factor, pass);
        PolyphaseInterpolator interpolator(factor, pass);
        // (A - 7.95) / (14.36 width) + 1, made even; half of it is the delay.
        const double least = (80.0 - 7.95) / (14.36 * (1.0 - 2.0 * pass)) + 1.0;
        const auto taps = static_cast<double>(2 * interpolator.latencyFrames() / factor);
        CHECK(taps >= least);
        CHECK(taps < least + 2.0);
        const auto h = raised(interpolator, impulse(static_cast<std::size_t>(taps) + 3));
        CHECK(h[interpolator.latencyFrames()] == Approx(1.0).epsilon(1e-3));
        for (std::size_t n = static_cast<std::size_t>(taps) * factor; n < h.size(); ++n)
            CHECK(h[n] == 0.0f);
        checkPinned("filters/interpolator by " + std::to_string(factor) + ", pass " + std::to_string(pass).substr(0, 4),
                    std::vector<double>(h.begin(), h.end()), 2e-6);
    }
}
