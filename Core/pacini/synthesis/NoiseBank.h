#pragma once

// Noise synthesis: the residual noise of a clip as an analytic signal, at the decoder's inner rate.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Random.h>
#include <pacini/synthesis/PlayClock.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// One band of noise.
struct NoiseCarrier
{
    Curve amplitude;         ///< time in frames of the clip, linear RMS
    double centre = 0.1;     ///< cycles per frame
    double halfWidth = 0.01; ///< cycles per frame, where the level has fallen by 3 dB
};

/// Noise generator bank. Sums bands of Gaussian-like noise: complex white noise through two equal one-pole low-passes,
/// turned up to the band's centre. Chosen over filtering real noise because it needs no design of band-passes that stay
/// stable as they get narrow, and its level follows in closed form: white noise of variance s^2 leaves the cascade of
/// two poles p with s^2 (1 + p^2) / (1 - p^2)^3. The same seed gives the same noise, however it is cut into calls.
class NoiseBank
{
public:
    NoiseBank() = default;
    NoiseBank(std::vector<NoiseCarrier> bandsToPlay, std::uint64_t firstSeed)
        : bands(std::move(bandsToPlay)), seed(firstSeed)
    {
        reset();
    }
    NoiseBank(NoiseBank&&) = default; // readers point into the curves: moving keeps them, copying would not
    NoiseBank& operator=(NoiseBank&&) = default;

    void reset() noexcept
    {
        states.clear();
        states.reserve(bands.size()); // no allocation after the first call
        for (std::size_t i = 0; i < bands.size(); ++i)
        {
            const NoiseCarrier& band = bands[i];
            // Each of two poles has fallen by 1.5 dB where both have fallen by 3.
            const double reach = band.halfWidth / std::sqrt(std::numbers::sqrt2 - 1.0);
            const double pole = portable::exp(-2.0 * std::numbers::pi * std::max(reach, 1e-6));
            const double gain = std::sqrt(portable::pow(1.0 - pole * pole, 3.0) / (1.0 + pole * pole));
            states.push_back({Random(seed + i), CurveReader(band.amplitude), pole, gain, 0.0, 0.0, 0.0});
        }
        frame = 0;
        clock = {};
    }

    /// From the next frame on, clip and centres go by `piece`; widths stay. [audio]
    void follow(const ClockPiece& piece) noexcept { clock = piece; }

    /// Adds the next re.size() frames of every band to re and im. [audio]
    void process(std::span<double> re, std::span<double> im) noexcept
    {
        for (std::size_t i = 0; i < bands.size(); ++i)
        {
            State& s = states[i];
            const double centre = std::min(bands[i].centre * clock.pitch, 0.45);
            for (std::size_t n = 0; n < re.size(); ++n)
            {
                s.first = s.pole * s.first + white(s.random);
                s.second = s.pole * s.second + s.first;
                const double level =
                    s.gain * s.amplitude.at(clock.clipAt(static_cast<double>(frame) + static_cast<double>(n)));
                const std::complex<double> z = level * s.second * portable::turnBy(s.phase);
                re[n] += z.real();
                im[n] += z.imag();
                s.phase += centre;
                s.phase -= std::floor(s.phase);
            }
        }
        frame += static_cast<std::int64_t>(re.size());
    }

    /// Skips `frames` without output. The random numbers do not advance: the following noise is other noise of the same
    /// kind. [audio]
    void skip(std::int64_t frames) noexcept
    {
        for (std::size_t i = 0; i < bands.size(); ++i)
        {
            double& phase = states[i].phase;
            phase += std::min(bands[i].centre * clock.pitch, 0.45) * static_cast<double>(frames);
            phase -= std::floor(phase);
        }
        frame += frames;
    }

    [[nodiscard]] bool empty() const noexcept { return bands.empty(); }

private:
    struct State
    {
        Random random;
        CurveReader amplitude;
        double pole;
        double gain;
        std::complex<double> first;
        std::complex<double> second;
        double phase;
    };

    /// Both parts of variance 1: sums of two uniform numbers.
    static std::complex<double> white(Random& random) noexcept
    {
        constexpr double unit = 1.2247448713915890; // sqrt(3 / 2)
        const double re = random.uniform(-unit, unit) + random.uniform(-unit, unit);
        return {re, random.uniform(-unit, unit) + random.uniform(-unit, unit)};
    }

    std::vector<NoiseCarrier> bands;
    std::uint64_t seed = 0;
    std::vector<State> states;
    std::int64_t frame = 0;
    ClockPiece clock;
};

} // namespace pacini
