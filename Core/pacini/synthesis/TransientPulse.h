#pragma once

// Transient pulse: the short waveform of an event.

#include <pacini/actuator/TransientShape.h>
#include <pacini/foundation/Portable.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>

namespace pacini
{

/// Parameters of a pulse.
struct PulseParams
{
    TransientShape shape = TransientShape::adaptive;
    double frequency = 67.0; ///< Hz, for square and sine
    double cycles = 1.0;     ///< periods, for square and sine
    double lowest = 1.0;     ///< Hz, for adaptive: frequencies stay within what the actuator shows, pulses keep
    double highest = 20e3;   ///< their number of periods
    bool operator==(const PulseParams&) const = default;
};

/// One pulse, ready to be sampled at a rate.
struct Pulse
{
    TransientShape shape = TransientShape::square;
    double cyclesPerFrame = 0.0;
    std::size_t frames = 0;
};

/// The pulse for an event of `sharpness` (0-1) that stands `gap` seconds from its nearest neighbour, at `fs` Hz, its
/// frequencies scaled by `transposition`. Square and sine have round(fs / frequency * cycles) frames. Adaptive pulses
/// are periods under a Hann window. Alone an event gets two periods of 100 Hz (dull) to 280 Hz (crisp). In a fast train
/// (gaps below 60 ms) it gets the frequency of its sharpness within 200 to 400 Hz, for half of the gap but 6 to 15 ms,
/// and at least three periods: the spectrum of n windowed periods of f Hz ends at f (1 - 2 / n), so three leave an
/// actuator that resonates at 60-80 Hz at rest, where its ringing would fill the gaps. Skin resolves gaps of 8-10 ms.
[[nodiscard]] inline Pulse makePulse(const PulseParams& params, double sharpness, double gap, double fs,
                                     double transposition) noexcept
{
    double frequency = params.frequency;
    double cycles = params.cycles;
    if (params.shape == TransientShape::adaptive)
    {
        const double crispness = std::clamp(sharpness, 0.0, 1.0);
        if (gap < 0.06)
        {
            const double length = std::clamp(0.5 * gap, 0.006, 0.015);
            const double lowest = std::max(200.0, 3.0 / length);
            frequency = std::clamp(150.0 * portable::pow(2500.0 / 150.0, crispness), lowest, std::max(lowest, 400.0));
            cycles = frequency * length;
        }
        else
        {
            frequency = 100.0 * portable::pow(2.8, crispness);
            cycles = 2.0;
        }
        frequency = std::clamp(frequency, params.lowest, params.highest);
    }
    frequency = std::clamp(frequency * transposition, 1.0, 0.45 * fs);
    return {params.shape, frequency / fs, static_cast<std::size_t>(std::floor(cycles * fs / frequency + 0.5))};
}

/// Plays one pulse from its start, however it is cut into blocks. Carrier and window are rotating phasors, four frames
/// side by side: sine and cosine would cost more than all else in a train of events. After n frames their error is
/// about n * 1e-16, and pulses are short. Square and sine may be long: they are computed in closed form.
class PulseVoice
{
public:
    PulseVoice() = default;
    explicit PulseVoice(const Pulse& wanted) noexcept : pulse(wanted)
    {
        if (pulse.shape == TransientShape::adaptive && pulse.frames > 0)
        {
            carrier = Phasors(pulse.cyclesPerFrame);
            window = Phasors(1.0 / static_cast<double>(pulse.frames));
        }
    }

    /// Adds the next frames, scaled by `gain`, to `out`; frames after the pulse's end stay unchanged. [audio]
    void addTo(std::span<float> out, double gain) noexcept
    {
        addTo(out, [gain](std::size_t) { return gain; });
    }

    /// The same; frame n is scaled by gainAt(n). [audio]
    template <typename GainAt>
    requires std::invocable<GainAt, std::size_t>
    void addTo(std::span<float> out, GainAt&& gainAt) noexcept
    {
        const std::size_t count = std::min(pulse.frames - frame, out.size());
        for (std::size_t n = 0; n < count;)
        {
            const std::size_t at = frame % lanes;
            while (groups <= frame / lanes) // more than one after pass()
                makeGroup();
            const std::size_t now = std::min(lanes - at, count - n);
            for (std::size_t i = 0; i < now; ++i)
                out[n + i] += static_cast<float>(gainAt(n + i) * group[at + i]);
            n += now;
            frame += now;
        }
    }

    /// Skips `frames` without output, in constant time. [audio]
    void pass(std::size_t frames) noexcept { frame += std::min(pulse.frames - frame, frames); }

    [[nodiscard]] bool finished() const noexcept { return frame >= pulse.frames; }

private:
    static constexpr std::size_t lanes = 4;

    /// exp(2 pi i f (n + 1/2)) at `lanes` neighbouring n.
    struct Phasors
    {
        Phasors() = default;
        explicit Phasors(double cyclesPerFrame) noexcept
        {
            for (std::size_t i = 0; i < lanes; ++i)
            {
                const auto at = portable::turnBy(cyclesPerFrame * (static_cast<double>(i) + 0.5));
                re[i] = at.real();
                im[i] = at.imag();
            }
            const auto step = portable::turnBy(cyclesPerFrame * static_cast<double>(lanes));
            stepRe = step.real();
            stepIm = step.imag();
        }
        void advance() noexcept
        {
            for (std::size_t i = 0; i < lanes; ++i)
            {
                const double next = re[i] * stepRe - im[i] * stepIm;
                im[i] = re[i] * stepIm + im[i] * stepRe;
                re[i] = next;
            }
        }
        std::array<double, lanes> re{}, im{};
        double stepRe = 0.0, stepIm = 0.0;
    };

    void makeGroup() noexcept
    {
        for (std::size_t i = 0; i < lanes; ++i)
        {
            const double cycle = static_cast<double>(lanes * groups + i) * pulse.cyclesPerFrame;
            if (pulse.shape == TransientShape::adaptive)
                group[i] = (0.5 - 0.5 * window.re[i]) * carrier.im[i];
            else if (pulse.shape == TransientShape::square)
                group[i] = cycle - std::floor(cycle) < 0.5 ? 1.0 : -1.0;
            else
                group[i] = portable::turnBy(cycle).imag();
        }
        carrier.advance();
        window.advance();
        ++groups;
    }

    Pulse pulse;
    std::size_t frame = 0;
    std::size_t groups = 0; // made; the last of them is `group`
    std::array<double, lanes> group{};
    Phasors carrier, window;
};

} // namespace pacini
