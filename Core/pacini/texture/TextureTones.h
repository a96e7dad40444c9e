#pragma once

// Tones of a recording that follow a speed: orders of an engine, harmonics of a wheel or of ridges.

#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Windows.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// One tone in one frame of a recording.
struct ToneFrame
{
    std::complex<double> amplitude; ///< of the cosine over the way
    bool there = false;             ///< its frequency is between 15 and 1000 Hz
};

/// Tones that were found, and what is left without them.
struct FoundTones
{
    std::vector<double> frequencies;            ///< Hz at speed 1
    std::vector<std::vector<ToneFrame>> frames; ///< [frame][tone]; frame i begins at sample i * step
    std::size_t window = 0, step = 0;           ///< samples
    std::vector<float> rest;                    ///< the recording without them
};

namespace detail
{

/// The way: the integral of the speed up to each sample, s at full speed.
[[nodiscard]] inline std::vector<double> wayOf(std::span<const double> speed, double rate)
{
    std::vector<double> way(speed.size());
    double sum = 0.0;
    for (std::size_t n = 0; n < speed.size(); ++n)
    {
        way[n] = sum;
        sum += speed[n] / rate;
    }
    return way;
}

/// The recording over equal pieces of way, by cubics (Catmull and Rom); none at rest.
[[nodiscard]] inline std::vector<double> overWay(std::span<const float> samples, std::span<const double> way,
                                                 double step)
{
    std::vector<double> result;
    const auto at = [&](std::size_t n)
    {
        return static_cast<double>(samples[std::min(n, samples.size() - 1)]);
    };
    for (std::size_t n = 0; n + 1 < samples.size(); ++n)
        for (;;)
        {
            const double wanted = step * static_cast<double>(result.size());
            if (!(wanted < way[n + 1]))
                break;
            const double t = (wanted - way[n]) / (way[n + 1] - way[n]);
            const double a = at(n > 0 ? n - 1 : 0), b = at(n), c = at(n + 1), d = at(n + 2);
            result.push_back(b +
                             0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a))));
        }
    return result;
}

/// Lines in the mean spectrum over the way, strongest first: frequency (Hz at speed 1) and power.
struct WayLine
{
    double frequency = 0.0, power = 0.0;
};

/// Lines that stand 9 dB out of the median around them, in the mean of at least four spectra; each is related to its
/// own power, so that loud speeds do not count more. A line of noise comes about once in 10^7 bins. `resolution` gets
/// the distance of two bins.
[[nodiscard]] inline std::vector<WayLine> linesOverWay(std::span<const double> samples, double step, double& resolution)
{
    constexpr double longest = 1.0; // s of full speed: lines 3 Hz apart are told apart, see mergeSplitLines()
    constexpr std::size_t fewest = 4, around = 16, own = 3;
    constexpr double outstanding = 8.0;
    const double whole = step * static_cast<double>(samples.size());
    const std::size_t window =
        2 * nextFastFftSize(static_cast<std::size_t>(std::min(longest, whole / 3.0) / step / 2.0));
    std::vector<WayLine> lines;
    if (window < 64 || samples.size() < window)
        return lines;
    RealFft<double> fft(window);
    const auto weights = hannPeriodic(window);
    std::vector<double> frame(window), mean(fft.bins(), 0.0);
    std::vector<std::complex<double>> transform(fft.bins());
    std::size_t count = 0;
    for (std::size_t start = 0; start + window <= samples.size(); start += window / 2)
    {
        for (std::size_t i = 0; i < window; ++i)
            frame[i] = weights[i] * samples[start + i];
        fft.forward(frame, transform);
        double power = 0.0;
        for (const auto& bin : transform)
            power += std::norm(bin);
        if (!(power > 0.0))
            continue;
        for (std::size_t k = 0; k < mean.size(); ++k)
            mean[k] += std::norm(transform[k]) / power;
        ++count;
    }
    resolution = 1.0 / (step * static_cast<double>(window));
    if (count < fewest)
        return lines;
    std::vector<double> neighbours;
    for (std::size_t k = around + 1; k + around + 1 < mean.size(); ++k)
    {
        if (!(mean[k] > mean[k - 1] && mean[k] >= mean[k + 1] && mean[k] > 0.0))
            continue;
        neighbours.clear();
        for (std::size_t i = own; i <= around; ++i)
        {
            neighbours.push_back(mean[k - i]);
            neighbours.push_back(mean[k + i]);
        }
        const auto middle = neighbours.begin() + static_cast<std::ptrdiff_t>(neighbours.size() / 2);
        std::nth_element(neighbours.begin(), middle, neighbours.end());
        if (mean[k] < outstanding * *middle)
            continue;
        constexpr double tiny = std::numeric_limits<double>::min();
        const double a = std::log(mean[k - 1] + tiny), b = std::log(mean[k]), c = std::log(mean[k + 1] + tiny);
        const double curved = a - 2.0 * b + c;
        const double place = static_cast<double>(k) + (curved < 0.0 ? 0.5 * (a - c) / curved : 0.0);
        lines.push_back({resolution * place, mean[k - 1] + mean[k] + mean[k + 1]});
    }
    std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.power > b.power; });
    return lines;
}

