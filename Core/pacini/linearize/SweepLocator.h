#pragma once

// Sweep detection: where in a recording the sweeps are.

#include <pacini/foundation/Fft.h>
#include <pacini/linearize/Deconvolution.h>
#include <pacini/linearize/RecordedChannels.h>
#include <pacini/linearize/SweepSchedule.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Positions of the responses to all sweeps, on a grid of 1 ms.
struct SweepPosition
{
    double start = 0.0;    ///< s of the recording at which playback began, to about 10 ms
    double contrast = 0.0; ///< power at the strongest sweep over the power of most other times
    double focus = 0.0;    ///< part of the power within 2.5 s of the strongest sweep that lies within 25 ms of it
};

namespace detail
{
inline constexpr double locatorStep = 0.001; // s

/// Range maximum query: the largest of any range of values in constant time: the maxima of all runs of 2^k cells (M.
/// Bender, M. Farach-Colton, "The LCA problem revisited", 2000), of ten values each, to which ranges are widened.
class RangeMaximum
{
public:
    explicit RangeMaximum(std::span<const double> values)
    {
        auto& cells = runs.emplace_back(values.size() / cell + 1, 0.0f);
        for (std::size_t i = 0; i < values.size(); ++i)
            cells[i / cell] = std::max(cells[i / cell], static_cast<float>(values[i]));
        for (std::size_t length = 1; 2 * length <= runs.front().size(); length *= 2)
        {
            std::vector<float> longer(runs.back().size() - length);
            for (std::size_t i = 0; i < longer.size(); ++i)
                longer[i] = std::max(runs.back()[i], runs.back()[i + length]);
            runs.push_back(std::move(longer));
        }
    }

    /// The maximum of the values first .. last; 0 when last < first, or beyond the end.
    [[nodiscard]] double over(std::size_t first, std::size_t last) const noexcept
    {
        const std::size_t begin = first / cell;
        const std::size_t end = std::min(last / cell + 1, runs.front().size());
        if (last < first || begin >= end)
            return 0.0;
        const auto k = static_cast<std::size_t>(std::bit_width(end - begin) - 1);
        return static_cast<double>(std::max(runs[k][begin], runs[k][end - (std::size_t(1) << k)]));
    }

private:
    static constexpr std::size_t cell = 10;
    std::vector<std::vector<float>> runs;
};

/// The strength of the response to a sweep that starts at each ms from `first` s on: the root of the power in windows
/// of 20 ms, summed over the channels relative to each one's median, so that a noisy channel does not hide the others.
struct ArrivalStrength
{
    double first = 0.0;
    std::vector<double> strength;
    std::size_t channels = 0; ///< that are not constant
};

[[nodiscard]] inline ArrivalStrength arrivalStrength(const RecordedChannels& recording, const ExponentialSweep& sweep)
{
    const auto played = delayedSweep(sweep, recording.rate, 0.0);
    const std::size_t size = nextFastFftSize(recording.frames() + played.size());
    // Below its range an equalizer may leave the sweep 40 dB stronger than within. What markers, which are short,
    // spread down there must not be raised as well, or they stand out more than the sweep.
    constexpr double regularisation = -40.0; // dB
    Deconvolver deconvolver(played, size, regularisation);
    const auto before = static_cast<std::ptrdiff_t>(played.size());
    ArrivalStrength arrivals{-static_cast<double>(before) / recording.rate, {}, 0};
    const double seconds = static_cast<double>(played.size() + recording.frames()) / recording.rate;
    const auto cells = static_cast<std::size_t>(seconds / locatorStep);
    std::vector<double> power(cells, 0.0);
    for (std::size_t c = 0; c < recording.channels.size(); ++c)
    {
        const auto [least, most] = std::minmax_element(recording.channels[c].begin(), recording.channels[c].end());
        if (!(*most - *least > 1e-9))
            continue; // the rounding of a constant has any shape
        ++arrivals.channels;
        const auto h =
            deconvolver.signal(deconvolver.response(deconvolver.spectrum(recording.part(c, 0, recording.frames()))));
        std::vector<double> cell(cells + 1, 0.0);
        for (std::size_t i = 0; i < played.size() + recording.frames(); ++i)
        {
            const auto lag = static_cast<std::ptrdiff_t>(i) - before;
            const double v = h[static_cast<std::size_t>(lag < 0 ? lag + static_cast<std::ptrdiff_t>(size) : lag)];
            cell[static_cast<std::size_t>(static_cast<double>(i) / recording.rate / locatorStep)] += v * v;
        }
        cell.resize(cells);
        std::vector<double> windowed(cells, 0.0);
        double sum = 0.0;
        constexpr std::size_t width = 20;
        for (std::size_t i = 0; i < cells; ++i)
        {
            sum += cell[i] - (i >= width ? cell[i - width] : 0.0);
            windowed[i >= width / 2 ? i - width / 2 : 0] = std::max(0.0, sum);
        }
        // Where a sweep would not be in the recording as a whole, the noise is weaker too.
        const auto whole =
            windowed.begin() +
            static_cast<std::ptrdiff_t>(std::min(
                cells / 3, static_cast<std::size_t>(static_cast<double>(before) / recording.rate / locatorStep)));
        std::vector<double> sorted(whole, windowed.end() - (whole - windowed.begin()));
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        const double largest = *std::max_element(windowed.begin(), windowed.end());
        // Digital silence between the sweeps would count for infinitely much.
        const double floor = std::max(*middle, 1e-9 * largest);
        if (floor > 0.0)
            for (std::size_t i = 0; i < cells; ++i)
                power[i] += windowed[i] / floor;
    }
    arrivals.strength.resize(cells);
    std::transform(power.begin(), power.end(), arrivals.strength.begin(), [](double p) { return std::sqrt(p); });
    return arrivals;
}
} // namespace detail

