#pragma once

// Felt acceleration of a profile without a body model, by its measured response.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

namespace pacini
{

/// The path of the source that says whether a measurement was calibrated.
inline constexpr std::string_view measurementSource = "measurement";

/// Whether a profile has a measured response in m/s^2 for certain: its source says how it was measured, and not that
/// its levels are assumed.
[[nodiscard]] inline bool hasMeasuredAcceleration(const Profile& profile) noexcept
{
    if (!profile.measurement || profile.measurement->points.size() < 2)
        return false;
    const ProfileSource* source = sourceOf(profile.sources, measurementSource);
    return source != nullptr && !isAssumed(*source);
}

/// Whether a profile was measured, but not so that it has an acceleration.
[[nodiscard]] inline bool hasRelativeLevels(const Profile& profile) noexcept
{
    return profile.measurement && !profile.measurement->points.empty() && !hasMeasuredAcceleration(profile);
}

/// Level at `f` Hz in dB re 1 m/s^2 at a drive signal of 1, of two points or more: on straight lines over the logarithm
/// of frequency; below the first point 12 dB less per octave, as a mass on a spring does; above the last one as there.
[[nodiscard]] inline double measuredLevelAt(std::span<const MeasuredPoint> points, double f) noexcept
{
    const auto next =
        std::find_if(points.begin(), points.end(), [f](const MeasuredPoint& point) { return point.frequency >= f; });
    if (next == points.end())
        return points.back().level;
    if (next == points.begin())
        return next->level - 40.0 * std::log10(next->frequency / std::max(f, 1e-3));
    const MeasuredPoint& before = *(next - 1);
    const double part = std::log(f / before.frequency) / std::log(next->frequency / before.frequency);
    return before.level + part * (next->level - before.level);
}

/// Drive signal in, measured acceleration in m/s^2 out, late by half a second or more: a filter of minimum phase with
/// the measured level (A. V. Oppenheim, R. W. Schafer, "Discrete-Time Signal Processing", 3rd ed. 2010, section 13.5.4:
/// the folded cepstrum), by overlap-save. A measured profile keeps no phase; a resonator has the minimum. [worker]
class MeasuredFelt
{
public:
    /// `points`: two at least; `sampleRate` in Hz.
    MeasuredFelt(std::span<const MeasuredPoint> points, double sampleRate)
        : block(std::bit_ceil(static_cast<std::size_t>(shortest * sampleRate))),
          fft(2 * block),
          window(2 * block),
          spectrum(2 * block),
          response(2 * block),
          ready(block)
    {
        const std::vector<double> taps = minimumPhase(points, sampleRate);
        for (std::size_t i = 0; i < taps.size(); ++i)
            spectrum[i] = taps[i];
        fft.forward(spectrum, response);
    }

    /// Spans of one length, which may be the same.
    void process(std::span<const float> in, std::span<float> out)
    {
        for (std::size_t i = 0; i < in.size(); ++i)
        {
            window[block + filled] = static_cast<double>(in[i]);
            out[i] = ready[filled];
            if (++filled == block)
                filter();
        }
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return block; }

private:
    static constexpr double shortest = 0.5; // s: Q 20 at 20 Hz has decayed by 14 dB, at 100 Hz by 68

    [[nodiscard]] std::vector<double> minimumPhase(std::span<const MeasuredPoint> points, double sampleRate) const
    {
        const std::size_t size = 8 * block; // that the cepstrum does not wrap
        double loudest = points.front().level;
        for (const MeasuredPoint& point : points)
            loudest = std::max(loudest, point.level);
        constexpr double floor = 160.0; // dB
        ComplexFft<double> wide(size);
        std::vector<std::complex<double>> a(size), b(size);
        for (std::size_t k = 0; k <= size / 2; ++k)
        {
            const double f = static_cast<double>(k) * sampleRate / static_cast<double>(size);
            const double level = std::max(measuredLevelAt(points, f), loudest - floor);
            a[k] = a[(size - k) % size] = std::log(Decibels(level).gain());
        }
        wide.inverse(a, b);
        const double scale = 1.0 / static_cast<double>(size);
        a.assign(size, 0.0);
        a[0] = b[0].real() * scale;
        a[size / 2] = b[size / 2].real() * scale;
        for (std::size_t i = 1; i < size / 2; ++i)
            a[i] = 2.0 * b[i].real() * scale;
        wide.forward(a, b);
        for (std::complex<double>& value : b)
            value = std::exp(value);
        wide.inverse(b, a);
        std::vector<double> taps(block);
        for (std::size_t i = 0; i < block; ++i)
        {
            const double x = static_cast<double>(i) / static_cast<double>(block);
            const double fade = x < 0.5 ? 1.0 : 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * (x - 0.5));
            taps[i] = fade * a[i].real() * scale;
        }
        return taps;
    }

    void filter()
    {
        std::vector<std::complex<double>> result(2 * block);
        fft.forward(window, spectrum);
        for (std::size_t k = 0; k < spectrum.size(); ++k)
            spectrum[k] *= response[k];
        fft.inverse(spectrum, result);
        for (std::size_t i = 0; i < block; ++i)
            ready[i] = static_cast<float>(result[block + i].real() / static_cast<double>(2 * block));
        std::copy(window.begin() + static_cast<std::ptrdiff_t>(block), window.end(), window.begin());
        filled = 0;
    }

    std::size_t block;
    ComplexFft<double> fft;
    std::vector<std::complex<double>> window; ///< the last block, and the one that is being filled
    std::vector<std::complex<double>> spectrum;
    std::vector<std::complex<double>> response;
    std::vector<float> ready;
    std::size_t filled = 0;
};

} // namespace pacini
