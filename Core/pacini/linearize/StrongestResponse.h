#pragma once

// Principal axis of a measurement: one impulse response out of those of several axes, and its arrival.

#include <pacini/foundation/Fft.h>
#include <pacini/foundation/SplitRealFft.h>
#include <pacini/linearize/LagWindow.h>
#include <pacini/linearize/SweepMeasurement.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace pacini
{

/// The channels' impulse responses along the direction of most energy: the eigenvector of their 3 x 3 covariance, with
/// the sign of its largest component.
[[nodiscard]] inline ImpulseResponse strongestDirection(std::span<const ResponseCut> channels, double rate)
{
    const auto n = static_cast<Eigen::Index>(channels.size());
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index a = 0; a < n; ++a)
        for (Eigen::Index b = 0; b < n; ++b)
        {
            const auto& x = channels[static_cast<std::size_t>(a)].samples;
            const auto& y = channels[static_cast<std::size_t>(b)].samples;
            double sum = 0.0;
            for (std::size_t i = 0; i < x.size(); ++i)
                sum += x[i] * y[i];
            covariance(a, b) = sum;
        }
    Eigen::VectorXd direction = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(covariance).eigenvectors().col(n - 1);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction(largest) < 0.0)
        direction = -direction;
    ImpulseResponse out{rate, static_cast<std::size_t>(-channels.front().firstLag), {}};
    out.samples.assign(channels.front().samples.size(), 0.0);
    for (Eigen::Index c = 0; c < n; ++c)
        for (std::size_t i = 0; i < out.samples.size(); ++i)
            out.samples[i] += direction(c) * channels[static_cast<std::size_t>(c)].samples[i];
    return out;
}

/// The lag, s, of the largest envelope (magnitude of the analytic signal), between samples by a parabola.
[[nodiscard]] inline double strongestLag(const ImpulseResponse& response)
{
    const std::size_t size = nextFastFftSize(2 * response.samples.size());
    SplitFft<double> fft(size);
    SplitArray<double> time(size);
    SplitArray<double> bins(size);
    std::copy(response.samples.begin(), response.samples.end(), time.re.begin());
    fft.forward(time.re.data(), time.im.data(), bins.re.data(), bins.im.data());
    for (std::size_t k = size / 2 + 1; k < size; ++k)
        bins.re[k] = bins.im[k] = 0.0;
    fft.inverse(bins.re.data(), bins.im.data(), time.re.data(), time.im.data());
    const auto envelope = [&](std::size_t i)
    {
        return std::hypot(time.re[i], time.im[i]);
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < response.samples.size(); ++i)
        if (envelope(i) > envelope(best))
            best = i;
    double fraction = 0.0;
    if (best > 0 && best + 1 < response.samples.size())
    {
        const double bend = envelope(best - 1) - 2.0 * envelope(best) + envelope(best + 1);
        if (bend < 0.0)
            fraction = 0.5 * (envelope(best - 1) - envelope(best + 1)) / bend;
    }
    return (static_cast<double>(best) + fraction - static_cast<double>(response.origin)) / response.sampleRate;
}

} // namespace pacini
