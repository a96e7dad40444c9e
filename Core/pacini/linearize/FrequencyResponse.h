#pragma once

// Frequency response of an actuator as it was measured.

#include <pacini/foundation/Result.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace pacini
{

/// Levels over frequency. Both lists have the same length.
struct FrequencyResponse
{
    std::vector<double> frequency; ///< Hz, each above the one before
    std::vector<double> level;     ///< dB

    static constexpr std::size_t fewestPoints = 8;
    static constexpr std::size_t maxPoints = 100000;

    [[nodiscard]] std::size_t size() const noexcept { return frequency.size(); }
    bool operator==(const FrequencyResponse&) const = default;
};

/// Checks that a response has 8 to 100000 points, frequencies of 0.1 to 200000 Hz in rising order and levels within
/// +-400 dB. The error names the first wrong point, such as `points[3].frequency`, counted from 0.
[[nodiscard]] inline Result<void> validate(const FrequencyResponse& response)
{
    const auto wrong = [](std::size_t i, const char* part, ErrorCode code, const char* message) -> Result<void>
    {
        return Error{code, "points[" + std::to_string(i) + "]." + part, message};
    };
    if (response.frequency.size() != response.level.size())
        return Error{ErrorCode::invalidArgument, "points", "has a different number of levels and frequencies"};
    if (response.size() < FrequencyResponse::fewestPoints)
        return Error{ErrorCode::invalidData, "points", "has fewer than 8 points; measure at more frequencies"};
    if (response.size() > FrequencyResponse::maxPoints)
        return Error{ErrorCode::tooLarge, "points", "has more than 100000 points; thin or smooth the response first"};
    for (std::size_t i = 0; i < response.size(); ++i)
    {
        const double f = response.frequency[i];
        if (!std::isfinite(f))
            return wrong(i, "frequency", ErrorCode::notFinite, "must be a finite number");
        if (f < 0.1 || f > 200000.0)
            return wrong(i, "frequency", ErrorCode::invalidData, "must be 0.1 to 200000 Hz");
        if (i > 0 && f <= response.frequency[i - 1])
            return wrong(i, "frequency", ErrorCode::invalidData,
                         "must be above the one before; sort the lines by frequency, without duplicates");
        if (!std::isfinite(response.level[i]))
            return wrong(i, "level", ErrorCode::notFinite, "must be a finite number");
        if (std::abs(response.level[i]) > 400.0)
            return wrong(i, "level", ErrorCode::invalidData, "must be -400 to 400 dB");
    }
    return {};
}

/// The value at `frequency` Hz of a curve over rising frequencies `f`, by a straight line over the logarithm of
/// frequency; at the ends the nearest point. Both lists have the same length, 1 or more.
[[nodiscard]] inline double valueAt(const std::vector<double>& f, const std::vector<double>& value,
                                    double frequency) noexcept
{
    const auto above = std::lower_bound(f.begin(), f.end(), frequency);
    if (above == f.begin())
        return value.front();
    if (above == f.end())
        return value.back();
    const auto i = static_cast<std::size_t>(above - f.begin());
    const double part = std::log(frequency / f[i - 1]) / std::log(f[i] / f[i - 1]);
    return value[i - 1] + part * (value[i] - value[i - 1]);
}

/// The level at `frequency` Hz, see valueAt().
[[nodiscard]] inline double levelAt(const FrequencyResponse& response, double frequency) noexcept
{
    return valueAt(response.frequency, response.level, frequency);
}

} // namespace pacini
