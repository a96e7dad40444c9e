#pragma once

// The short waveform that stands for an event.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini
{

enum class PulseShape
{
    square,  ///< +1 in the first half of each period, -1 in the second (Weber 2020: one cycle at the actuator's
             ///< resonance)
    sine,    ///< plain sine periods
    adaptive ///< smooth pulses that are over before the next event comes, whatever the event rate
};

struct PulseParams
{
    PulseShape shape = PulseShape::adaptive;
    double frequency = 67.0; ///< Hz, for square and sine
    double cycles = 1.0;     ///< periods, for square and sine
    bool operator==(const PulseParams&) const = default;
};

/// One pulse, ready to be sampled at a rate.
struct Pulse
{
    PulseShape shape = PulseShape::square;
    double cyclesPerFrame = 0.0;
    std::size_t frames = 0;
};

/// The pulse for an event of `sharpness` (0-1) that stands `gap` seconds from its nearest neighbour, at `fs` Hz, its
/// frequencies scaled by `transposition`. Square and sine have round(fs / frequency * cycles) frames. Adaptive pulses
/// are periods under a Hann window. Alone an event gets two periods of 100 Hz (dull) to 280 Hz (crisp). In a fast train
/// (gaps below 60 ms) it gets the frequency of its sharpness within 200 to 400 Hz, for 60 % of the gap but 6 to 15 ms,
/// and at least three periods: the spectrum of n windowed periods of f Hz ends at f (1 - 2 / n), so three leave an
/// actuator that resonates at 60-80 Hz at rest, where its ringing would fill the gaps. Skin resolves gaps of 8-10 ms.
[[nodiscard]] inline Pulse makePulse(const PulseParams& params, double sharpness, double gap, double fs,
                                     double transposition) noexcept
{
    double frequency = params.frequency;
    double cycles = params.cycles;
    if (params.shape == PulseShape::adaptive)
    {
        const double crispness = std::clamp(sharpness, 0.0, 1.0);
        if (gap < 0.06)
        {
            const double length = std::clamp(0.6 * gap, 0.006, 0.015);
            const double lowest = std::max(200.0, 3.0 / length);
            frequency = std::clamp(150.0 * std::pow(2500.0 / 150.0, crispness), lowest, std::max(lowest, 400.0));
            cycles = frequency * length;
        }
        else
        {
            frequency = 100.0 * std::pow(2.8, crispness);
            cycles = 2.0;
        }
    }
    frequency = std::clamp(frequency * transposition, 1.0, 0.45 * fs);
    return {params.shape, frequency / fs, static_cast<std::size_t>(std::floor(cycles * fs / frequency + 0.5))};
}

/// Adds frames `from`... of a pulse, scaled by `gain`, to `out`; frames after the pulse's end are left alone. [audio]
inline void addPulse(const Pulse& pulse, double gain, std::size_t from, std::span<float> out) noexcept
{
    const std::size_t end = std::min(pulse.frames, from + out.size());
    for (std::size_t n = from; n < end; ++n)
    {
        const double cycle = static_cast<double>(n) * pulse.cyclesPerFrame;
        double value = 0.0;
        switch (pulse.shape)
        {
        case PulseShape::square:
            value = cycle - std::floor(cycle) < 0.5 ? 1.0 : -1.0;
            break;
        case PulseShape::sine:
            value = std::sin(2.0 * std::numbers::pi * cycle);
            break;
        case PulseShape::adaptive:
        {
            const double u = (static_cast<double>(n) + 0.5) / static_cast<double>(pulse.frames);
            const double window = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * u);
            value = window * std::sin(2.0 * std::numbers::pi * (cycle + 0.5 * pulse.cyclesPerFrame));
            break;
        }
        }
        out[n - from] += static_cast<float>(gain * value);
    }
}

} // namespace pacini
