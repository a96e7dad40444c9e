#pragma once

// FIR equalizer design, of linear or minimum phase.

#include "cli/bench/EqualizerTarget.h"

#include <pacini/linearize/EqualizerSearch.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace pacini::cli
{

/// Phase of a FIR equalizer.
enum class FirPhase
{
    linear, ///< delays everything by half its length
    minimum ///< delays as little as its magnitude allows
};

/// Result of a FIR design.
struct FirFit
{
    std::vector<double> taps;
    double latency = 0.0; ///< s, that every frequency is delayed; 0 with minimum phase, which delays each by its own
    double rms = 0.0;     ///< dB, as in EqualizerFit
    double max = 0.0;     ///< dB
    double level = 0.0;   ///< dB
    double boost = 0.0;   ///< dB, the most that it raises any frequency
};

namespace detail
{

/// Least squares over all frequencies: sum W(w) (A(w) - D(w))^2 for the amplitude A(w) = a0 + 2 sum a[m] cos(m w) of a
/// symmetric filter of 2 `half` + 1 taps. The weight W = 1 / (D^2 f) makes the error one in dB over octaves, as that of
/// the other equalizers is; outside of the range it is 1 % of that at the edge. The normal equations are a Toeplitz
/// plus a Hankel matrix, both made of the cosine transform of W.
[[nodiscard]] inline std::vector<double> symmetricTaps(const EqualizerFitProblem& problem,
                                                       const std::vector<double>& amplitude, std::size_t half)
{
    using Eigen::Index;
    constexpr double outside = 0.01;
    constexpr double ridge = 1e-9; // of the diagonal: rounding where the filter is longer than the target has detail
    const std::size_t size = amplitude.size();
    const double first = problem.frequency[0];
    const double last = problem.frequency[problem.points() - 1];
    std::vector<double> weight(size), product(size);
    for (std::size_t k = 0; k < size; ++k)
    {
        const double f = problem.fs * static_cast<double>(std::min(k, size - k)) / static_cast<double>(size);
        const double share = f < first || f > last ? outside : 1.0;
        weight[k] = share / (amplitude[k] * amplitude[k] * std::max(f, first));
        product[k] = weight[k] * amplitude[k];
    }
    const std::vector<double> matrix = symmetricInverse(weight);
    const std::vector<double> wanted = symmetricInverse(product);
    const auto count = static_cast<Index>(half + 1);
    const auto scale = [](Index m)
    {
        return m == 0 ? 1.0 : 2.0;
    };
    Eigen::MatrixXd normal(count, count);
    Eigen::VectorXd taps(count);
    for (Index c = 0; c < count; ++c)
    {
        for (Index r = c; r < count; ++r)
            normal(r, c) = 0.5 * scale(r) * scale(c) *
                           (matrix[static_cast<std::size_t>(r - c)] + matrix[static_cast<std::size_t>(r + c)]);
        normal(c, c) += ridge * normal(c, c);
        taps[c] = scale(c) * wanted[static_cast<std::size_t>(c)];
    }
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>, Eigen::Lower> factors(normal);
    factors.solveInPlace(taps);
    std::vector<double> symmetric(2 * half + 1);
    for (std::size_t m = 0; m <= half; ++m)
        symmetric[half - m] = symmetric[half + m] = taps[static_cast<Index>(m)];
    return symmetric;
}

} // namespace detail

/// A filter of 15 to 4097 taps that flattens a response at params.sampleRate; what params says of sections and goals
/// does not count. An even number of taps becomes the odd one below it: an even linear-phase filter is silent at half
/// the rate. Linear phase: weighted least squares. Minimum phase: the target's minimum-phase response, cut off, which
/// is least squares too (the Fourier series), but over all frequencies alike. A filter resolves about fs / taps,
/// whatever the frequency: at 48 kHz a resonance at 60 Hz needs thousands of taps where two sections do, which is why
/// equalizers at audio rates are recursive. The limit of the boost is kept by lowering the whole filter, which costs
/// level only. Errors as fitEqualizer() has them, and `taps`.
[[nodiscard]] inline Result<FirFit> fitFir(const FrequencyResponse& response, int taps,
                                           const EqualizerFitParams& params = {}, FirPhase phase = FirPhase::linear)
{
    if (taps < 15 || taps > 4097)
        return Error{ErrorCode::invalidArgument, "taps", "must be 15 to 4097"};
    const auto problem = makeEqualizerFitProblem(response, params);
    if (!problem)
        return problem.error();
    const auto half = static_cast<std::size_t>((taps - 1) / 2);
    const std::size_t size = transformSizeFor(*problem, 2 * half + 1);
    const std::vector<double> amplitude = amplitudesOf(EqualizerTarget(*problem), size, problem->fs);
    FirFit fit;
    if (phase == FirPhase::linear)
    {
        fit.taps = detail::symmetricTaps(*problem, amplitude, half);
        fit.latency = static_cast<double>(half) / problem->fs;
    }
    else
    {
        fit.taps = minimumPhaseResponse(amplitude);
        fit.taps.resize(2 * half + 1);
    }

    double largest = 0.0;
    for (const auto& value : spectrumOf(fit.taps, size))
        largest = std::max(largest, std::abs(value));
    fit.boost = Decibels::fromGain(largest).value;
    if (fit.boost > params.maxBoost)
    {
        const double lower = Decibels(params.maxBoost - fit.boost).gain();
        for (double& tap : fit.taps)
            tap *= lower;
        fit.boost = params.maxBoost;
    }
    setFlatness(fit, *problem, [&fit, fs = problem->fs](double f) { return polynomialLevel(fit.taps, f, fs); });
    return fit;
}

} // namespace pacini::cli
