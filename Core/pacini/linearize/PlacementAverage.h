#pragma once

// Robust average of responses over wearers and placements of a device: one response out of many.

#include <pacini/foundation/Result.h>
#include <pacini/linearize/FrequencyResponse.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// Parameters of the robust average.
struct PlacementAverageParams
{
    double lowFrequency = 30.0;    ///< Hz, from where levels and shapes are compared
    double highFrequency = 1000.0; ///< Hz, to where
    double offsetLimit = 2.5;      ///< largest difference of a level from the others, dB, 0 to 60
    double shapeLimit = 3.0;       ///< largest difference of half of a response after the levels agree, dB, 0 to 60
    bool operator==(const PlacementAverageParams&) const = default;
};

/// A placement that is unlike the others, and was left out.
struct PlacementOutlier
{
    std::size_t index = 0; ///< into the responses averaged
    double offset = 0.0;   ///< dB above the level of the others
    double shape = 0.0;    ///< dB, the median distance from the average once the levels agree
};

/// Result of the robust average.
struct PlacementAverage
{
    FrequencyResponse response;
    std::vector<double> spread;  ///< dB, standard deviation at each frequency of the placements that were averaged
    std::vector<double> offsets; ///< dB of every placement above the average
    std::vector<PlacementOutlier> outliers;
};

namespace detail
{
/// The median; of an even number of values the mean of the two in the middle. Not for none.
[[nodiscard]] inline double medianOf(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return values.size() % 2 == 1 ? *middle : 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// The standard deviation of a normal distribution with the values' median absolute deviation from `centre`.
[[nodiscard]] inline double robustDeviation(const std::vector<double>& values, double centre)
{
    std::vector<double> distance(values.size());
    std::transform(values.begin(), values.end(), distance.begin(), [&](double v) { return std::abs(v - centre); });
    return 1.4826 * medianOf(std::move(distance));
}

/// Huber's mean: values further from it than three deviations, and than 6 dB, count as if they were there (P. Huber,
/// "Robust estimation of a location parameter", 1964). The mean when nothing stands out, which the median of few values
/// of an uneven distribution is not: a skin's resonance is in some wearers' responses only.
[[nodiscard]] inline double huberMean(const std::vector<double>& values)
{
    double centre = medianOf(values);
    const double reach = 3.0 * std::max(robustDeviation(values, centre), 2.0);
    for (int i = 0; i < 20; ++i)
    {
        double sum = 0.0;
        double weights = 0.0;
        for (const double v : values)
        {
            const double weight = std::min(1.0, reach / std::max(std::abs(v - centre), 1e-300));
            sum += weight * v;
            weights += weight;
        }
        centre = sum / weights;
    }
    return centre;
}
/// The range of most values.
struct Concentration
{
    double centre = 0.0;
    double deviation = 0.0; // that of a normal distribution with as short a half
};

/// The shortest interval with more than half of the values (P. Rousseeuw, "Least median of squares regression", 1984,
/// for one dimension). When all outliers lie on one side, as loose placements do, the median moves towards them and the
/// median deviation grows; this interval stays among the others.
[[nodiscard]] inline Concentration shortestHalf(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t count = values.size() / 2 + 1;
    std::size_t best = 0;
    for (std::size_t i = 1; i + count <= values.size(); ++i)
        if (values[i + count - 1] - values[i] < values[best + count - 1] - values[best])
            best = i;
    const double low = values[best];
    const double high = values[best + count - 1];
    return {0.5 * (low + high), 1.4826 * 0.5 * (high - low)};
}

/// How far each response lies from the median of all, dB: its level, and its shape at that level.
struct PlacementDifferences
{
    std::vector<double> offsets;
    std::vector<double> shapes;
};

[[nodiscard]] inline PlacementDifferences differencesOf(std::span<const FrequencyResponse> placements,
                                                        const std::vector<std::size_t>& compared)
{
    const std::size_t n = placements.size();
    PlacementDifferences found{std::vector<double>(n), std::vector<double>(n)};
    auto& [offsets, shapes] = found;
    std::vector<double> column(n);
    std::vector<double> distance(compared.size());
    // Twice: the first medians still mix levels.
    for (int pass = 0; pass < 2; ++pass)
    {
        std::vector<double> middle;
        for (const std::size_t k : compared)
        {
            for (std::size_t i = 0; i < n; ++i)
                column[i] = placements[i].level[k] - offsets[i];
            middle.push_back(medianOf(column));
        }
        for (std::size_t i = 0; i < n; ++i)
        {
            for (std::size_t k = 0; k < compared.size(); ++k)
                distance[k] = placements[i].level[compared[k]] - middle[k];
            offsets[i] = medianOf(distance);
            for (double& d : distance)
                d = std::abs(d - offsets[i]);
            shapes[i] = medianOf(distance);
        }
    }
    return found;
}
} // namespace detail

/// The robust average of 1 to 1000 responses at the same frequencies, in dB. Levels are aligned by the median distance
/// from the median of all, so that a device that sits loosely is not taken for another shape; placements whose level
/// lies beyond offsetLimit and 2.5 robust deviations, or whose shape lies beyond shapeLimit, are left out and named; of
/// the others Huber's mean is taken at each frequency, at their mean level. Up to just under half may be outliers.
/// Errors: invalidArgument at `placements` for no response, those of validate() with `placements[i].` before their
/// path, invalidData at `placements[i]` for other frequencies than the first one's, invalidArgument for a parameter.
[[nodiscard]] inline Result<PlacementAverage> averagePlacements(std::span<const FrequencyResponse> placements,
                                                                const PlacementAverageParams& params = {})
{
    if (placements.empty() || placements.size() > 1000)
        return Error{ErrorCode::invalidArgument, "placements", "must be 1 to 1000 responses"};
    if (!(params.offsetLimit >= 0.0 && params.offsetLimit <= 60.0))
        return Error{ErrorCode::invalidArgument, "offsetLimit", "must be 0 to 60 dB"};
    if (!(params.shapeLimit >= 0.0 && params.shapeLimit <= 60.0))
        return Error{ErrorCode::invalidArgument, "shapeLimit", "must be 0 to 60 dB"};
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        const std::string path = "placements[" + std::to_string(i) + "]";
        if (auto valid = validate(placements[i]); !valid)
            return Error{valid.error().code, path + "." + valid.error().where, valid.error().message};
        if (placements[i].frequency != placements[0].frequency)
            return Error{ErrorCode::invalidData, path, "has other frequencies than the first one"};
    }
    const auto& frequency = placements[0].frequency;
    std::vector<std::size_t> compared;
    for (std::size_t k = 0; k < frequency.size(); ++k)
        if (frequency[k] >= params.lowFrequency && frequency[k] <= params.highFrequency)
            compared.push_back(k);
    if (compared.empty())
        return Error{ErrorCode::invalidArgument, "lowFrequency", "leaves no frequency to compare the responses at"};

