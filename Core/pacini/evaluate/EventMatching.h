#pragma once

// F-measure of event detection: agreement of detected with annotated events.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// The errors (candidate - reference, s) of a largest one-to-one matching of events that are at most `tolerance`
/// seconds apart; its size is the number of hits. Both lists ascend. For intervals of equal width on a line the greedy
/// choice in order of time is a largest matching, in linear time.
[[nodiscard]] inline std::vector<double> matchEvents(std::span<const double> reference,
                                                     std::span<const double> candidate, double tolerance)
{
    std::vector<double> errors;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < reference.size() && j < candidate.size())
    {
        const double error = candidate[j] - reference[i];
        if (std::abs(error) <= tolerance)
        {
            errors.push_back(error);
            ++i;
            ++j;
        }
        else if (error < 0.0)
            ++j;
        else
            ++i;
    }
    return errors;
}

/// The middle value, or the mean of both middle values; nothing for an empty list.
[[nodiscard]] inline std::optional<double> median(std::vector<double> values)
{
    if (values.empty())
        return std::nullopt;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 != 0)
        return *middle;
    return (*std::max_element(values.begin(), middle) + *middle) / 2.0;
}

/// Counts and F-measure (harmonic mean of precision and recall) of a set of detections.
struct EventScore
{
    double f = 0.0; ///< 2 TP / (2 TP + FP + FN); 1 when nothing was to be found and nothing was
    std::size_t truePositives = 0;
    std::size_t falsePositives = 0;
    std::size_t falseNegatives = 0;
    bool operator==(const EventScore&) const = default;
};

/// Scores detections against annotated onsets (s, any order; `tolerance` s). Detections that are further than 25 ms
/// from every onset but within 25 ms of an entry of `ambiguous` count neither for nor against.
[[nodiscard]] inline EventScore scoreEvents(std::vector<double> onsets, std::vector<double> detections,
                                            double tolerance, std::span<const double> ambiguous = {})
{
    constexpr double reach = 0.025;
    const auto isNear = [](std::span<const double> times, double t)
    {
        return std::any_of(times.begin(), times.end(), [t](double other) { return std::abs(t - other) <= reach; });
    };

    std::sort(onsets.begin(), onsets.end());
    std::sort(detections.begin(), detections.end());
    std::erase_if(detections, [&](double t) { return !isNear(onsets, t) && isNear(ambiguous, t); });

    // A tolerance of whole milliseconds includes differences of just that size, whatever their last bit is.
    const std::size_t hits = matchEvents(onsets, detections, tolerance + 1e-12).size();
    EventScore score{1.0, hits, detections.size() - hits, onsets.size() - hits};
    if (!onsets.empty() || !detections.empty())
        score.f = 2.0 * static_cast<double>(hits) / static_cast<double>(onsets.size() + detections.size());
    return score;
}

} // namespace pacini
