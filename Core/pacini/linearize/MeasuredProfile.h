#pragma once

// Profile update from a measurement: its findings, its equalizer and its proof, each with where it comes from.

#include <pacini/actuator/MeasuredFelt.h>
#include <pacini/actuator/Profile.h>
#include <pacini/foundation/NumberText.h>
#include <pacini/linearize/EqualizerFit.h>
#include <pacini/linearize/MeasurementFindings.h>
#include <pacini/linearize/Verification.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <utility>

namespace pacini
{

namespace detail
{
inline void sortSources(Profile& profile)
{
    std::sort(profile.sources.begin(), profile.sources.end(),
              [](const ProfileSource& a, const ProfileSource& b) { return a.path < b.path; });
}
} // namespace detail

/// The response that a profile's measurement holds.
[[nodiscard]] inline FrequencyResponse measuredResponse(const ProfileMeasurement& measurement)
{
    FrequencyResponse response;
    for (const MeasuredPoint& point : measurement.points)
    {
        response.frequency.push_back(point.frequency);
        response.level.push_back(point.level);
    }
    return response;
}

/// Replaces the values of the profile by the measured ones. `response` is the average of all placements, `placements`
/// their number and `drive` the level of the loudest sweep, dB re full drive. The levels are in m/s^2 if the sensor was
/// `calibrated`, else relative, as their source says. Removes equalizer and body, because they
/// belong to another resonance. Frequencies outside the valid range of a profile are moved to its ends.
inline void setMeasurement(Profile& profile, const FrequencyResponse& response, const MeasurementFindings& findings,
                           std::size_t placements, double drive, bool calibrated)
{
    const auto frequency = [](double f)
    {
        return std::clamp(f, 1.0, 20000.0);
    };
    const ResponseFeatures& features = findings.features;
    profile.resonance = {frequency(features.resonance.frequency), std::clamp(features.resonance.q, 0.01, 100.0)};
    if (features.felt.high > features.felt.low)
    {
        profile.range.lowFrequency = frequency(features.felt.low);
        profile.range.highFrequency = frequency(features.felt.high);
    }
    if (findings.times)
        profile.response = {std::min(findings.times->riseTime, 2.0), std::min(findings.times->fallTime, 2.0)};
    profile.equalizer = {};
    profile.body.reset();
    ProfileMeasurement measurement;
    measurement.placements = static_cast<int>(placements - findings.outliers.size());
    measurement.drive = drive;
    measurement.distortionDrive = findings.profileDrive;
    for (std::size_t i = 0; i < response.size(); ++i)
        measurement.points.push_back({response.frequency[i], response.level[i], std::nullopt});
    profile.measurement = std::move(measurement);

    const auto measuredNow = [](const ProfileSource& source)
    {
        const std::string_view path = source.path;
        return path.starts_with("resonance") || path == "range" || path.starts_with("range.lowFrequency") ||
               path.starts_with("range.highFrequency") || path.starts_with("response") ||
               path.starts_with("equalizer") || path.starts_with("body") || path.starts_with(measurementSource);
    };
    std::erase_if(profile.sources, measuredNow);
    const std::string how = "measured with swept sines at " + numberText(drive, std::chars_format::general, 3) +
                            " dB, " + std::to_string(profile.measurement->placements) + " placement" +
                            (profile.measurement->placements == 1 ? "" : "s");
    profile.sources.push_back({std::string(measurementSource),
                               calibrated ? how + ", with a calibrated sensor"
                                          : "assumed levels: the sensor was not calibrated, so they are relative"});
    profile.sources.push_back({"resonance", how + ", as it is worn"});
    profile.sources.push_back({"range.lowFrequency", how + ", 20 dB below the strongest frequency"});
    profile.sources.push_back(
        {"range.highFrequency", how + ", 20 dB below the strongest frequency or the sweep's end"});
    if (findings.times)
        profile.sources.push_back({"response", how});
    detail::sortSources(profile);
}

/// Sets the sections of a fit in the profile, and removes the verification of earlier ones. `fittedTo` names the
/// response that they flatten, such as `the measurement`; `rate` is the sample rate of the fit, Hz.
inline void setEqualizer(Profile& profile, const EqualizerFit& fit, const std::string& fittedTo, double rate)
{
    profile.equalizer = fit.sections;
    if (profile.measurement)
    {
        profile.measurement->linearity.reset();
        for (MeasuredPoint& point : profile.measurement->points)
            point.linearised.reset();
    }
    std::erase_if(profile.sources, [](const ProfileSource& source) { return source.path.starts_with("equalizer"); });
    profile.sources.push_back({"equalizer", "fitted to " + fittedTo + " at " + decimalText(rate, 0) +
                                                " Hz: " + decimalText(fit.rms, 2) + " dB RMS, " +
                                                decimalText(fit.max, 2) + " dB at most from its mean"});
    detail::sortSources(profile);
}

/// Sets the verification in the profile: the flatness, and the response through the equalizer at each measured point.
inline void setVerification(Profile& profile, const FrequencyResponse& after, const Linearity& linearity)
{
    if (!profile.measurement)
        profile.measurement.emplace();
    profile.measurement->linearity = linearity;
    for (MeasuredPoint& point : profile.measurement->points)
        point.linearised = point.frequency >= after.frequency.front() && point.frequency <= after.frequency.back()
                               ? std::optional(levelAt(after, point.frequency))
                               : std::nullopt;
}

} // namespace pacini
