#pragma once

// Second-order filter for parameters that may move with every sample.

#include <pacini/filters/DesignLimits.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini
{

enum class StateVariableType
{
    lowpass,
    bandpass, ///< 0 dB at its peak
    highpass,
    peak, ///< the same response as BiquadType::peak
};

/// Frequencies are clamped to 1e-7 to 0.4999 of the sample rate, q to 1e-6 to 1e5, gains to +-120 dB.
struct StateVariableParams
{
    StateVariableType type = StateVariableType::lowpass;
    Hertz frequency{1000.0};
    double q = std::numbers::sqrt2 / 2.0;
    Decibels gain{0.0}; ///< peak only
    bool operator==(const StateVariableParams&) const = default;
};

/// The two integrators in their loop: g = tan(pi f / fs), k = 1/q, and what the loop without delay solves to.
struct StateVariableLoop
{
    double g = 0.0;
    double k = 1.0;
    double a1 = 1.0;
    double a2 = 0.0;
    double a3 = 0.0;
    bool operator==(const StateVariableLoop&) const = default;

    [[nodiscard]] static StateVariableLoop design(double frequency, double k, double fs) noexcept
    {
        const double g = std::tan(std::numbers::pi * frequency / fs);
        const double a1 = 1.0 / (1.0 + g * (g + k));
        return {g, k, a1, g * a1, g * g * a1};
    }
};

/// The low-pass and the (1/k-scaled) band-pass output at one sample; the high-pass is x - k band - low.
struct StateVariableOutputs
{
    double low;
    double band;
};

/// The memory of the two integrators.
struct StateVariableState
{
    double s1 = 0.0;
    double s2 = 0.0;

    StateVariableOutputs tick(const StateVariableLoop& loop, double x) noexcept
    {
        const double v3 = x - s2;
        const double band = loop.a1 * s1 + loop.a2 * v3;
        const double low = s2 + loop.a2 * s1 + loop.a3 * v3;
        s1 = 2.0 * band - s1;
        s2 = 2.0 * low - s2;
        return {low, band};
    }

    void flush() noexcept
    {
        flushTiny(s1);
        flushTiny(s2);
    }
};

/// The output is m0 x + m1 band + m2 low.
struct StateVariableCoefficients
{
    StateVariableLoop loop;
    double m0 = 0.0;
    double m1 = 0.0;
    double m2 = 1.0;
    bool operator==(const StateVariableCoefficients&) const = default;

    /// The complex gain at f for the sample rate fs (Hz).
    [[nodiscard]] std::complex<double> response(Hertz f, double fs) const noexcept
    {
        const std::complex<double> s{0.0, std::tan(std::numbers::pi * f.value / fs) / loop.g};
        return m0 + (m1 * s + m2) / (s * s + loop.k * s + 1.0);
    }
};

/// State-variable filter by trapezoidal integration: A. Simper, "Solving the continuous SVF equations using trapezoidal
/// integration and equivalent currents", 2013 (same filter: V. Zavalishin, "The Art of VA Filter Design", 2012).
/// Its response is that of the cookbook's biquad, but the states are the integrators themselves: the norm of the state
/// cannot grow without input however the parameters move (A. Wishnick, "Time-varying filters for musical applications",
/// DAFx-14), and nothing cancels at frequencies far below the sample rate.
[[nodiscard]] inline StateVariableCoefficients designStateVariable(const StateVariableParams& params,
                                                                   double fs) noexcept
{
    const double k = 1.0 / clampedQ(params.q);
    const double frequency = clampedFrequency(params.frequency, fs);
    switch (params.type)
    {
    case StateVariableType::lowpass:
        return {StateVariableLoop::design(frequency, k, fs), 0.0, 0.0, 1.0};
    case StateVariableType::bandpass:
        return {StateVariableLoop::design(frequency, k, fs), 0.0, k, 0.0};
    case StateVariableType::highpass:
        return {StateVariableLoop::design(frequency, k, fs), 1.0, -k, -1.0};
    case StateVariableType::peak:
    {
        const double gain = clampedGain(params.gain).gain(); // A^2 in the cookbook's terms
        const double damping = k / std::sqrt(gain);
        return {StateVariableLoop::design(frequency, damping, fs), 1.0, damping * (gain - 1.0), 0.0};
    }
    }
    return {};
}

/// One streaming filter; setParams() costs one tangent and may come before every sample.
class StateVariable
{
public:
    using Params = StateVariableParams;

    void prepare(const ProcessSpec& spec) noexcept
    {
        fs = spec.sampleRate;
        setParams(current);
        reset();
    }
    void setParams(const Params& params) noexcept
    {
        current = params;
        filter = designStateVariable(params, fs);
    }
    void reset() noexcept { state = {}; }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        const auto tick = [this](double x)
        {
            const auto v = state.tick(filter.loop, x);
            return filter.m0 * x + filter.m1 * v.band + filter.m2 * v.low;
        };
        forEachSample(in, out, tick, [this] { state.flush(); });
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return 0; }
    [[nodiscard]] const StateVariableCoefficients& coefficients() const noexcept { return filter; }

private:
    double fs = ProcessSpec{}.sampleRate;
    Params current;
    StateVariableCoefficients filter;
    StateVariableState state;
};

static_assert(DspBlock<StateVariable>);

} // namespace pacini
