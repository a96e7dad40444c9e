#pragma once

// Autoregressive models as reflection coefficients: from autocorrelations, to power spectra, and as a filter of noise.

#include <pacini/foundation/Random.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// A power spectrum at equal distances of frequency, the first at 0 Hz.
struct PowerSpectrum
{
    double step = 1.0; ///< Hz
    std::vector<double> power;

    [[nodiscard]] double frequency(std::size_t bin) const noexcept { return step * static_cast<double>(bin); }

    /// Between bins on straight lines; beyond the last its value.
    [[nodiscard]] double at(double frequency) const noexcept
    {
        const double place = frequency / step;
        const auto last = static_cast<double>(power.size() - 1);
        if (!(place < last))
            return power.back();
        const auto bin = static_cast<std::size_t>(place > 0.0 ? place : 0.0);
        return power[bin] + (power[bin + 1] - power[bin]) * (place - static_cast<double>(bin));
    }

    /// Between two frequencies, in the unit of power times Hz.
    [[nodiscard]] double sum(double low, double high) const noexcept
    {
        double total = 0.0;
        for (std::size_t bin = 0; bin < power.size(); ++bin)
            if (frequency(bin) >= low && frequency(bin) <= high)
                total += power[bin];
        return step * total;
    }
};

/// The autocorrelation at lags 0 to `order` of noise with a power spectrum, sampled at `rate` Hz; without what lies
/// above half the rate.
[[nodiscard]] inline std::vector<double> autocorrelationOf(const PowerSpectrum& spectrum, std::size_t order,
                                                           double rate)
{
    std::vector<double> lags(order + 1, 0.0);
    for (std::size_t bin = 0; bin < spectrum.power.size() && spectrum.frequency(bin) <= 0.5 * rate; ++bin)
    {
        // cos(m w) from the two before it.
        const double twice = 2.0 * std::cos(2.0 * std::numbers::pi * spectrum.frequency(bin) / rate);
        const bool end = bin == 0 || bin + 1 == spectrum.power.size();
        double before = 0.5 * twice, now = 1.0;
        for (double& lag : lags)
        {
            lag += (end ? 0.5 : 1.0) * spectrum.power[bin] * now;
            const double next = twice * now - before;
            before = now;
            now = next;
        }
    }
    return lags;
}

/// The reflection coefficients of the autoregressive model with the first lags of an autocorrelation, one less than
/// these (N. Levinson 1947, J. Durbin 1960). All are between -1 and 1, whatever the lags are: where rounding or numbers
/// that are no autocorrelation would lead beyond, the model ends there. White noise 60 dB below the whole is added, so
/// that spectra with gaps have a model too.
[[nodiscard]] inline std::vector<double> reflectionsOf(std::span<const double> lags)
{
    assert(!lags.empty());
    constexpr double most = 1.0 - 1e-9;
    const std::size_t order = lags.size() - 1;
    std::vector<double> reflection(order, 0.0), a(order + 1, 0.0), reversed(order + 1, 0.0);
    a[0] = 1.0;
    double rest = lags[0] * (1.0 + 1e-6);
    for (std::size_t m = 1; m <= order; ++m)
    {
        double sum = lags[m];
        for (std::size_t i = 1; i < m; ++i)
            sum += a[i] * lags[m - i];
        const double k = -sum / rest;
        if (!(rest > 0.0 && std::abs(k) < most))
            break;
        for (std::size_t i = 1; i < m; ++i)
            reversed[i] = a[m - i];
        for (std::size_t i = 1; i < m; ++i)
            a[i] += k * reversed[i];
        a[m] = k;
        reflection[m - 1] = k;
        rest *= 1.0 - k * k;
    }
    return reflection;
}

/// The power spectrum of such a model at `rate` Hz, driven by white noise, from 0 to half the rate in `bins` steps; its
/// whole power is 1.
[[nodiscard]] inline PowerSpectrum spectrumOf(std::span<const double> reflection, std::size_t bins, double rate)
{
    PowerSpectrum spectrum{0.5 * rate / static_cast<double>(bins), std::vector<double>(bins + 1)};
    for (std::size_t bin = 0; bin <= bins; ++bin)
    {
        // Of A and of A reversed, section by section.
        const auto z = std::polar(1.0, -std::numbers::pi * static_cast<double>(bin) / static_cast<double>(bins));
        std::complex<double> forward = 1.0, backward = 1.0;
        for (const double k : reflection)
        {
            const auto late = z * backward;
            backward = late + k * forward;
            forward += k * late;
        }
        spectrum.power[bin] = 1.0 / std::max(std::norm(forward), 1e-24);
    }
    const double whole = spectrum.sum(0.0, rate);
    for (double& power : spectrum.power)
        power /= whole;
    return spectrum;
}

/// White noise through an autoregressive model whose coefficients may change with every frame: a normalised lattice
/// (A. Gray and J. Markel, "A normalized digital filter structure", 1975).
///
/// Each of its sections turns a pair of numbers by an angle, which changes no energy. So for any course of coefficients
/// that does not depend on the noise, states and output that once have a variance of 1 keep exactly that: no change of
/// speed, however quick, makes the texture unstable or louder, which a direct form does not promise even between two
/// stable filters. Coefficients can be interpolated on straight lines, and levels are apart from spectra.
class LatticeNoise
{
public:
    explicit LatticeNoise(std::uint64_t firstSeed = 1) : seed(firstSeed), random(firstSeed) { reset(); }

    /// Begins the noise again, in its steady state. [audio]
    void reset() noexcept
    {
        random = Random(seed);
        for (double& state : states)
            state = white();
    }

    /// Takes up to limits::textureOrder coefficients between -1 and 1, both allowed. [audio]
    void setReflections(std::span<const double> reflection) noexcept
    {
        order = std::min(reflection.size(), sine.size());
        for (std::size_t m = 0; m < order; ++m)
        {
            sine[m] = reflection[m];
            cosine[m] = std::sqrt(std::max(1.0 - sine[m] * sine[m], 0.0));
        }
    }

    /// The next frame: mean 0, variance 1, the same on every machine for the same coefficients. [audio]
    double next() noexcept
    {
        double forward = white();
        for (std::size_t m = order; m-- > 0;)
        {
            const double backward = states[m];
            states[m + 1] = sine[m] * forward + cosine[m] * backward;
            forward = cosine[m] * forward - sine[m] * backward;
        }
        return states[0] = forward;
    }

private:
    static constexpr std::size_t mostSections = 64;

    /// The sum of four uniform numbers of 16 bits: within +-3.5, variance 1.
    double white() noexcept
    {
        constexpr double mean = 2.0 * 65535.0;
        constexpr double scale = 2.6428997921303e-5; // 1 / sqrt(4 (65536^2 - 1) / 12)
        const std::uint64_t bits = random.next();
        const std::uint64_t sum = (bits & 0xFFFF) + (bits >> 16 & 0xFFFF) + (bits >> 32 & 0xFFFF) + (bits >> 48);
        return scale * (static_cast<double>(sum) - mean);
    }

    std::uint64_t seed;
    Random random;
    std::size_t order = 0;
    std::array<double, mostSections> sine{}, cosine{};
    std::array<double, mostSections + 1> states{}; ///< backward signals, of the frame before
};

} // namespace pacini
