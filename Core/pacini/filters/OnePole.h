#pragma once

// First-order low- and high-pass whose frequency may move per sample.

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

enum class OnePoleType
{
    lowpass,
    highpass,
};

/// The frequency (-3 dB) is clamped to 1e-7 to 0.4999 of the sample rate.
struct OnePoleParams
{
    OnePoleType type = OnePoleType::lowpass;
    Hertz frequency{1000.0};
    bool operator==(const OnePoleParams&) const = default;
};

struct OnePoleCoefficients
{
    OnePoleType type = OnePoleType::lowpass;
    double g = 0.0; ///< tan(pi f / fs)
    bool operator==(const OnePoleCoefficients&) const = default;

    /// The complex gain at f for the sample rate fs (Hz).
    [[nodiscard]] std::complex<double> response(Hertz f, double fs) const noexcept
    {
        const std::complex<double> s{0.0, std::tan(std::numbers::pi * f.value / fs)};
        return (type == OnePoleType::lowpass ? g : s) / (s + g);
    }
};

/// Trapezoidal integrator in a loop without delay: V. Zavalishin, "The Art of VA Filter Design", rev. 2.1.2 (2018).
/// Its state is the integrator's, so that a moving frequency neither clicks nor makes it unstable.
[[nodiscard]] inline OnePoleCoefficients designOnePole(const OnePoleParams& params, double fs) noexcept
{
    return {params.type, std::tan(std::numbers::pi * clampedFrequency(params.frequency, fs) / fs)};
}

class OnePole
{
public:
    using Params = OnePoleParams;

    void prepare(const ProcessSpec& spec) noexcept
    {
        fs = spec.sampleRate;
        setParams(current);
        reset();
    }
    void setParams(const Params& params) noexcept
    {
        current = params;
        filter = designOnePole(params, fs);
        step = filter.g / (1.0 + filter.g);
    }
    void reset() noexcept { state = 0.0; }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        const double high = filter.type == OnePoleType::highpass ? 1.0 : 0.0;
        const double sign = 1.0 - 2.0 * high;
        const auto tick = [this, high, sign](double x)
        {
            const double v = (x - state) * step;
            const double low = v + state;
            state = low + v;
            return high * x + sign * low;
        };
        forEachSample(in, out, tick, [this] { flushTiny(state); });
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return 0; }
    [[nodiscard]] const OnePoleCoefficients& coefficients() const noexcept { return filter; }

private:
    double fs = ProcessSpec{}.sampleRate;
    Params current;
    OnePoleCoefficients filter;
    double step = 0.0;
    double state = 0.0;
};

static_assert(DspBlock<OnePole>);

} // namespace pacini
