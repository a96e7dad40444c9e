#pragma once

// Causal filter bank: splits a signal into N bands, whose sum has the spectrum of the signal with another phase.

#include <pacini/filters/BandLayout.h>
#include <pacini/filters/DesignLimits.h>
#include <pacini/filters/StateVariable.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/FixedVector.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini
{

/// Coefficients of the filter bank: the loops of the crossovers, from low to high; empty for a single band.
struct FilterBankCoefficients
{
    FixedVector<StateVariableLoop, maxBands - 1> crossovers;
    bool operator==(const FilterBankCoefficients&) const = default;

    [[nodiscard]] std::size_t bands() const noexcept { return crossovers.size() + 1; }

    /// The complex gain of band k at f for the sample rate fs (Hz).
    [[nodiscard]] std::complex<double> response(std::size_t k, Hertz f, double fs) const noexcept
    {
        std::complex<double> gain = 1.0;
        for (std::size_t j = 0; j < crossovers.size(); ++j)
        {
            const auto& loop = crossovers[j];
            const auto s = loop.warped(f, fs);
            const std::complex<double> denominator = s * s + loop.k * s + 1.0;
            if (j < k)
                gain *= s * s * s * s / (denominator * denominator);
            else if (j == k)
                gain /= denominator * denominator;
            else
                gain *= (s * s - loop.k * s + 1.0) / denominator;
        }
        return gain;
    }
};

/// Linkwitz-Riley crossovers of fourth order (S. H. Linkwitz, "Active crossover networks for noncoincident drivers",
/// JAES 24 (1976)), each splitting what the one before left above it; the bands below pass the all-pass of every later
/// crossover, so that all bands sum to an all-pass (J. A. D'Appolito, "Active realization of multiway all-pass
/// crossover systems", JAES 35 (1987)). These are the second-order sections and -6 dB crossings of the thesis (Weber
/// 2020, section 4.3.1); its parallel band-passes are flat within +0.07/-0.03 dB for the six bands that it shows, this
/// tree is flat for any number. Crossovers are clamped to the range of the filters (see DesignLimits.h).
[[nodiscard]] inline FilterBankCoefficients designFilterBank(const BandLayoutParams& params, double fs) noexcept
{
    FilterBankCoefficients bank;
    for (const Hertz crossover : designBandLayout(params).crossovers)
        bank.crossovers.pushBack(StateVariableLoop::design(clampedFrequency(crossover, fs), std::numbers::sqrt2, fs));
    return bank;
}

/// Streaming bank. The outputs are in phase with each other at the crossovers; they have no common delay.
class FilterBank : public DesignedBlock<FilterBank, BandLayoutParams>
{
public:
    /// Keeps the state of the crossovers that remain; further bands start from silence.
    void setParams(const Params& params) noexcept
    {
        current = params;
        bank = designFilterBank(params, fs);
        for (std::size_t j = bank.crossovers.size(); j < splits.size(); ++j)
        {
            splits[j] = {};
            allpasses[j] = {};
        }
    }
    void reset() noexcept
    {
        splits = {};
        allpasses = {};
    }

    /// outs.size() == bands(), each as long as `in`; `in` may be one of them.
    void process(std::span<const float> in, std::span<const std::span<float>> outs) noexcept
    {
        const std::size_t crossovers = bank.crossovers.size();
        assert(outs.size() == crossovers + 1);
        std::array<double, maxBands> band{};
        for (std::size_t i = 0; i < in.size(); ++i)
        {
            double rest = finiteOrZero(in[i]);
            for (std::size_t j = 0; j < crossovers; ++j)
            {
                const StateVariableLoop& loop = bank.crossovers[j];
                rest = splits[j].tick(loop, rest, band[j]);
                allpasses[j].tick(loop, std::span(band).first(j));
            }
            band[crossovers] = rest;
            for (std::size_t k = 0; k <= crossovers; ++k)
                outs[k][i] = toSample(band[k]);
            if ((i + 1) % flushInterval == 0)
                flush();
        }
        flush();
    }

    [[nodiscard]] std::size_t bands() const noexcept { return bank.bands(); }
    [[nodiscard]] const FilterBankCoefficients& coefficients() const noexcept { return bank; }

private:
    /// One crossover: the first stage gives low and high at once, as both have the same poles.
    struct Split
    {
        StateVariableState first;
        StateVariableState lowStage;
        StateVariableState highStage;

        /// Returns the high part, writes the low part.
        double tick(const StateVariableLoop& loop, double x, double& low) noexcept
        {
            const auto v = first.tick(loop, x);
            low = lowStage.tick(loop, v.low).low;
            return highStage.tick(loop, v.high).high;
        }

        void flush() noexcept
        {
            first.flush();
            lowStage.flush();
            highStage.flush();
        }
    };

    /// The all-pass of one crossover for every band below it, laid out so that bands are computed side by side.
    struct Allpass
    {
        std::array<double, maxBands> s1{};
        std::array<double, maxBands> s2{};

        void tick(const StateVariableLoop& loop, std::span<double> band) noexcept
        {
            for (std::size_t k = 0; k < band.size(); ++k)
            {
                const double u = (band[k] - s2[k]) - loop.damping * s1[k];
                const double d1 = loop.a2 * u;
                const double d2 = loop.g * s1[k] + loop.a3 * u;
                const double v1 = s1[k] + d1;
                s1[k] = v1 + d1;
                s2[k] += 2.0 * d2;
                band[k] -= 2.0 * loop.k * v1;
            }
        }

        void flush(std::size_t count) noexcept
        {
            std::for_each_n(s1.begin(), count, flushTiny);
            std::for_each_n(s2.begin(), count, flushTiny);
        }
    };

    void flush() noexcept
    {
        for (std::size_t j = 0; j < bank.crossovers.size(); ++j)
        {
            splits[j].flush();
            allpasses[j].flush(j);
        }
    }

    FilterBankCoefficients bank = designFilterBank(Params{}, ProcessSpec{}.sampleRate);
    std::array<Split, maxBands - 1> splits{};
    std::array<Allpass, maxBands - 1> allpasses{};
};

static_assert(DspBank<FilterBank>);

} // namespace pacini
