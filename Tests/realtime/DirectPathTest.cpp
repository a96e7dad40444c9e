#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/realtime/DirectPath.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
constexpr double pathRate = 6000.0;
constexpr Hertz low(20.0), border(100.0), high(1000.0);

std::complex<double> warped(double f, Hertz corner)
{
    return {0.0, std::tan(std::numbers::pi * f / pathRate) / std::tan(std::numbers::pi * corner.value / pathRate)};
}

/// Gains below and above the border as the header states them: a shelf whose poles, those of Butterworth's fourth
/// order, stand on the border.
std::complex<double> shelf(std::complex<double> s, double below, double above)
{
    if (below < above) // the mirrored form
        return shelf(1.0 / s, above, below);
    // From below / above = 1 / r^4 downwards: the stronger side is the lower one, at 1.
    const double r = std::pow(above / below, 0.25);
    std::complex<double> product = 1.0;
    for (const double angle : {std::numbers::pi / 8.0, 3.0 * std::numbers::pi / 8.0})
    {
        const double k = 2.0 * std::cos(angle);
        product *= (r * r * s * s + k * r * s + 1.0) / (s * s + k * s + 1.0);
    }
    return product;
}

std::complex<double> expected(double f, double below, double above)
{
    const auto butterworth = [](std::complex<double> s)
    {
        return 1.0 / (s * s + std::numbers::sqrt2 * s + 1.0);
    };
    const auto s = warped(f, low);
    return std::max(below, above) * s * s * butterworth(s) * butterworth(warped(f, high)) *
           shelf(warped(f, border), below, above);
}

/// Hop by hop, each of which goes `share` of the way to the gains.
std::vector<double> run(DirectPath& path, std::span<const double> in, double below, double above, double share)
{
    std::vector<double> out(in.size());
    for (std::size_t n = 0; n < in.size(); n += controlHop)
    {
        path.aim(below, above, share);
        // In two calls, which must not matter.
        path.process(in.subspan(n, 3), std::span(out).subspan(n, 3), 0);
        path.process(in.subspan(n + 3, controlHop - 3), std::span(out).subspan(n + 3, controlHop - 3), 3);
    }
    return out;
}
} // namespace

TEST_CASE("the direct path is a range between Butterworth slopes with a Butterworth shelf at the border", "[realtime]")
{
    std::vector<double> impulse(8000, 0.0);
    impulse[0] = 1.0;
    for (const auto& [below, above] :
         {std::pair{1.0, 1.0}, {0.5, 0.5}, {1.0, 0.25}, {0.1, 0.8}, {2.0, 0.0}, {0.0, 1.5}, {0.9, 1.0}})
    {
        DirectPath path;
        path.design(low, border, high, pathRate);
        path.jump(below, above);
        CHECK_FALSE(path.silent());
        const auto out = run(path, impulse, below, above, 1.0);
        for (const double f : {10.0, 20.0, 60.0, 100.0, 140.0, 400.0, 1000.0, 2000.0})
        {
            CAPTURE(below, above, f);
            CHECK(std::abs(test::spectrumAt(std::span<const double>(out), f, pathRate) - expected(f, below, above)) <
                  1e-6);
        }
    }
}

TEST_CASE("gains of the direct path move along glides from hop to hop", "[realtime]")
{
    // Equal gains: the shelf is the identity, and what is left is one factor.
    std::vector<double> in(controlHop * 80);
    for (std::size_t n = 0; n < in.size(); ++n)
        in[n] = std::sin(0.2 * static_cast<double>(n));
    DirectPath plain, moved;
    for (DirectPath* path : {&plain, &moved})
    {
        path->design(low, border, high, pathRate);
        path->jump(1.0, 1.0);
    }
    const auto whole = run(plain, in, 1.0, 1.0, 1.0);
    const auto faded = run(moved, in, 0.0, 0.0, 0.5);
    HopGlide gain;
    gain.jump(1.0);
    for (std::size_t n = 0; n < in.size(); ++n)
    {
        CAPTURE(n);
        if (n % controlHop == 0)
            gain.aim(0.0, 0.5);
        CHECK(faded[n] == Approx(whole[n] * gain.at(n % controlHop)).margin(1e-12));
    }
    CHECK(moved.silent());
}