/// Merges lines closer than three bins, at the mean of their frequencies by power: the line of a tone whose distances
/// are uneven, such as a harmonic of ridges, falls apart into some, and two tones in its place would beat.
inline void mergeSplitLines(std::vector<WayLine>& lines, double resolution)
{
    std::sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
    std::vector<WayLine> merged;
    for (std::size_t i = 0; i < lines.size();)
    {
        WayLine sum;
        double last = lines[i].frequency;
        for (; i < lines.size() && lines[i].frequency < last + 3.0 * resolution; ++i)
        {
            last = lines[i].frequency;
            sum.frequency += lines[i].power * lines[i].frequency;
            sum.power += lines[i].power;
        }
        sum.frequency /= sum.power;
        merged.push_back(sum);
    }
    std::stable_sort(merged.begin(), merged.end(), [](const auto& a, const auto& b) { return a.power > b.power; });
    lines = std::move(merged);
}

/// Moves lines that are near multiples of one frequency onto them, so that harmonics keep their phases to each other.
inline void alignHarmonics(std::vector<WayLine>& lines, double resolution)
{
    const double tolerance = 0.4 * resolution;
    const auto multipleOf = [](double frequency, double base)
    {
        return std::max(1.0, std::round(frequency / base));
    };
    double best = 0.0, base = 0.0;
    for (const WayLine& line : lines)
        for (int divisor = 1; divisor <= 4; ++divisor)
        {
            const double candidate = line.frequency / divisor;
            // With multiples closer than this anything would be one.
            if (candidate < 4.0 * resolution)
                continue;
            double power = 0.0;
            std::size_t count = 0;
            for (const WayLine& other : lines)
            {
                const double multiple = multipleOf(other.frequency, candidate);
                if (std::abs(other.frequency - multiple * candidate) > tolerance)
                    continue;
                power += other.power;
                ++count;
            }
            // A smaller one must explain more.
            if (count >= 2 && (power > 1.1 * best || (power > 0.9 * best && candidate > base)))
            {
                best = power;
                base = candidate;
            }
        }
    if (!(base > 0.0))
        return;
    double above = 0.0, below = 0.0;
    for (const WayLine& line : lines)
        if (const double m = multipleOf(line.frequency, base); std::abs(line.frequency - m * base) <= tolerance)
        {
            above += line.power * m * line.frequency;
            below += line.power * m * m;
        }
    const double fitted = above / below;
    for (WayLine& line : lines)
        if (const double m = multipleOf(line.frequency, base); std::abs(line.frequency - m * base) <= tolerance)
            line.frequency = m * fitted;
}

/// The tones of one frame by weighted least squares, all together, so that close ones are told apart.
class ToneFit
{
public:
    explicit ToneFit(std::size_t window) : weights(hannPeriodic(window)) {}

