#pragma once

// Flatness check of a response, to verify an equalizer.

#include <pacini/actuator/ProfileMeasurement.h>
#include <pacini/linearize/FrequencyResponse.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pacini
{

/// Parameters of the flatness check.
struct LinearityParams
{
    double lowFrequency = 0.0;  ///< Hz, start of the range to judge; 0: from the first point
    double highFrequency = 0.0; ///< Hz; 0: to the last point
    double tolerance = 4.0; ///< dB to both sides of the mean, 0 to 100; M. Weber, "A Framework for Audio-Tactile Signal
                            ///< Translation", 2020, section 3.3, came within about 4 dB
    bool operator==(const LinearityParams&) const = default;
};

/// Flatness of a response over a range. Means are taken over the logarithm of frequency by the trapezoid rule, so that
/// the spacing of the points does not matter; each run of points beyond the tolerance is one outlier. Errors: those of
/// validate(); invalidArgument at `tolerance` or `range`, the latter when fewer than 8 points lie in it.
[[nodiscard]] inline Result<Linearity> judgeLinearity(const FrequencyResponse& response, const LinearityParams& params)
{
    if (auto valid = validate(response); !valid)
        return valid.error();
    if (!(params.tolerance >= 0.0 && params.tolerance <= 100.0))
        return Error{ErrorCode::invalidArgument, "tolerance", "must be 0 to 100 dB"};
    const auto& f = response.frequency;
    constexpr double rounding = 1e-9; // an end that came through a text file still has its point
    const double low = params.lowFrequency > 0.0 ? params.lowFrequency : f.front();
    const double high = params.highFrequency > 0.0 ? params.highFrequency : f.back();
    const auto first =
        static_cast<std::size_t>(std::lower_bound(f.begin(), f.end(), low * (1.0 - rounding)) - f.begin());
    const auto end =
        static_cast<std::size_t>(std::upper_bound(f.begin(), f.end(), high * (1.0 + rounding)) - f.begin());
    if (end < first + FrequencyResponse::fewestPoints)
        return Error{ErrorCode::invalidArgument, "range", "holds fewer than 8 points of the response"};

    const auto mean = [&](auto&& value)
    {
        double sum = 0.0;
        double width = 0.0;
        for (std::size_t i = first; i + 1 < end; ++i)
        {
            const double octaves = std::log2(f[i + 1] / f[i]);
            sum += 0.5 * octaves * (value(i) + value(i + 1));
            width += octaves;
        }
        return sum / width;
    };
    Linearity result;
    result.lowFrequency = f[first];
    result.highFrequency = f[end - 1];
    result.tolerance = params.tolerance;
    result.level = mean([&](std::size_t i) { return response.level[i]; });
    const auto deviation = [&](std::size_t i)
    {
        return response.level[i] - result.level;
    };
    result.meanDeviation = mean([&](std::size_t i) { return std::abs(deviation(i)); });
    result.standardDeviation = std::sqrt(mean([&](std::size_t i) { return deviation(i) * deviation(i); }));
    result.worstFrequency = f[first];
    bool inside = false;
    for (std::size_t i = first; i < end; ++i)
    {
        const double d = deviation(i);
        if (std::abs(d) > std::abs(result.worstDeviation))
        {
            result.worstDeviation = d;
            result.worstFrequency = f[i];
        }
        const bool beyond = std::abs(d) > params.tolerance;
        if (beyond && !inside)
            result.outliers.push_back({f[i], f[i], d});
        if (beyond)
        {
            LinearityOutlier& outlier = result.outliers.back();
            outlier.highFrequency = f[i];
            if (std::abs(d) > std::abs(outlier.deviation))
                outlier.deviation = d;
        }
        inside = beyond;
    }
    return result;
}

} // namespace pacini