TEST_CASE("the shelf of the direct path moves, comes and goes without a jump", "[realtime]")
{
    for (const double f : {40.0, 100.0, 600.0})
        for (const bool lowerMoves : {false, true})
        {
            CAPTURE(f, lowerMoves);
            const double turn = 2.0 * std::numbers::pi * f / pathRate;
            DirectPath path;
            path.design(low, border, high, pathRate);
            path.jump(1.0, 1.0);
            double largest = 0.0, before = 0.0, steepest = 0.0;
            for (std::size_t hop = 0; hop < 600; ++hop)
            {
                const double moved = hop / 100 % 2 == 0 ? 1.0 : 0.0;
                path.aim(lowerMoves ? moved : 1.0, lowerMoves ? 1.0 : moved, 0.2);
                std::vector<double> in(controlHop), out(controlHop);
                for (std::size_t i = 0; i < controlHop; ++i)
                    in[i] = std::sin(turn * static_cast<double>(hop * controlHop + i));
                path.process(in, out, 0);
                path.flush();
                for (const double y : out)
                {
                    largest = std::max(largest, std::abs(y));
                    steepest = std::max(steepest, std::abs(y - before));
                    before = y;
                }
            }
            CHECK(largest < 1.15);
            CHECK(steepest < turn + 0.2 / static_cast<double>(controlHop));
        }
}

TEST_CASE("the direct path has forgotten all after a reset", "[realtime]")
{
    std::vector<double> in(controlHop * 20, 0.7);
    DirectPath path, fresh;
    for (DirectPath* one : {&path, &fresh})
        one->design(low, border, high, pathRate);
    for (const auto& [below, above] : {std::pair{1.0, 1.0}, {0.3, 0.8}})
    {
        (void)run(path, in, 0.5, 1.0, 0.7);
        for (DirectPath* one : {&path, &fresh})
        {
            one->reset();
            one->jump(below, above);
        }
        CHECK(run(path, in, below, above, 1.0) == run(fresh, in, below, above, 1.0));
    }
}

TEST_CASE("a jump of the direct path's gains leaves nothing of a way that was begun", "[realtime]")
{
    std::vector<double> in(controlHop), expected(controlHop), found(controlHop);
    for (std::size_t i = 0; i < controlHop; ++i)
        in[i] = std::cos(0.3 * static_cast<double>(i));
    for (const auto& [below, above] : {std::pair{0.5, 0.5}, {0.2, 0.9}, {0.0, 0.7}})
    {
        DirectPath path, plain;
        for (DirectPath* one : {&path, &plain})
            one->design(low, border, high, pathRate);
        CHECK(path.silent());
        path.aim(1.0, 0.3, 0.5);
        path.jump(below, above);
        CHECK_FALSE(path.silent());
        plain.jump(below, above);
        path.process(in, found, 0);
        plain.process(in, expected, 0);
        CHECK(found == expected);
        // The same as aiming there at once.
        DirectPath aimed;
        aimed.design(low, border, high, pathRate);
        aimed.jump(below, above);
        aimed.aim(below, above, 1.0);
        aimed.process(in, found, 0);
        for (std::size_t i = 0; i < controlHop; ++i)
            CHECK(found[i] == Approx(expected[i]).margin(1e-12));
    }
}

TEST_CASE("one gain of the direct path keeps it from being silent", "[realtime]")
{
    DirectPath path;
    path.design(low, border, high, pathRate);
    path.jump(0.0, 0.1);
    CHECK_FALSE(path.silent());
    path.jump(0.1, 0.0);
    CHECK_FALSE(path.silent());
    path.jump(0.0, 0.0);
    CHECK(path.silent());
}