    const std::size_t n = placements.size();
    const auto [offsets, shapes] = detail::differencesOf(placements, compared);
    const auto usual = detail::shortestHalf(offsets);
    const double limit = std::max(params.offsetLimit, 2.5 * usual.deviation);
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < n; ++i)
        if (std::abs(offsets[i] - usual.centre) <= limit && shapes[i] <= params.shapeLimit)
            members.push_back(i);
    if (members.empty()) // shapes that all differ leave nothing to tell outliers by
        for (std::size_t i = 0; i < n; ++i)
            members.push_back(i);

    PlacementAverage out;
    out.response.frequency = frequency;
    double level = 0.0;
    for (const std::size_t i : members)
        level += offsets[i] / static_cast<double>(members.size());
    std::vector<double> aligned(members.size());
    for (std::size_t k = 0; k < frequency.size(); ++k)
    {
        for (std::size_t m = 0; m < members.size(); ++m)
            aligned[m] = placements[members[m]].level[k] - offsets[members[m]];
        const double mean = detail::huberMean(aligned);
        out.response.level.push_back(mean + level);
        double squares = 0.0;
        for (std::size_t m = 0; m < members.size(); ++m)
            squares += std::pow(aligned[m] - mean + offsets[members[m]] - level, 2);
        out.spread.push_back(members.size() > 1 ? std::sqrt(squares / static_cast<double>(members.size() - 1)) : 0.0);
    }
    for (std::size_t i = 0; i < n; ++i)
    {
        out.offsets.push_back(offsets[i] - level);
        if (!std::binary_search(members.begin(), members.end(), i))
            out.outliers.push_back({i, out.offsets.back(), shapes[i]});
    }
    return out;
}

} // namespace pacini
