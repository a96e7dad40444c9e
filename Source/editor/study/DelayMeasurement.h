// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Measurement of the delay between sound and touch on the devices of a study.

#include "document/measure/MeasureRig.h"
#include "study/LatencyFile.h"

#include <pacini/actuator/Profile.h>

#include <filesystem>
#include <optional>

namespace pacini::editor
{

/// Plays the probe on the sound output and the haptic output and records the response. The rig is open during the
/// lifetime of this object. [message]
class DelayMeasurement
{
public:
    /// `wanted` outlives this. Results are kept in the folder of the study.
    DelayMeasurement(MeasureRig& wanted, std::filesystem::path study);
    ~DelayMeasurement();
    DelayMeasurement(const DelayMeasurement&) = delete;
    DelayMeasurement& operator=(const DelayMeasurement&) = delete;

    [[nodiscard]] RigPorts ports() { return rig.ports(); }

    /// Outputs and inputs of the rig; within the limits of the profile. Errors: invalidArgument where two are the same
    /// or there is no device.
    [[nodiscard]] Result<void> start(std::size_t soundOut, std::size_t touchOut, std::size_t soundIn,
                                     std::size_t touchIn, const std::optional<Profile>& profile);
    [[nodiscard]] bool isRunning() const noexcept { return running; }
    [[nodiscard]] double progress() const { return rig.progress(); } ///< 0 to 1

    /// To be called often: the result, once, when it is there and has been kept. Errors: those of LatencyMeter and
    /// keepLatency(), io where the device went away.
    [[nodiscard]] std::optional<Result<study::Latency>> poll();

private:
    MeasureRig& rig;
    std::filesystem::path folder;
    study::LatencyProbe probe;
    bool running = false;
};

} // namespace pacini::editor
