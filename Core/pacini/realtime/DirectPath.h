#pragma once

// Direct path: the sound's own signal within the range of the actuator, with the levels of its roles.

#include <pacini/filters/DesignLimits.h>
#include <pacini/filters/StateVariable.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>
#include <pacini/realtime/ControlHop.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini
{

/// Band-pass with role levels: a range between two Butterworth slopes of 12 dB per octave, and below and above one
/// border two gains. Crossovers whose parts are added again would delay 100 Hz by up to 10 ms; here the parts are never
/// separated: the border is a fourth-order Butterworth low- or high-shelf whose louder side stands at 1,
///
///     product over both pole pairs of (s^2 + k r s + r^2) / (s^2 + k s + 1), r^4 = gain below / gain above,
///
/// or with s turned into 1 / s where the upper side is the weaker one (form: M. Holters and U. Zoelzer, "Parametric
/// higher-order shelving filters", EUSIPCO 2006, here with the poles on the border). Equal gains are the identity, a
/// muted side is a Butterworth filter of fourth order, and since only the zeros move, no change of gains can excite it.
class DirectPath
{
public:
    /// The range and the border, Hz, at `fs` Hz. Real-time safe; silence follows.
    void design(Hertz low, Hertz border, Hertz high, double fs) noexcept
    {
        lower = StateVariableLoop::design(clampedFrequency(low, fs), std::numbers::sqrt2, fs);
        upper = StateVariableLoop::design(clampedFrequency(high, fs), std::numbers::sqrt2, fs);
        for (std::size_t s = 0; s < dampings.size(); ++s)
            shelves[s] = StateVariableLoop::design(clampedFrequency(border, fs), dampings[s], fs);
        reset();
    }

    void reset() noexcept
    {
        states = {};
        flat = false;
    }

    /// Gains at once.
    void jump(double below, double above) noexcept
    {
        const Weights wanted = weightsFor(below, above);
        for (std::size_t i = 0; i < weights.size(); ++i)
            weights[i].jump(wanted[i]);
    }

    /// Starts a hop: the weights of the gains move by the fraction `share` of the distance to their targets.
    void aim(double below, double above, double share) noexcept
    {
        const Weights wanted = weightsFor(below, above);
        bool equal = true;
        for (std::size_t i = 0; i < weights.size(); ++i)
        {
            weights[i].aim(wanted[i], share);
            equal = equal && (i == 0 || (weights[i].start() == identity[i] && weights[i].end() == identity[i]));
        }
        if (equal && !flat)
            for (std::size_t s = 2; s < 4; ++s)
                states[s] = {};
        flat = equal;
    }

    [[nodiscard]] bool silent() const noexcept { return weights[0].silent(); }

    /// Frames `at` and on of the hop.
    void process(std::span<const double> in, std::span<double> out, std::size_t at) noexcept
    {
        for (std::size_t n = 0; n < in.size(); ++n)
        {
            const std::size_t i = at + n;
            double x = states[0].tick(lower, in[n]).high;
            x = states[1].tick(upper, x).low;
            if (!flat)
                for (std::size_t s = 0; s < dampings.size(); ++s)
                {
                    const StateVariableOutputs parts = states[2 + s].tick(shelves[s], x);
                    const std::size_t w = 1 + 3 * s;
                    x = weights[w].at(i) * parts.low + weights[w + 1].at(i) * parts.band +
                        weights[w + 2].at(i) * parts.high;
                }
            out[n] = weights[0].at(i) * x;
        }
    }

    void flush() noexcept
    {
        for (StateVariableState& state : states)
            state.flush();
    }

private:
    static constexpr std::array<double, 2> dampings{0.7653668647301796, 1.8477590650225735}; // of Butterworth's fourth

    using Weights = std::array<double, 7>; // gain, then low, band and high of both sections

    static constexpr Weights identity{1.0, 1.0, dampings[0], 1.0, 1.0, dampings[1], 1.0};

    [[nodiscard]] static Weights weightsFor(double below, double above) noexcept
    {
        const double louder = std::max(below, above);
        const double r = louder > 0.0 ? std::sqrt(std::sqrt(std::min(below, above) / louder)) : 1.0;
        const double low = below < above ? r * r : 1.0;
        const double high = below < above ? 1.0 : r * r;
        return {louder, low, dampings[0] * r, high, low, dampings[1] * r, high};
    }

    StateVariableLoop lower, upper;
    std::array<StateVariableLoop, 2> shelves;
    std::array<StateVariableState, 4> states{};
    std::array<HopGlide, 7> weights{};
    bool flat = false;
};

} // namespace pacini
