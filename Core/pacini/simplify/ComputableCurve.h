#pragma once

// Curve scaling: a dense curve in units in which its squares can be computed.

#include <pacini/clip/Curve.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>

namespace pacini
{

/// A view of a curve that is scaled, in value and time, where it has to be: products of four differences must neither
/// overflow (values of 1e308) nor vanish (of 5e-324). The scales are powers of two, so that nothing is rounded but what
/// is too small against the largest value to count. Curves of ordinary size are looked at as they are. Does not own the
/// dense curve.
class ComputableCurve
{
public:
    explicit ComputableCurve(std::span<const Breakpoint> dense) : seen(dense)
    {
        double largestValue = 0.0, largestTime = 0.0;
        for (const Breakpoint& p : dense)
        {
            largestValue = std::max(largestValue, std::abs(p.value));
            largestTime = std::max(largestTime, std::abs(p.time));
        }
        valueExponent = exponentToRemove(largestValue);
        timeExponent = exponentToRemove(largestTime);
        if (valueExponent == 0 && timeExponent == 0)
            return;
        copy = scaled(dense);
        seen = copy;
    }
    ComputableCurve(const ComputableCurve&) = delete;
    ComputableCurve& operator=(const ComputableCurve&) = delete;

    [[nodiscard]] std::span<const Breakpoint> points() const noexcept { return seen; }

    /// A value or an error in the units of points(), and back.
    [[nodiscard]] double scaled(double value) const noexcept { return std::ldexp(value, -valueExponent); }

    /// Another curve in the units of points(), and back.
    [[nodiscard]] Curve scaled(std::span<const Breakpoint> curve) const
    {
        return moved(curve, -valueExponent, -timeExponent);
    }
    [[nodiscard]] Curve unscaled(std::span<const Breakpoint> curve) const
    {
        return moved(curve, valueExponent, timeExponent);
    }

private:
    /// 0 where fourth powers stay far inside the range of doubles.
    static int exponentToRemove(double largest) noexcept
    {
        int exponent = 0;
        (void)std::frexp(largest, &exponent);
        constexpr int ordinary = 200;
        return std::abs(exponent) <= ordinary ? 0 : exponent;
    }

    static Curve moved(std::span<const Breakpoint> curve, int values, int times)
    {
        constexpr double largest = std::numeric_limits<double>::max();
        Curve result(curve.begin(), curve.end());
        for (Breakpoint& p : result) // a vertex may lie a tolerance above the largest of all doubles
            p = {std::ldexp(p.time, times), std::clamp(std::ldexp(p.value, values), -largest, largest)};
        return result;
    }

    std::span<const Breakpoint> seen;
    Curve copy;
    int valueExponent = 0, timeExponent = 0;
};

} // namespace pacini
