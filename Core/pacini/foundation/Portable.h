#pragma once

// Elementary functions that are the same on every machine.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

/// Elementary functions whose results do not depend on the C library, as those of <cmath> do in their last bits: a
/// drive must not change with the machine. They are made of sums, products and quotients of doubles, which IEEE 754
/// fixes. Errors are below 1 unit in the last place, of turnBy() 1.5 and of tan() 2. They take as long as those of the
/// GNU C library (turnBy) to six times (pow): they are for what is computed once per event, breakpoint or filter. [any]
namespace pacini::portable
{

namespace detail
{

/// A number as the sum of two doubles, the second at most half a unit in the last place of the first.
struct Twofold
{
    double high;
    double low;
};

/// a + b without error, where |a| >= |b| or a is 0 (Dekker, "A Floating-Point Technique for Extending the Available
/// Precision", 1971).
[[nodiscard]] inline Twofold sumOf(double a, double b) noexcept
{
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

/// a b without error, both below 1e290 (Dekker 1971).
[[nodiscard]] inline Twofold productOf(double a, double b) noexcept
{
    constexpr double splitter = 134217729.0; // 2^27 + 1: halves of 26 bits
    const double scaledA = splitter * a;
    const double a1 = scaledA - (scaledA - a);
    const double a2 = a - a1;
    const double scaledB = splitter * b;
    const double b1 = scaledB - (scaledB - b);
    const double b2 = b - b1;
    const double product = a * b;
    return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

[[nodiscard]] inline Twofold productOf(Twofold a, double b) noexcept
{
    const Twofold product = productOf(a.high, b);
    return sumOf(product.high, product.low + a.low * b);
}

/// 1 / n!, each rounded once: factorials up to 22! are doubles.
inline constexpr auto inverseFactorials = []
{
    std::array<double, 19> values{};
    double factorial = 1.0;
    for (std::size_t n = 0; n < values.size(); ++n)
    {
        factorial *= n > 0 ? static_cast<double>(n) : 1.0;
        values[n] = 1.0 / factorial;
    }
    return values;
}();

/// ln x of a finite x > 0 is `whole` ln 2 + `rest`.
struct SplitLogarithm
{
    double whole;
    Twofold rest;
};

/// The rest by the series of 2 artanh t, t = (m - 1) / (m + 1), for the mantissa m from sqrt(1/2) to sqrt(2).
[[nodiscard]] inline SplitLogarithm logarithmOf(double x) noexcept
{
    int exponent = 0;
    double m = std::frexp(x, &exponent);
    if (m < 0.5 * std::numbers::sqrt2)
    {
        m *= 2.0;
        --exponent;
    }
    const double above = m - 1.0;
    const Twofold below = m < 1.0 ? sumOf(1.0, m) : sumOf(m, 1.0);
    const double t = above / below.high;
    const Twofold back = productOf(t, below.high);
    const double missing = ((above - back.high) - back.low - t * below.low) / below.high;
    const double tt = t * t;
    constexpr std::array<double, 11> odd{1.0 / 3.0,  1.0 / 5.0,  1.0 / 7.0,  1.0 / 9.0,  1.0 / 11.0, 1.0 / 13.0,
                                         1.0 / 15.0, 1.0 / 17.0, 1.0 / 19.0, 1.0 / 21.0, 1.0 / 23.0};
    double series = 0.0;
    for (std::size_t k = odd.size(); k-- > 0;)
        series = tt * (odd[k] + series);
    return {static_cast<double>(exponent), sumOf(2.0 * t, 2.0 * (missing + t * series))};
}

inline constexpr double perNeperMore = 2.0355273740931033e-17; // what log2 e lacks as a double

/// log2 x of a finite x > 0.
[[nodiscard]] inline Twofold binaryLogarithmOf(double x) noexcept
{
    const SplitLogarithm split = logarithmOf(x);
    const Twofold product = productOf(split.rest, std::numbers::log2e);
    const Twofold sum = sumOf(split.whole, product.high); // the rest is at most half
    return sumOf(sum.high, sum.low + (product.low + split.rest.high * perNeperMore));
}

[[nodiscard]] inline bool hasLogarithm(double x) noexcept
{
    return x > 0.0 && x < std::numeric_limits<double>::infinity();
}

[[nodiscard]] inline double limitOfLogarithm(double x) noexcept
{
    return x > 0.0 ? x : x == 0.0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
}

/// 2^x, by Taylor's series within half a step.
[[nodiscard]] inline double powerOfTwo(Twofold x) noexcept
{
    if (!(x.high < 1024.0))
        return x.high * std::numeric_limits<double>::infinity(); // what is not a number stays so
    if (x.high < -1080.0)
        return 0.0;
    constexpr double neperMore = 2.3190468138462996e-17; // what ln 2 lacks as a double
    const double whole = std::round(x.high);
    const double part = x.high - whole;
    const Twofold f = productOf(part, std::numbers::ln2);
    const double squared = f.high * f.high;
    double even = 0.0;
    double odd = 0.0;
    for (std::size_t n = 14; n >= 2; n -= 2) // side by side, which takes half as long
    {
        even = inverseFactorials[n] + squared * even;
        odd = inverseFactorials[n + 1] + squared * odd;
    }
    const Twofold sum = sumOf(1.0, f.high);
    const double rest = f.low + part * neperMore + x.low * std::numbers::ln2;
    const double bend = squared * (even + f.high * odd);
    return std::ldexp(sum.high + (sum.low + (bend + rest * (sum.high + bend))), static_cast<int>(whole));
}

/// 2^(log2Base x)
[[nodiscard]] inline double powerOf(Twofold log2Base, double x) noexcept
{
    const double within = std::min(std::max(x, -2000.0), 2000.0); // beyond, it is 0 or infinite
    const Twofold product = productOf(within, log2Base.high);
    return powerOfTwo(sumOf(product.high, product.low + within * log2Base.low));
}

/// Sine and cosine of x + rest, |x| at most 0.8, by Taylor's series.
[[nodiscard]] inline std::complex<double> smallTurn(double x, double rest) noexcept
{
    const double xx = x * x;
    double sine = 0.0;
    double cosine = 0.0;
    for (std::size_t n = 17; n >= 3; n -= 2)
    {
        sine = xx * (inverseFactorials[n] - sine);
        cosine = xx * (inverseFactorials[n + 1] - cosine);
    }
    // Halving is exact, and so is 1 - xx / 2 but for what `lost` is.
    const double half = 0.5 * xx;
    const double most = 1.0 - half;
    const double lost = (1.0 - most) - half;
    return {most + (lost + (xx * cosine - x * rest)), x + (rest - x * sine)};
}

/// A number of quarters of a turn, below 1e15, without the whole ones, and how many of these there are modulo 4.
struct Quarters
{
    explicit Quarters(double quarters) noexcept
    {
        constexpr double rounding = 6755399441055744.0; // 1.5 * 2^52: adding it rounds to whole numbers
        const double shifted = quarters + rounding;
        whole = shifted - rounding;
        quadrant = std::bit_cast<std::uint64_t>(shifted) & 3u;
    }
    double whole = 0.0;
    std::uint64_t quadrant = 0;
};

/// The turn by whole quarters and by `turn` more.
[[nodiscard]] inline std::complex<double> turnedOn(std::complex<double> turn, std::uint64_t quadrant) noexcept
{
    if (quadrant == 1)
        return {-turn.imag(), turn.real()};
    if (quadrant == 2)
        return {-turn.real(), -turn.imag()};
    if (quadrant == 3)
        return {turn.imag(), -turn.real()};
    return turn;
}

} // namespace detail

/// exp(2 pi i cycles), |cycles| below 1e14. Whole quarters are split off, exactly: they give 0, 1 and -1.
[[nodiscard]] inline std::complex<double> turnBy(double cycles) noexcept
{
    constexpr double radians = 2.0 * std::numbers::pi;
    constexpr double radiansMore = 2.4492935982947064e-16; // what that lacks
    const detail::Quarters quarters(4.0 * cycles);
    const double part = cycles - 0.25 * quarters.whole;
    return detail::turnedOn(detail::smallTurn(part * radians, part * radiansMore), quarters.quadrant);
}

/// exp(i radians), |radians| below 1e5; beyond, errors grow.
[[nodiscard]] inline std::complex<double> turnByRadians(double radians) noexcept
{
    // pi / 2 in three parts, the first two of 33 bits, so that their products with whole quarters are exact (Cody and
    // Waite, "Software Manual for the Elementary Functions", 1980).
    constexpr double first = 1.5707963267341256;
    constexpr double second = 6.0771005063039660e-11;
    constexpr double third = 2.0222662487959506e-21;
    const detail::Quarters quarters(radians * (2.0 / std::numbers::pi));
    const double large = radians - quarters.whole * first;
    const double step = quarters.whole * second;
    const double x = large - step;
    const double rest = ((large - x) - step) - quarters.whole * third;
    return detail::turnedOn(detail::smallTurn(x, rest), quarters.quadrant);
}

[[nodiscard]] inline double sin(double radians) noexcept
{
    return turnByRadians(radians).imag();
}

[[nodiscard]] inline double cos(double radians) noexcept
{
    return turnByRadians(radians).real();
}

[[nodiscard]] inline double tan(double radians) noexcept
{
    const std::complex<double> turn = turnByRadians(radians);
    return turn.imag() / turn.real();
}

/// base^exponent of a base of at least 0 and a finite exponent; 1 for the exponent 0, otherwise not a number below 0.
[[nodiscard]] inline double pow(double base, double exponent) noexcept
{
    if (!detail::hasLogarithm(base))
        return exponent == 0.0 ? 1.0 : detail::powerOfTwo({exponent * detail::limitOfLogarithm(base), 0.0});
    return detail::powerOfTwo(detail::productOf(detail::binaryLogarithmOf(base), exponent));
}

[[nodiscard]] inline double exp2(double x) noexcept
{
    return detail::powerOfTwo({x, 0.0});
}

[[nodiscard]] inline double exp(double x) noexcept
{
    return detail::powerOf({std::numbers::log2e, detail::perNeperMore}, x);
}

/// 10^x.
[[nodiscard]] inline double exp10(double x) noexcept
{
    return detail::powerOf({3.321928094887362, 1.661617516973592e-16}, x);
}

/// Natural logarithm: -infinity of 0, not a number below.
[[nodiscard]] inline double log(double x) noexcept
{
    if (!detail::hasLogarithm(x))
        return detail::limitOfLogarithm(x);
    constexpr double neper = 0.6931471804855391;        // the first 33 bits of ln 2, ...
    constexpr double neperMore = 7.440617110012397e-11; // ... and the rest
    const detail::SplitLogarithm split = detail::logarithmOf(x);
    const detail::Twofold sum = detail::sumOf(split.whole * neper, split.rest.high);
    return sum.high + (sum.low + (split.rest.low + split.whole * neperMore));
}

/// As log(), to base 2.
[[nodiscard]] inline double log2(double x) noexcept
{
    if (!detail::hasLogarithm(x))
        return detail::limitOfLogarithm(x);
    return detail::binaryLogarithmOf(x).high;
}

} // namespace pacini::portable