    /// Amplitudes of `frequencies` (Hz at speed 1) over a frame and its way. Adds weight times what is left to `rest`.
    void fit(std::span<const float> samples, std::span<const double> way, std::span<const double> frequencies,
             std::span<ToneFrame> tones, std::span<double> rest)
    {
        constexpr double turn = 2.0 * std::numbers::pi;
        std::vector<std::size_t> there;
        for (std::size_t k = 0; k < frequencies.size(); ++k)
            if (tones[k].there)
                there.push_back(k);
        const auto frames = static_cast<Eigen::Index>(samples.size());
        const auto columns = static_cast<Eigen::Index>(2 * there.size());
        Eigen::MatrixXd waves(frames, columns);
        Eigen::VectorXd x(frames), w(frames);
        for (Eigen::Index n = 0; n < frames; ++n)
        {
            const auto i = static_cast<std::size_t>(n);
            x(n) = static_cast<double>(samples[i]);
            w(n) = weights[i];
            for (Eigen::Index c = 0; c < columns; c += 2)
            {
                const double cycles = frequencies[there[static_cast<std::size_t>(c / 2)]] * way[i];
                const double angle = turn * (cycles - std::floor(cycles));
                waves(n, c) = std::cos(angle);
                waves(n, c + 1) = std::sin(angle);
            }
        }
        Eigen::VectorXd left = x;
        if (columns > 0)
        {
            const Eigen::MatrixXd weighted = w.asDiagonal() * waves;
            Eigen::MatrixXd normal = waves.transpose() * weighted;
            normal.diagonal().array() += 1e-6 * w.sum();
            const Eigen::VectorXd solved = normal.ldlt().solve(weighted.transpose() * x);
            left -= waves * solved;
            for (Eigen::Index c = 0; c < columns; c += 2)
                tones[there[static_cast<std::size_t>(c / 2)]].amplitude = {solved(c), -solved(c + 1)};
        }
        for (Eigen::Index n = 0; n < frames; ++n)
            rest[static_cast<std::size_t>(n)] += w(n) * left(n);
    }

private:
    std::vector<double> weights;
};

} // namespace detail

/// Finds tones whose frequency is in proportion to `speed` (0 to 1, of each sample), at most `most`, in a recording of
/// `rate` Hz whose band ends at a quarter of that; `window` samples are a frame. The recording is read over the way, in
/// which such a tone is a line (order tracking: A. Vold and J. Leuridan, 1993, do it by a filter); lines that stand out
/// of the noise around them count, harmonics are moved onto multiples of one frequency, and amplitudes are those of
/// least squares in each frame. None of fewer than some two seconds at full speed. [worker]
[[nodiscard]] inline FoundTones findTones(std::span<const float> samples, std::span<const double> speed, double rate,
                                          std::size_t window, std::size_t most)
{
    FoundTones found;
    found.window = window;
    found.step = window / 2;
    found.rest.assign(samples.begin(), samples.end());
    if (most == 0 || samples.size() < 4 * window)
        return found;
    const auto way = detail::wayOf(speed, rate);
    // The slowest part that counts: a tenth of the recording may be slower.
    std::vector<double> moving;
    for (const double value : speed)
        if (value >= 0.01)
            moving.push_back(value);
    if (moving.empty())
        return found;
    const auto tenth = moving.begin() + static_cast<std::ptrdiff_t>(moving.size() / 10);
    std::nth_element(moving.begin(), tenth, moving.end());
    const double highest = 0.25 * rate / *tenth;
    double resolution = 1.0;
    auto lines = detail::linesOverWay(detail::overWay(samples, way, 0.5 / highest), 0.5 / highest, resolution);
    detail::mergeSplitLines(lines, resolution);
    if (lines.size() > most)
        lines.resize(most);
    detail::alignHarmonics(lines, resolution);
    std::sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
    for (const auto& line : lines)
        if (found.frequencies.empty() || line.frequency > found.frequencies.back() + 0.5 * resolution)
            found.frequencies.push_back(line.frequency);
    if (found.frequencies.empty())
        return found;

    constexpr double lowest = 15.0, top = 1000.0;
    detail::ToneFit fit(window);
    std::vector<double> rest(samples.size(), 0.0);
    for (std::size_t start = 0; start + window <= samples.size(); start += found.step)
    {
        const double middle = speed[start + window / 2];
        auto& tones = found.frames.emplace_back(found.frequencies.size());
        for (std::size_t k = 0; k < tones.size(); ++k)
        {
            const double frequency = found.frequencies[k] * middle;
            tones[k].there = frequency >= lowest && frequency <= top;
        }
        fit.fit(samples.subspan(start, window), std::span(way).subspan(start, window), found.frequencies, tones,
                std::span(rest).subspan(start, window));
    }
    // Frames overlap by half; at both ends there is one of them.
    found.rest.resize(found.step * (found.frames.size() - 1) + window);
    std::vector<double> weight(found.rest.size(), 0.0);
    const auto weights = hannPeriodic(window);
    for (std::size_t i = 0; i < found.frames.size(); ++i)
        for (std::size_t n = 0; n < window; ++n)
            weight[i * found.step + n] += weights[n];
    for (std::size_t n = 0; n < found.rest.size(); ++n)
        found.rest[n] = weight[n] > 1e-6 ? static_cast<float>(rest[n] / weight[n]) : 0.0f;
    return found;
}

} // namespace pacini
