#pragma once

// Parameters and result of an equalizer fit.

#include <pacini/actuator/Equalizer.h>
#include <pacini/linearize/FrequencyResponse.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// Parameters of an equalizer fit.
struct EqualizerFitParams
{
    double sampleRate =
        48000.0; ///< Hz at which the sections will run, 1000 to 1e7; points from 0.49 of it on count not
    std::optional<int> sections; ///< 1 to 16, at most so many; none: as few as do
    int maxSections = 8;         ///< 1 to 16, when their number is free
    double maxBoost = 12.0;      ///< dB, 0 to 40, that the whole equalizer raises any frequency at most
    double lowFrequency = 0.0;   ///< Hz, the range to be flattened; 0: from the first point
    double highFrequency = 0.0;  ///< Hz; 0: to the last point
    std::vector<double> weights; ///< empty, or one per point, 0 or more
    bool boostOutside = false;   ///< false: outside of the range nothing is raised more than at its edge
    bool shelves = true;         ///< false: peaks only
    std::optional<EqualizerSection>
        highpass;         ///< a section that the equalizer has in any case, beside those counted above
    double goalRms = 0.5; ///< dB, that a free number of sections must reach
    double goalMax = 2.0; ///< dB, likewise
    bool operator==(const EqualizerFitParams&) const = default;
};

/// The high-pass, of order 5, that keeps an actuator from what is below `frequency` Hz, where it would travel furthest.
[[nodiscard]] inline EqualizerSection protectingHighpass(double frequency)
{
    EqualizerSection section;
    section.type = EqualizerType::highpass;
    section.frequency = frequency;
    section.order = 5;
    return section;
}

/// Result of an equalizer fit.
struct EqualizerFit
{
    EqualizerSections sections; ///< the high-pass first, if there is one
    double rms = 0.0;           ///< dB, weighted deviation of response plus equalizer from its mean, over the range
    double max = 0.0;           ///< dB, largest deviation from the mean at a point of weight above 0
    double level = 0.0;         ///< dB, that mean
    double boost = 0.0;         ///< dB, the most that the equalizer raises any frequency
    std::size_t points = 0;     ///< of the response that were in the range and below 0.49 of the sample rate
    std::size_t dropouts = 0;   ///< points that stand apart from both neighbours and therefore count less
    int iterations = 0;
    bool reachedGoal = false; ///< goalRms and goalMax, drop-outs aside
};

/// Checks the ranges above and that at least 8 points with a weight above 0 are in the range.
[[nodiscard]] inline Result<void> validate(const FrequencyResponse& response, const EqualizerFitParams& params)
{
    const auto wrong = [](const char* where, const char* message) -> Result<void>
    {
        return Error{ErrorCode::invalidArgument, where, message};
    };
    const auto within = [](double value, double low, double high)
    {
        return value >= low && value <= high; // NaN never is
    };
    if (auto valid = validate(response); !valid)
        return valid;
    if (!within(params.sampleRate, 1000.0, 1e7))
        return wrong("sampleRate", "must be 1000 to 10000000 Hz");
    if (params.sections && (*params.sections < 1 || *params.sections > 16))
        return wrong("sections", "must be 1 to 16, or left open");
    if (params.maxSections < 1 || params.maxSections > 16)
        return wrong("maxSections", "must be 1 to 16");
    if (!within(params.maxBoost, 0.0, 40.0))
        return wrong("maxBoost", "must be 0 to 40 dB");
    if (!within(params.goalRms, 0.0, 100.0))
        return wrong("goalRms", "must be 0 to 100 dB");
    if (!within(params.goalMax, 0.0, 100.0))
        return wrong("goalMax", "must be 0 to 100 dB");
    if (params.lowFrequency != 0.0 && !within(params.lowFrequency, 0.1, 200000.0))
        return wrong("lowFrequency", "must be 0.1 to 200000 Hz, or 0 for the first point");
    if (params.highFrequency != 0.0 && !within(params.highFrequency, 0.1, 200000.0))
        return wrong("highFrequency", "must be 0.1 to 200000 Hz, or 0 for the last point");
    if (params.highFrequency != 0.0 && params.highFrequency <= params.lowFrequency)
        return wrong("highFrequency", "must be above lowFrequency");
    if (params.highpass)
    {
        if (params.highpass->type != EqualizerType::highpass)
            return wrong("highpass.type", "must be highpass");
        if (auto valid = validate(EqualizerSections{*params.highpass}, "highpass"); !valid)
            return valid;
        if (params.sections.value_or(params.maxSections) > 15)
            return wrong(params.sections ? "sections" : "maxSections", "must be 1 to 15 beside a high-pass");
    }
    if (!params.weights.empty() && params.weights.size() != response.size())
        return wrong("weights", "must be as many as the response has points");
    for (std::size_t i = 0; i < params.weights.size(); ++i)
        if (!within(params.weights[i], 0.0, 1e9))
            return Error{ErrorCode::invalidArgument, "weights[" + std::to_string(i) + "]", "must be 0 to 1e9"};
    return {};
}

} // namespace pacini
