#pragma once

// Audio callback of a measurement: plays sweeps or a test tone, and records.

#include "document/measure/MeasureRig.h"

#include <pacini/foundation/Units.h>
#include <pacini/linearize/PlayAndRecord.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <span>

namespace pacini
{

/// Plays sweeps, and between them a test tone with fades. prepare() is not called while process() may run.
class MeasureCallback
{
public:
    /// [message] Hz of the device.
    void prepare(double rate) noexcept
    {
        step = testToneFrequency / rate;
        fade = static_cast<float>(1.0 / (fadeSeconds * rate));
        gain = 0.0f;
    }

    [[nodiscard]] PlayAndRecord& sweeps() noexcept { return recorder; }
    [[nodiscard]] const PlayAndRecord& sweeps() const noexcept { return recorder; }

    /// [message]
    void setTone(std::optional<double> level) noexcept
    {
        tone.store(level ? static_cast<float>(Decibels(*level).gain()) : 0.0f, std::memory_order_relaxed);
    }

    /// [audio] As PlayAndRecord::process(). The tone is silent from the start of a sweep until it
    /// has been stopped, finished or not.
    void process(std::span<const std::span<const float>> inputs, std::span<float> out) noexcept
    {
        recorder.process(inputs, out);
        const bool idle = recorder.state() == PlayAndRecordState::idle;
        const float wanted = idle ? tone.load(std::memory_order_relaxed) : 0.0f;
        if (!idle)
            gain = 0.0f;
        if (gain == 0.0f && wanted == 0.0f)
            return;
        for (float& v : out)
        {
            gain += std::clamp(wanted - gain, -fade, fade);
            v += gain * static_cast<float>(std::sin(2.0 * std::numbers::pi * phase));
            phase += step;
            phase -= std::floor(phase);
        }
    }

private:
    static constexpr double fadeSeconds = 0.05; // of full scale

    PlayAndRecord recorder;
    std::atomic<float> tone{0.0f};
    float gain = 0.0f;
    float fade = 1e-3f;
    double phase = 0.0;
    double step = 0.0;
};

} // namespace pacini
