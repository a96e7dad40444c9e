#pragma once

// IIR equalizer design by the modified Yule-Walker equations: a recursive filter of any order, found without iteration.

#include "cli/bench/EqualizerTarget.h"

#include <pacini/foundation/Units.h>
#include <pacini/linearize/EqualizerSearch.h>

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace pacini::cli
{

/// Recursive filter numerator[0] + numerator[1] z^-1 + ... over 1 + denominator[1] z^-1 + ..., both with all roots
/// inside of the unit circle: stable and of minimum phase.
struct YuleWalkerFit
{
    std::vector<double> numerator, denominator;
    double rms = 0.0;   ///< dB, as in EqualizerFit
    double max = 0.0;   ///< dB
    double level = 0.0; ///< dB
    double boost = 0.0; ///< dB, the most that it raises any frequency
};

namespace detail
{

/// The polynomial 1 + a[1] z^-1 + ... of `order` that best predicts a process of the autocorrelation `r`: |a|^2 comes
/// near to a multiple of one over its power (N. Levinson, "The Wiener RMS error criterion in filter design and
/// prediction", 1946; J. Durbin, "The fitting of time-series models", 1960). Its roots lie inside of the unit circle as
/// long as all reflection coefficients are below 1; it stays of the order before the first that is not, where the
/// matrix of r is no longer positive definite in doubles.
[[nodiscard]] inline std::vector<double> levinson(const std::vector<double>& r, std::size_t order)
{
    std::vector<double> a{1.0};
    double error = r[0];
    for (std::size_t m = 1; m <= order; ++m)
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < m; ++i)
            sum += a[i] * r[m - i];
        const double reflection = -sum / error;
        if (!(std::abs(reflection) < 1.0))
            break;
        std::vector<double> next(m + 1, 0.0);
        for (std::size_t i = 0; i <= m; ++i)
            next[i] = (i < m ? a[i] : 0.0) + reflection * (i > 0 ? a[m - i] : 0.0);
        a = std::move(next);
        error *= 1.0 - reflection * reflection;
    }
    a.resize(order + 1, 0.0);
    return a;
}

/// The denominator by the modified Yule-Walker equations: beyond the order of the numerator the autocorrelation of
/// B / A obeys A's recursion. Three equations per unknown on a tapered autocorrelation, by QR. `bias`, as a part of the
/// power, pulls the coefficients to 0: without noise in the target the equations of high orders are singular, and the
/// superfluous roots would lie anywhere, on the unit circle too.
[[nodiscard]] inline std::vector<double> modifiedYuleWalker(const std::vector<double>& correlation, std::size_t order)
{
    using Eigen::Index;
    constexpr double bias = 1e-5;
    const std::size_t equations = 3 * order;
    const auto lags = static_cast<double>(4 * order);
    const auto tapered = [&](std::size_t lag)
    {
        return correlation[lag] / correlation[0] *
               (0.54 + 0.46 * std::cos(std::numbers::pi * static_cast<double>(lag) / lags));
    };
    const auto rows = static_cast<Index>(equations), columns = static_cast<Index>(order);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows + columns, columns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rows + columns);
    for (std::size_t i = 0; i < equations; ++i)
    {
        const std::size_t lag = order + 1 + i;
        right[static_cast<Index>(i)] = -tapered(lag);
        for (std::size_t j = 1; j <= order; ++j)
            matrix(static_cast<Index>(i), static_cast<Index>(j - 1)) = tapered(lag - j);
    }
    matrix.bottomRows(columns).diagonal().setConstant(bias);
    const Eigen::VectorXd found = matrix.householderQr().solve(right);
    std::vector<double> denominator{1.0};
    denominator.insert(denominator.end(), found.begin(), found.end());
    return denominator;
}

} // namespace detail

/// A recursive filter of order 2 to 128, above and below, that flattens a response at params.sampleRate; what params
/// says of sections and goals does not count. The denominator by B. Friedlander and B. Porat, "The modified Yule-Walker
/// method of ARMA spectral estimation", IEEE Trans. AES 20, 1984, from the autocorrelation of the wanted magnitude D.
/// Its equations may give unstable poles; the stable polynomial of the same magnitude is the predictor for the
/// autocorrelation of 1 / |A|^2, which Levinson's recursion gives without finding roots. The numerator is the predictor
/// for 1 / (D |A|)^2, so that it errs by ratios, as dB do (J. Makhoul, "Linear prediction: a tutorial review", 1975);
/// the least squares of amplitudes that the paper takes was two to four times as far off.
///
/// It counts frequencies alike, not octaves: an order resolves about fs / order, wherever. And its polynomials lose
/// digits: near z = 1 that of n poles at f is as small as (2 pi f / fs)^n, 1e-14 for 60 Hz, 48 kHz and n = 7. Without
/// the bias (see modifiedYuleWalker) no order above 8 came out at 48 kHz and none above 16 at 4 kHz; with it the poles
/// keep off the circle, and narrow resonances are not reached. So it is for rates of a few times the highest frequency.
/// The limit of the boost is kept by lowering the whole filter. Errors as fitEqualizer() has them, and `order`.
[[nodiscard]] inline Result<YuleWalkerFit> fitYuleWalker(const FrequencyResponse& response, int order,
                                                         const EqualizerFitParams& params = {})
{
    if (order < 2 || order > 128)
        return Error{ErrorCode::invalidArgument, "order", "must be 2 to 128"};
    const auto problem = makeEqualizerFitProblem(response, params);
    if (!problem)
        return problem.error();
    const auto n = static_cast<std::size_t>(order);
    const std::size_t size = transformSizeFor(*problem, 4 * n);
    std::vector<double> power = amplitudesOf(EqualizerTarget(*problem), size, problem->fs);
    for (double& value : power)
        value *= value;
    const auto invert = [](std::vector<double> values)
    {
        constexpr double smallest = 1e-30; // the square of what doubles leave of a zero
        for (double& value : values)
            value = 1.0 / std::max(value, smallest);
        return values;
    };
    const auto powerOf = [size](const std::vector<double>& polynomial)
    {
        std::vector<double> values;
        values.reserve(size);
        for (const auto& value : spectrumOf(polynomial, size))
            values.push_back(std::norm(value));
        return values;
    };

    YuleWalkerFit fit;
    const auto anyPhase = detail::modifiedYuleWalker(symmetricInverse(power), n);
    fit.denominator = detail::levinson(symmetricInverse(invert(powerOf(anyPhase))), n);
    const std::vector<double> below = powerOf(fit.denominator);
    std::vector<double> product = power;
    for (std::size_t k = 0; k < size; ++k)
        product[k] *= below[k];
    fit.numerator = detail::levinson(symmetricInverse(invert(std::move(product))), n);

    // The predictor has no gain: that of the target, in the mean of dB, or what the limit of the boost leaves.
    const std::vector<double> above = powerOf(fit.numerator);
    double sum = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < size; ++k)
    {
        const double found = above[k] / below[k];
        largest = std::max(largest, found);
        sum += std::log10(power[k] / found);
    }
    const double gain = 10.0 * sum / static_cast<double>(size);
    const double highest = Decibels::fromPower(largest).value;
    fit.boost = std::min(highest + gain, params.maxBoost);
    for (double& b : fit.numerator)
        b *= Decibels(fit.boost - highest).gain();

    setFlatness(fit, *problem,
                [&fit, fs = problem->fs](double f)
                { return polynomialLevel(fit.numerator, f, fs) - polynomialLevel(fit.denominator, f, fs); });
    return fit;
}

} // namespace pacini::cli
