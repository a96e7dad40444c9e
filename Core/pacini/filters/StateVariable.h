#pragma once

// Second-order sections in state-variable form, for all streaming filters: exact at any rate, stable under modulation.

#include <pacini/filters/Biquad.h>
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

/// Two integrators in a loop whose transfer functions are 1, s and s^2 over s^2 + k s + 1, s = (z - 1) / (z + 1) / g:
/// g = tan(pi f / fs), k = 1/q, and what the loop without delay solves to.
struct StateVariableLoop
{
    double g = 0.0;
    double k = 1.0;
    double damping = 1.0; ///< g + k
    double a1 = 1.0;      ///< 1 / (1 + g (g + k))
    double a2 = 0.0;      ///< g a1
    double a3 = 0.0;      ///< g^2 a1
    bool operator==(const StateVariableLoop&) const = default;

    [[nodiscard]] static StateVariableLoop make(double g, double k) noexcept
    {
        const double a1 = 1.0 / (1.0 + g * (g + k));
        return {g, k, g + k, a1, g * a1, g * (g * a1)};
    }
    [[nodiscard]] static StateVariableLoop design(double frequency, double k, double fs) noexcept
    {
        return make(std::tan(std::numbers::pi * frequency / fs), k);
    }

    /// s at f for the sample rate fs (Hz).
    [[nodiscard]] std::complex<double> warped(Hertz f, double fs) const noexcept
    {
        return {0.0, std::tan(std::numbers::pi * f.value / fs) / g};
    }
};

/// The three outputs at one sample. The band-pass is s / (...), so k times it has 0 dB at its peak.
struct StateVariableOutputs
{
    double low;
    double band;
    double high;
};

/// A second-order section: high s^2 + band s + low over s^2 + k s + 1, for any low, band and high.
struct StateVariableCoefficients
{
    StateVariableLoop loop;
    double high = 0.0;
    double band = 0.0;
    double low = 0.0;

    // What tick() multiplies with.
    double drive = 1.0;    ///< the loop's share of the input
    double step1 = 0.0;    ///< 2 a2
    double step2 = 0.0;    ///< 2 a3
    double coupling = 0.0; ///< 2 g
    double through = 0.0;  ///< the output's shares of the input and of both integrators
    double from1 = 0.0;
    double from2 = 0.0;
    bool operator==(const StateVariableCoefficients&) const = default;

    /// With high = low the section is high plus a band-pass of peak gain band / k - high. Its weight k stands half
    /// before and half behind the loop, so that noise fills the integrators to the same level at every k: behind the
    /// loop alone, a jump from Q 20 to Q 0.1 makes what still rings 200 times as loud.
    [[nodiscard]] static StateVariableCoefficients make(const StateVariableLoop& loop, double high, double band,
                                                        double low) noexcept
    {
        StateVariableCoefficients c{loop, high, band, low, 1.0, 2.0 * loop.a2, 2.0 * loop.a3, 2.0 * loop.g};
        if (high == low)
        {
            c.drive = std::sqrt(loop.k);
            const double weight = (band - high * loop.k) / c.drive;
            c.through = high + weight * loop.a2 * c.drive;
            c.from1 = weight * loop.a1;
            c.from2 = -weight * loop.a2;
            return c;
        }
        c.through = high * loop.a1 + band * loop.a2 + low * loop.a3;
        c.from1 = loop.a1 * (band + low * loop.g - high * loop.damping);
        c.from2 = loop.a1 * ((low - high) + loop.g * (low * loop.k - band));
        return c;
    }

    /// The complex gain at f for the sample rate fs (Hz).
    [[nodiscard]] std::complex<double> response(Hertz f, double fs) const noexcept
    {
        const auto s = loop.warped(f, fs);
        return ((high * s + band) * s + low) / ((s + loop.k) * s + 1.0);
    }

    /// The same section as polynomials, rounded to what they can hold.
    [[nodiscard]] BiquadCoefficients directForm() const noexcept
    {
        const double g = loop.g;
        const double square = g * g;
        const auto over = [this](double numerator)
        {
            return numerator * loop.a1;
        };
        return {over(high + band * g + low * square), over(2.0 * (low * square - high)),
                over(high - band * g + low * square), over(2.0 * (square - 1.0)), over(1.0 - loop.k * g + square)};
    }
};

/// The memory of the two integrators. They are moved by increments: u is what the loop leaves of x, and its factors
/// a2, a3 and g are as exact as their own size allows, where the usual (2 a1 - 1) s1 rounds the decay of a narrow
/// filter far below the sample rate away (40 dB worse at 20 Hz, Q 20 and 768 kHz).
struct StateVariableState
{
    double s1 = 0.0;
    double s2 = 0.0;

