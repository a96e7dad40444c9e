#pragma once

// Settings of a measurement: level, range and length of the sweep, calibration of the sensor.

#include <pacini/foundation/Units.h>
#include <pacini/linearize/MeasurementParams.h>
#include <pacini/linearize/Sweep.h>

#include <algorithm>

namespace pacini
{

struct MeasureSettings
{
    double level = -10.0;          ///< dB re full scale of the sweep's peak
    double lowFrequency = 10.0;    ///< Hz
    double highFrequency = 1500.0; ///< Hz
    double duration = 20.0;        ///< s of one sweep
    int repeats = 1;
    bool calibrated = false;
    double fullScale = 5.0 * standardGravity; ///< m/s^2 of a full-scale sample, when calibrated
    bool operator==(const MeasureSettings&) const = default;
};

/// The sweep that the settings ask for at `sampleRate` Hz; see validate(SweepParams).
[[nodiscard]] inline SweepParams sweepOf(const MeasureSettings& settings, double sampleRate)
{
    SweepParams params;
    params.lowFrequency = settings.lowFrequency;
    params.highFrequency = settings.highFrequency;
    params.duration = settings.duration;
    params.fadeIn = std::min(params.fadeIn, 0.25 * settings.duration);
    params.repeats = settings.repeats;
    params.levels = {settings.level};
    params.sampleRate = sampleRate;
    return params;
}

/// The settings to prove an equaliser by that is meant for `lowest` Hz and more, see provingLowFrequency().
[[nodiscard]] inline MeasureSettings provingSettings(MeasureSettings settings, double lowest)
{
    settings.lowFrequency = provingLowFrequency(settings.lowFrequency, settings.highFrequency, lowest);
    return settings;
}

/// How its recording is analysed. Levels of an uncalibrated sensor are relative.
[[nodiscard]] inline MeasurementParams analysisOf(const MeasureSettings& settings)
{
    MeasurementParams params;
    params.fullScale = {settings.calibrated ? settings.fullScale : 1.0};
    return params;
}

} // namespace pacini
