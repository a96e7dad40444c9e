#pragma once

// Round steps between the ticks of an axis: 1, 2 or 5 times a power of ten.

#include <cmath>

namespace pacini
{

/// 10^exponent times a number, as close as a double comes.
[[nodiscard]] inline double timesPowerOfTen(double number, int exponent)
{
    return exponent < 0 ? number / std::pow(10.0, -exponent) : number * std::pow(10.0, exponent);
}

/// A step of 1, 2 or 5 times a power of ten.
struct RoundStep
{
    int mantissa = 1; ///< 1, 2 or 5
    int exponent = 0;

    /// The finest of at least `least`, or a millionth below it; above 0.
    [[nodiscard]] static RoundStep from(double least)
    {
        RoundStep step{1, static_cast<int>(std::floor(std::log10(least)))};
        while (step.size() < least * (1.0 - 1e-6))
            step = step.next();
        return step;
    }

    [[nodiscard]] double size() const { return timesPowerOfTen(mantissa, exponent); }

    /// The next coarser one.
    [[nodiscard]] RoundStep next() const
    {
        return mantissa == 1   ? RoundStep{2, exponent}
               : mantissa == 2 ? RoundStep{5, exponent}
                               : RoundStep{1, exponent + 1};
    }
};

} // namespace pacini
