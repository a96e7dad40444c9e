#include "cli/plot/Axis.h"

#include <pacini/foundation/RoundStep.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace pacini::plot
{

namespace
{
constexpr double slack = 1e-9; // share of a step by which a tick may miss the end of the range through rounding

std::string superscript(int number)
{
    constexpr std::array<std::string_view, 10> digits = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    std::string text;
    for (const char c : fmt::format("{}", number))
        text += c == '-' ? std::string_view("\u207b") : digits[static_cast<std::size_t>(c - '0')];
    return text;
}

/// With a true minus sign.
std::string plain(double value, int decimals)
{
    std::string text = fmt::format("{:.{}f}", std::abs(value), std::max(0, decimals));
    return value < 0.0 ? "\u2212" + text : text;
}

RoundStep stepFor(double low, double high, int most)
{
    const auto count = [&](const RoundStep& step)
    {
        return std::floor(high / step.size() + slack) - std::ceil(low / step.size() - slack) + 1.0;
    };
    RoundStep step{1, static_cast<int>(std::floor(std::log10((high - low) / most))) - 1};
    while (count(step) > most)
        step = step.next();
    return step;
}

std::string clockText(double seconds)
{
    const auto whole = static_cast<long long>(std::llround(std::abs(seconds)));
    const std::string sign = seconds < 0.0 ? "\u2212" : "";
    if (whole < 3600)
        return fmt::format("{}{}:{:02}", sign, whole / 60, whole % 60);
    return fmt::format("{}{}:{:02}:{:02}", sign, whole / 3600, whole / 60 % 60, whole % 60);
}
} // namespace

double positionOn(const Axis& axis, double value) noexcept
{
    if (axis.scale != Scale::logarithmic)
        return (value - axis.low) / (axis.high - axis.low);
    const double least = axis.low * 1e-6;
    return std::log(std::max(value, least) / axis.low) / std::log(axis.high / axis.low);
}

std::vector<Tick> linearTicks(double low, double high, int most)
{
    const RoundStep step = stepFor(low, high, most);
    const double first = std::ceil(low / step.size() - slack);
    const double last = std::floor(high / step.size() + slack);
    std::vector<Tick> ticks;
    for (double i = 0.0; i <= last - first; i += 1.0)
    {
        const double value = timesPowerOfTen((first + i) * step.mantissa, step.exponent);
        ticks.push_back({value + 0.0, plain(value, -step.exponent)});
    }
    return ticks;
}

std::vector<Tick> logarithmicTicks(double low, double high, int most)
{
    const int firstDecade = static_cast<int>(std::floor(std::log10(low)));
    const int lastDecade = static_cast<int>(std::floor(std::log10(high)));
    const auto inside = [&](double value)
    {
        return value >= low * (1.0 - slack) && value <= high * (1.0 + slack);
    };
    int majors = 0;
    int decades = 0;
    for (int decade = firstDecade; decade <= lastDecade + 1; ++decade)
    {
        decades += inside(timesPowerOfTen(1, decade)) ? 1 : 0;
        for (const int mantissa : {1, 2, 5})
            majors += inside(timesPowerOfTen(mantissa, decade)) ? 1 : 0;
    }
    if (majors < 2)
        return linearTicks(low, high, most);
    const bool finely = majors <= most;
    const int stride = finely ? 1 : std::max(1, (decades + most - 1) / most);
    const bool powers = low < 0.001 * (1.0 - slack) || high > 1e5 * (1.0 + slack);

    std::vector<Tick> ticks;
    for (int decade = firstDecade; decade <= lastDecade + 1; ++decade)
        for (int mantissa = 1; mantissa <= 9; ++mantissa)
        {
            const double value = timesPowerOfTen(mantissa, decade);
            if (!inside(value) || (stride > 1 && mantissa > 1))
                continue;
            const bool labelled =
                (mantissa == 1 && decade % stride == 0) || (finely && (mantissa == 2 || mantissa == 5));
            std::string label;
            if (labelled && powers)
                label = (mantissa == 1 ? "" : fmt::format("{}\u00b7", mantissa)) + "10" + superscript(decade);
            else if (labelled)
                label = plain(value, -decade);
            ticks.push_back({value, std::move(label)});
        }
    return ticks;
}

std::vector<Tick> timeTicks(double low, double high, int most)
{
    if (high - low <= 120.0)
        return linearTicks(low, high, most);
    constexpr std::array<double, 14> steps = {10,   20,   30,   60,   120,   300,   600,
                                              1200, 1800, 3600, 7200, 10800, 21600, 43200};
    double step = steps.back();
    for (const double candidate : steps)
        if (std::floor(high / candidate) - std::ceil(low / candidate) + 1.0 <= most)
        {
            step = candidate;
            break;
        }
    std::vector<Tick> ticks;
    for (double i = std::ceil(low / step - slack); i * step <= high * (1.0 + slack); i += 1.0)
        ticks.push_back({i * step, clockText(i * step)});
    return ticks;
}

std::vector<Tick> ticksOf(const Axis& axis, int most)
{
    if (!axis.fixedTicks.empty())
        return axis.fixedTicks;
    switch (axis.scale)
    {
    case Scale::logarithmic:
        return logarithmicTicks(axis.low, axis.high, std::max(most, 1));
    case Scale::time:
        return timeTicks(axis.low, axis.high, std::max(most, 1));
    case Scale::linear:
        break;
    }
    return linearTicks(axis.low, axis.high, std::max(most, 1));
}

Axis axisAround(std::string title, Scale scale, const std::vector<double>& values)
{
    const bool logarithmic = scale == Scale::logarithmic;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : values)
        if (std::isfinite(value) && (!logarithmic || value > 0.0))
        {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    if (low > high)
        return {std::move(title), scale, logarithmic ? 0.1 : 0.0, 1.0, {}};
    if (logarithmic)
    {
        const double room = std::max(std::pow(high / low, 0.06), 1.25);
        return {std::move(title), scale, low / room, high * room, {}};
    }
    // What differs by rounding only is one value.
    const double size = std::max(std::abs(low), std::abs(high));
    const double room = high - low > 1e-9 * size ? 0.06 * (high - low) : std::max(0.5 * size, 0.5);
    return {std::move(title), scale, low - room, high + room, {}};
}

} // namespace pacini::plot
