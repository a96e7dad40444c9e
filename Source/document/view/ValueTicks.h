#pragma once

// Ticks of a value axis: at round values, as many as fit.

#include "document/view/ValueAxis.h"

#include <pacini/foundation/RoundStep.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pacini
{

/// Values that an axis is marked at, in rising order: on a scale of decibels whole steps from 0 dB down, else 1, 2 and
/// 5 times powers of ten. No two are nearer to each other, or to the upper and lower edge, than `gap` and half of it
/// (pixels, above 0).
[[nodiscard]] inline std::vector<double> valueTicks(const ValueAxis& axis, double gap)
{
    std::vector<double> ticks;
    const auto add = [&](double value)
    {
        const double y = axis.yOf(value);
        const bool apart = ticks.empty() || axis.yOf(ticks.back()) - y >= gap - 1e-6;
        if (apart && y >= 0.5 * gap && y <= axis.height - 0.5 * gap)
            ticks.push_back(value);
    };
    if (axis.scale == ValueScale::decibels)
    {
        const double perDecibel = axis.height / Decibels::fromGain(axis.high / axis.low).value;
        const double lowest = Decibels::fromGain(axis.low).value;
        for (const double step : {3.0, 6.0, 12.0, 20.0, 30.0})
            if (step * perDecibel >= gap)
            {
                for (double level = -step * std::floor(-lowest / step); level <= Decibels::fromGain(axis.high).value;
                     level += step)
                    add(Decibels(level).gain());
                break;
            }
        return ticks;
    }
    if (axis.scale == ValueScale::logarithmic)
    {
        const double perDecade = axis.height / std::log10(axis.high / axis.low);
        // 1, 2 and 5; 1 alone; or no more than fit in any case.
        const bool three = 0.301 * perDecade >= gap;
        for (double power = std::pow(10.0, std::floor(std::log10(axis.low))); power <= axis.high; power *= 10.0)
            for (const double digit : {1.0, 2.0, 5.0})
                if ((three || digit == 1.0) && digit * power >= axis.low && digit * power <= axis.high)
                    add(digit * power);
        return ticks;
    }
    const double span = axis.high - axis.low;
    if (!(span > 0.0))
        return ticks;
    const double step = RoundStep::from(span * gap / axis.height).size();
    for (double i = std::ceil(axis.low / step); i * step <= axis.high * (1.0 + 1e-12); i += 1.0)
        add(i * step);
    return ticks;
}

} // namespace pacini