/// Largest difference of clocks for which sweeps are searched: more than a measurement accepts.
inline constexpr double widestDrift = 0.005;

/// Finds the schedule in a recording: the start that correlates best with the strengths of all sweeps, each allowed to
/// be late or early by what clocks may drift. `sweep` is the one that was played as the recorder sees it; times of the
/// schedule are stretched by `stretch`.
[[nodiscard]] inline SweepPosition locateSweeps(const RecordedChannels& recording, const SweepSchedule& schedule,
                                                double playRate, const ExponentialSweep& sweep, double stretch = 1.0)
{
    const auto arrivals = detail::arrivalStrength(recording, sweep);
    const detail::RangeMaximum maxima(arrivals.strength);
    const auto largest = [&](double from, double to)
    {
        const auto size = static_cast<double>(arrivals.strength.size());
        const double first = std::floor((from - arrivals.first) / detail::locatorStep);
        const double last = std::ceil((to - arrivals.first) / detail::locatorStep);
        return last < 0.0 || first >= size ? 0.0
                                           : maxima.over(static_cast<std::size_t>(std::max(first, 0.0)),
                                                         static_cast<std::size_t>(std::min(last, size - 1.0)));
    };
    const auto startOf = [&](const ScheduledSweep& s)
    {
        return stretch * static_cast<double>(s.startFrame) / playRate;
    };
    SweepPosition found;
    double best = -1.0;
    const auto& loudest = *std::max_element(schedule.sweeps.begin(), schedule.sweeps.end(),
                                            [](const auto& a, const auto& b) { return a.level < b.level; });
    const double firstStart = startOf(schedule.sweeps.front());
    for (std::size_t i = 0; i < arrivals.strength.size(); ++i)
    {
        const double start = arrivals.first + static_cast<double>(i) * detail::locatorStep - firstStart;
        double score = Decibels(schedule.sweeps.front().level).gain() * arrivals.strength[i];
        for (std::size_t k = 1; k < schedule.sweeps.size(); ++k)
        {
            const double at = start + startOf(schedule.sweeps[k]);
            const double tolerance = 0.01 + widestDrift * (startOf(schedule.sweeps[k]) - firstStart);
            score += Decibels(schedule.sweeps[k].level).gain() * largest(at - tolerance, at + tolerance);
        }
        if (score > best)
        {
            best = score;
            found.start = start;
        }
    }
    const double at = found.start + startOf(loudest);
    const double tolerance = 0.02 + widestDrift * (startOf(loudest) - firstStart);
    const double peak = largest(at - tolerance, at + tolerance);
    found.contrast = peak * peak / static_cast<double>(std::max<std::size_t>(1, arrivals.channels));
    double narrow = 0.0;
    double wide = 0.0;
    for (std::size_t i = 0; i < arrivals.strength.size(); ++i)
    {
        const double distance = std::abs(arrivals.first + static_cast<double>(i) * detail::locatorStep - at);
        const double power = arrivals.strength[i] * arrivals.strength[i];
        narrow += distance < 0.025 ? power : 0.0;
        wide += distance < 2.5 ? power : 0.0;
    }
    found.focus = wide > 0.0 ? narrow / wide : 0.0;
    return found;
}

/// Returns the probable sample rate of a recording, Hz, if it is not the stated one: the usual rate at which the sweeps
/// are four times as prominent and short. None if the stated rate is as good.
[[nodiscard]] inline std::optional<double> likelierRate(const RecordedChannels& recording,
                                                        const SweepSchedule& schedule, const SweepParams& params,
                                                        double statedRate, const SweepPosition& stated)
{
    std::optional<double> likelier;
    double best = 4.0 * stated.contrast;
    const double played = static_cast<double>(schedule.frames) / params.sampleRate - 2.0 * params.pause;
    for (const double rate :
         {8000.0, 16000.0, 22050.0, 32000.0, 44100.0, 48000.0, 88200.0, 96000.0, 176400.0, 192000.0})
    {
        const double stretch = rate / statedRate;
        if (stretch < 0.4 || stretch * played > recording.seconds() || std::abs(stretch - 1.0) < widestDrift)
            continue;
        const auto position = locateSweeps(recording, schedule, params.sampleRate,
                                           measuringSweep(params).byClock(stretch - 1.0), stretch);
        if (position.contrast > best && position.focus > 0.5)
        {
            best = position.contrast;
            likelier = rate;
        }
    }
    return likelier;
}

} // namespace pacini
