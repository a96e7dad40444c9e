#pragma once

// Summary of a measurement: results from all recordings of an actuator together.

#include <pacini/linearize/ResponseFeatures.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace pacini
{

/// Summary of a measurement.
struct MeasurementFindings
{
    ResponseFeatures features;
    std::optional<ActuatorResponse> times; ///< medians over the placements
    double distortion = 0.0;               ///< %, the largest at the loudest sweep within the felt range
    std::vector<HarmonicPeak> harmonics;   ///< the strongest of each order among the placements, as for `distortion`
    double groupDelay = 0.0;               ///< s at the resonance, the median over the placements
    std::optional<double> distortionDrive; ///< dB re full scale, at which it passes the limit asked for; the median
    std::optional<double> profileDrive;    ///< the same for the limit of a profile, see ProfileMeasurement
    std::set<std::size_t> outliers;        ///< indices of placements that were left out
};

/// `average` is that of the responses of `placements`, in their order; `smoothing` in octaves as they were analysed;
/// `distortionLimit` in %. Errors: those of responseFeatures().
[[nodiscard]] inline Result<MeasurementFindings> findingsOf(std::span<const SweepMeasurement* const> placements,
                                                            const PlacementAverage& average, double smoothing,
                                                            double distortionLimit)
{
    constexpr double profileLimit = 10.0; // %
    ResponseFeatureParams params;
    params.smoothing = smoothing;
    auto features = responseFeatures(average.response, params);
    if (!features)
        return features.error();
    MeasurementFindings findings;
    findings.features = *features;
    for (const PlacementOutlier& outlier : average.outliers)
        findings.outliers.insert(outlier.index);
    std::vector<double> rises, falls, delays, drives, profileDrives;
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        if (findings.outliers.contains(i))
            continue;
        const SweepMeasurement& measured = *placements[i];
        if (const auto times = burstTimes(measured.impulseResponse, features->resonance.frequency))
        {
            rises.push_back(times->riseTime);
            falls.push_back(times->fallTime);
        }
        const FrequencyRange& felt = features->felt;
        findings.distortion =
            std::max(findings.distortion, largestDistortion(measured.levels[measured.main], felt.low, felt.high));
        for (const HarmonicPeak& peak : harmonicPeaks(measured.levels[measured.main], felt.low, felt.high))
        {
            const auto known = std::find_if(findings.harmonics.begin(), findings.harmonics.end(),
                                            [&](const HarmonicPeak& other) { return other.order == peak.order; });
            if (known == findings.harmonics.end())
                findings.harmonics.push_back(peak);
            else if (peak.level > known->level)
                *known = peak;
        }
        if (!measured.groupDelay.empty())
            delays.push_back(
                valueAt(measured.response().frequency, measured.groupDelay, features->resonance.frequency));
        if (const auto drive = driveAtDistortion(measured, distortionLimit, felt.low, felt.high))
            drives.push_back(*drive);
        if (const auto drive = driveAtDistortion(measured, profileLimit, felt.low, felt.high))
            profileDrives.push_back(*drive);
    }
    const auto middle = [](std::vector<double>& values)
    {
        const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), at, values.end());
        return *at;
    };
    if (!delays.empty())
        findings.groupDelay = middle(delays);
    if (!rises.empty())
        findings.times = ActuatorResponse{middle(rises), middle(falls)};
    if (!drives.empty())
        findings.distortionDrive = middle(drives);
    if (!profileDrives.empty())
        findings.profileDrive = middle(profileDrives);
    return findings;
}

} // namespace pacini
