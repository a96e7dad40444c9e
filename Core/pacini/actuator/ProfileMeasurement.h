#pragma once

// Measurement record of a profile: the measured response of an actuator, and its flatness with the equaliser.

#include <pacini/foundation/Result.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// The measured acceleration at one frequency, averaged over the placements.
struct MeasuredPoint
{
    double frequency = 0.0;           ///< Hz
    double level = 0.0;               ///< dB re 1 m/s^2 peak at a drive of 1, without the equaliser
    std::optional<double> linearised; ///< the same through the equaliser
    bool operator==(const MeasuredPoint&) const = default;
};

/// A part of the range in which the response is not flat.
struct LinearityOutlier
{
    double lowFrequency = 0.0;  ///< Hz
    double highFrequency = 0.0; ///< Hz
    double deviation = 0.0;     ///< dB, the largest there
    bool operator==(const LinearityOutlier&) const = default;
};

/// Flatness of a response: its deviations from its mean over the logarithm of frequency.
struct Linearity
{
    double lowFrequency = 0.0;              ///< Hz, the range that was judged
    double highFrequency = 0.0;             ///< Hz
    double tolerance = 4.0;                 ///< dB
    double level = 0.0;                     ///< dB re 1 m/s^2, the mean
    double meanDeviation = 0.0;             ///< dB, of the absolute deviation
    double standardDeviation = 0.0;         ///< dB
    double worstDeviation = 0.0;            ///< dB, with its sign
    double worstFrequency = 0.0;            ///< Hz
    std::vector<LinearityOutlier> outliers; ///< beyond the tolerance, from low to high

    /// Whether all of the response is within the tolerance.
    [[nodiscard]] bool passed() const noexcept { return outliers.empty(); }
    bool operator==(const Linearity&) const = default;
};

/// A measurement by swept sines.
struct ProfileMeasurement
{
    static constexpr std::size_t maxPoints = 4096;
    static constexpr std::size_t maxOutliers = 256;

    int placements = 1;                    ///< averaged recordings: of other wearers, or attached again
    double drive = 0.0;                    ///< dB of the sweep's peak re full drive
    std::optional<double> distortionDrive; ///< dB re full drive at which harmonic distortion passes 10 %
    std::optional<Linearity> linearity;    ///< with the equaliser, where it was verified
    std::vector<MeasuredPoint> points;     ///< by rising frequency
    bool operator==(const ProfileMeasurement&) const = default;
};

/// Checks every number; NaN is within no range. `where` names the measurement in errors, such as `measurement`.
[[nodiscard]] inline Result<void> validate(const ProfileMeasurement& measurement, const std::string& where)
{
    std::optional<Error> error;
    const auto check = [&](const std::string& at, double value, double low, double high, const char* message)
    {
        if (!error && !(value >= low && value <= high))
            error = Error{ErrorCode::invalidData, where + "." + at, message};
    };
    const auto level = [&](const std::string& at, double value)
    {
        check(at, value, -400.0, 400.0, "must be -400 to 400 dB");
    };
    const auto frequency = [&](const std::string& at, double value)
    {
        check(at, value, 0.1, 200000.0, "must be 0.1 to 200000 Hz");
    };
    const auto fits = [&](const std::string& at, std::size_t count, std::size_t most, const char* message)
    {
        if (!error && count > most)
            error = Error{ErrorCode::tooLarge, where + "." + at, message};
    };
    check("fittings", measurement.placements, 1, 1000000, "must be 1 to 1000000");
    check("drive", measurement.drive, -200.0, 40.0, "must be -200 to 40 dB");
    if (measurement.distortionDrive)
        check("distortionDrive", *measurement.distortionDrive, -200.0, 40.0, "must be -200 to 40 dB");
    if (measurement.linearity)
    {
        const Linearity& linearity = *measurement.linearity;
        frequency("linearity.lowFrequency", linearity.lowFrequency);
        frequency("linearity.highFrequency", linearity.highFrequency);
        check("linearity.tolerance", linearity.tolerance, 0.0, 100.0, "must be 0 to 100 dB");
        level("linearity.level", linearity.level);
        level("linearity.meanDeviation", linearity.meanDeviation);
        level("linearity.standardDeviation", linearity.standardDeviation);
        level("linearity.worstDeviation", linearity.worstDeviation);
        frequency("linearity.worstFrequency", linearity.worstFrequency);
        fits("linearity.outliers", linearity.outliers.size(), ProfileMeasurement::maxOutliers,
             "has more than 256 outliers");
        for (std::size_t i = 0; i < linearity.outliers.size() && !error; ++i)
        {
            const std::string at = "linearity.outliers[" + std::to_string(i) + "]";
            frequency(at + ".lowFrequency", linearity.outliers[i].lowFrequency);
            frequency(at + ".highFrequency", linearity.outliers[i].highFrequency);
            level(at + ".deviation", linearity.outliers[i].deviation);
        }
    }
    fits("points", measurement.points.size(), ProfileMeasurement::maxPoints, "has more than 4096 points");
    for (std::size_t i = 0; i < measurement.points.size() && !error; ++i)
    {
        const MeasuredPoint& point = measurement.points[i];
        const std::string at = "points[" + std::to_string(i) + "]";
        frequency(at + ".frequency", point.frequency);
        if (!error && i > 0 && point.frequency <= measurement.points[i - 1].frequency)
            error = Error{ErrorCode::invalidData, where + "." + at + ".frequency", "must be above the one before"};
        level(at + ".level", point.level);
        if (point.linearised)
            level(at + ".linearised", *point.linearised);
    }
    if (error)
        return *error;
    return {};
}

} // namespace pacini