    /// All outputs.
    StateVariableOutputs tick(const StateVariableLoop& loop, double x) noexcept
    {
        const double u = (x - s2) - loop.damping * s1;
        const double d1 = loop.a2 * u;
        const double d2 = loop.g * s1 + loop.a3 * u;
        const StateVariableOutputs out{s2 + d2, s1 + d1, loop.a1 * u};
        s1 = out.band + d1;
        s2 = out.low + d2;
        return out;
    }

    /// The section's output; between one sample and the next lie four operations.
    double tick(const StateVariableCoefficients& c, double x) noexcept
    {
        const double before1 = s1;
        const double before2 = s2;
        const double u = (c.drive * x - before2) - c.loop.damping * before1;
        s1 = before1 + c.step1 * u;
        s2 = (before2 + c.coupling * before1) + c.step2 * u;
        return c.through * x + (c.from1 * before1 + c.from2 * before2);
    }

    void flush() noexcept
    {
        flushTiny(s1);
        flushTiny(s2);
    }
};

/// The section of `params` as a state-variable filter by trapezoidal integration: A. Simper, "Solving the continuous
/// SVF equations using trapezoidal integration and equivalent currents", 2013 (same filter: V. Zavalishin, "The Art of
/// VA Filter Design", 2012), with the prototypes of the cookbook. Its response is that of designBiquad(), but the
/// states are the integrators themselves: the norm of the state cannot grow without input however the parameters move
/// (A. Wishnick, "Time-varying filters for musical applications", DAFx-14), and nothing cancels far below the sample
/// rate.
[[nodiscard]] inline StateVariableCoefficients designStateVariable(const BiquadParams& params, double fs) noexcept
{
    const double k = 1.0 / clampedQ(params.q);
    const double g = std::tan(std::numbers::pi * clampedFrequency(params.frequency, fs) / fs);
    const double gain = clampedGain(params.gain).gain(); // A^2 in the cookbook's terms
    const double a = std::sqrt(gain);
    const auto section = [](double g0, double k0, double high, double band, double low)
    {
        return StateVariableCoefficients::make(StateVariableLoop::make(g0, k0), high, band, low);
    };
    switch (params.type)
    {
    case BiquadType::lowpass:
        return section(g, k, 0.0, 0.0, 1.0);
    case BiquadType::highpass:
        return section(g, k, 1.0, 0.0, 0.0);
    case BiquadType::bandpass:
        return section(g, k, 0.0, k, 0.0);
    case BiquadType::notch:
        return section(g, k, 1.0, 0.0, 1.0);
    case BiquadType::allpass:
        return section(g, k, 1.0, -k, 1.0);
    case BiquadType::peak:
        return section(g, k / a, 1.0, k * a, 1.0);
    case BiquadType::lowShelf: // the shelves' poles and zeros lie at sqrt(A) to both sides
        return section(g / std::sqrt(a), k, 1.0, k * a, gain);
    case BiquadType::highShelf:
        return section(g * std::sqrt(a), k, gain, k * a, 1.0);
    }
    return {};
}

/// A section given as polynomials whose poles are stable, in state-variable form: the bilinear transform undone, which
/// gives the analogue prototype. As exact as the polynomials are.
[[nodiscard]] inline StateVariableCoefficients asStateVariable(const BiquadCoefficients& c) noexcept
{
    const double atOne = 1.0 + c.a1 + c.a2;     // at z = 1, above 0 when stable
    const double atNyquist = 1.0 - c.a1 + c.a2; // at z = -1, likewise
    const double g = std::sqrt(atOne / atNyquist);
    const double k = 2.0 * (1.0 - c.a2) / (atNyquist * g);
    return StateVariableCoefficients::make(StateVariableLoop::make(g, k), (c.b0 - c.b1 + c.b2) / atNyquist,
                                           2.0 * (c.b0 - c.b2) / (atNyquist * g), (c.b0 + c.b1 + c.b2) / atOne);
}

/// One streaming section; setParams() costs one tangent and may come before every sample. The state is kept.
class StateVariable : public DesignedBlock<StateVariable, BiquadParams>
{
public:
    void setParams(const Params& params) noexcept
    {
        current = params;
        filter = designStateVariable(params, fs);
    }
    void reset() noexcept { state = {}; }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        forEachSample(
            in, out, [this](double x) { return state.tick(filter, x); }, [this] { state.flush(); });
    }

    [[nodiscard]] const StateVariableCoefficients& coefficients() const noexcept { return filter; }

private:
    StateVariableCoefficients filter;
    StateVariableState state;
};

static_assert(DspBlock<StateVariable>);

} // namespace pacini
