#pragma once

// Attributes of an onset: start of its attack, level and sharpness.

#include <pacini/analysis/OnsetFrame.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pacini
{

/// Onset: the start of something.
struct Onset
{
    double time = 0.0;         ///< s, start of the attack
    double amplitude = 0.0;    ///< peak of the attack on the scale of the samples, full band
    double lowAmplitude = 0.0; ///< the same of the part below 1800 Hz
    double sharpness = 0.0;    ///< 0: the new sound lies below 150 Hz, 1: above 2.5 kHz, in between by log frequency
    double salience = 0.0;     ///< how clearly it stands out: from 1 at the threshold to about 2.7 out of silence
    bool operator==(const Onset&) const = default;
};

namespace detail
{
/// Offset from `frame` (-12..8) of the frame in which the attack around it starts: going back from where half the peak
/// amplitude is reached, the first frame that stands out from the background before, that is exceeds 8 % of the peak
/// amplitude and 2.5 times the background's median (but at most half the peak). `frame` must have 17 frames before it
/// and 9 after; it does not go back beyond `index` frames, the frame's distance from the start of the sound.
inline std::ptrdiff_t attackStart(const OnsetFrame* frame, std::int64_t index)
{
    float peak = 0.0f;
    for (std::ptrdiff_t j = -3; j < 9; ++j)
        peak = std::max(peak, frame[j].power);
    std::ptrdiff_t start = -3;
    while (start < 8 && frame[start].power < 0.25f * peak)
        ++start;
    std::array<float, 10> background;
    for (std::size_t i = 0; i < background.size(); ++i)
        background[i] = frame[start - 14 + static_cast<std::ptrdiff_t>(i)].power;
    std::nth_element(background.begin(), background.begin() + 5, background.end());
    const float threshold = std::max(0.0064f * peak, std::min(6.25f * background[5], 0.25f * peak));
    const std::int64_t earliest = std::max<std::int64_t>(start - 9, -index);
    while (start > earliest && frame[start - 1].power > threshold)
        --start;
    return start;
}

/// The greatest mean over 5 frames (5.6 ms) of frames [0, count), by `power`; count >= 5.
template <typename Power>
double greatestPower(const OnsetFrame* frames, std::ptrdiff_t count, Power power)
{
    double greatest = 0.0;
    for (std::ptrdiff_t i = 0; i + 5 <= count; ++i)
    {
        double sum = 0.0;
        for (std::ptrdiff_t j = i; j < i + 5; ++j)
            sum += static_cast<double>(power(frames[j]));
        greatest = std::max(greatest, sum / 5.0);
    }
    return greatest;
}

/// Position of the power gained by each band (8 frames from `start` on less the 8 before, where positive) on a scale of
/// log frequency: sum(gain log f) / sum(gain), f the band's centre, mapped from 150 Hz -> 0 to 2500 Hz -> 1.
inline double sharpness(const OnsetFrame* start)
{
    double sum = 0.0;
    double weighted = 0.0;
    for (std::size_t b = 0; b < OnsetFrame::bandCount; ++b)
    {
        double gain = 0.0;
        for (std::ptrdiff_t j = 0; j < 8; ++j)
            gain += static_cast<double>(start[j].bands[b]) - static_cast<double>(start[-1 - j].bands[b]);
        gain = std::max(gain, 0.0);
        sum += gain;
        weighted += gain * std::log(OnsetFrame::bandCentres[b] / 150.0);
    }
    return sum > 0.0 ? std::clamp(weighted / sum / std::log(2500.0 / 150.0), 0.0, 1.0) : 0.0;
}
} // namespace detail

/// The event around `frame`, which is frame number `index` and has 26 frames before it and 24 after it in memory. Its
/// amplitudes, sqrt(2 P) with P the greatest power over 5.6 ms, are looked for before frame `nextEvent` of the sound
/// and within 24 ms. The time is exact to a fraction of a frame where the sound sets in suddenly.
[[nodiscard]] inline Onset measureOnset(const OnsetFrame* frame, std::int64_t index, std::int64_t nextEvent)
{
    const std::ptrdiff_t offset = detail::attackStart(frame, index);
    const OnsetFrame* start = frame + offset;
    Onset onset;

    // The first frame holds the part of the second one's power that the event leaves it time for.
    const double first = static_cast<double>(start[0].power);
    const double second = static_cast<double>(start[1].power);
    const double empty = first < second ? 1.0 - first / second : 0.0;
    if (index + offset > 0)
        onset.time = (static_cast<double>(index + offset) + empty) / OnsetFrame::rate;

    const auto end = static_cast<std::ptrdiff_t>(std::min<std::int64_t>(22, nextEvent - index));
    const std::ptrdiff_t count = std::max<std::ptrdiff_t>(end - offset + 1, 6);
    onset.amplitude =
        std::sqrt(2.0 * detail::greatestPower(start - 1, count, [](const OnsetFrame& f) { return f.power; }));
    onset.lowAmplitude =
        std::sqrt(2.0 * detail::greatestPower(start - 1, count, [](const OnsetFrame& f) { return f.lowPower; }));
    onset.sharpness = detail::sharpness(start);
    return onset;
}

} // namespace pacini
