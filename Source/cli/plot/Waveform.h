#pragma once

// Waveform reduction: a sound of any length as a line with no more points than a picture can show.

#include "cli/plot/Path.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pacini::plot
{

/// A stretch of time in seconds, `to` above `from`.
struct TimeRange
{
    double from = 0.0, to = 1.0;
    bool operator==(const TimeRange&) const = default;
};

/// Takes samples block by block and keeps the extremes for `columns` columns of pixels across `range`. Memory is
/// bounded by the columns, not by the sound.
class Waveform
{
public:
    Waveform(TimeRange range, std::size_t columns, double sampleRate, std::size_t channels);

    /// Whole frames of interleaved samples, from the start of the sound on; the mean of the channels counts.
    void push(std::span<const float> interleaved);

    /// Seconds and values in order of time.
    [[nodiscard]] std::vector<Point> points() const;

private:
    TimeRange shown;
    double columnsPerSecond;
    double fs;
    std::size_t channelCount;
    std::size_t maxKept;
    std::uint64_t frame = 0;
    std::vector<Point> kept; // x in columns
};

} // namespace pacini::plot
