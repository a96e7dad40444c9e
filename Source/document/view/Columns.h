#pragma once

// Column reduction of curves and sounds: the extremes in each column of pixels.

#include "document/view/MonoSource.h"
#include "document/view/TimeAxis.h"

#include <pacini/clip/Curve.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The least and greatest value within a column.
struct Column
{
    float low = 0.0f;
    float high = 0.0f;
    bool operator==(const Column&) const = default;
};

/// What a curve reaches in each column of a view, columns[i] for x in [i, i + 1]: drawn as vertical lines it looks as
/// all its points would. An empty curve is 0. O(log n + visible points + columns).
inline void curveColumns(std::span<const Breakpoint> curve, const TimeAxis& axis, std::span<Column> columns)
{
    auto next = std::lower_bound(curve.begin(), curve.end(), axis.start,
                                 [](const Breakpoint& p, double t) { return p.time < t; });
    double edge = valueAt(curve, axis.start);
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
        const double end = axis.timeAt(static_cast<double>(i) + 1.0);
        double low = edge;
        double high = edge;
        for (; next != curve.end() && next->time <= end; ++next)
        {
            low = std::min(low, next->value);
            high = std::max(high, next->value);
        }
        if (next == curve.begin() || next == curve.end())
            edge = curve.empty() ? 0.0 : next == curve.begin() ? next->value : (next - 1)->value;
        else
        {
            const Breakpoint& a = *(next - 1);
            edge = a.value + (next->value - a.value) * ((end - a.time) / (next->time - a.time));
        }
        columns[i] = {static_cast<float>(std::min(low, edge)), static_cast<float>(std::max(high, edge))};
    }
}

/// Extremes of a sound at several resolutions, so that an hour is drawn as fast as a second. Takes 1/32 of its size.
class WaveformPeaks
{
public:
    /// One channel. The samples must outlive this. [worker]
    WaveformPeaks(MonoSource channel, double sampleRate) : sound(std::move(channel)), fs(sampleRate)
    {
        std::vector<Column> level;
        for (std::size_t i = 0; i < sound.frames(); i += base)
            level.push_back(ofSamples(i, std::min(i + base, sound.frames())));
        while (level.size() > 1)
        {
            std::vector<Column> coarser;
            for (std::size_t i = 0; i < level.size(); i += ratio)
                coarser.push_back(merged(std::span(level).subspan(i, std::min(ratio, level.size() - i))));
            levels.push_back(std::move(level));
            level = std::move(coarser);
        }
    }

    /// The extremes of each column of a view; 0 outside the sound. At most about 80 values are read for a column.
    void columns(const TimeAxis& axis, std::span<Column> out) const
    {
        for (std::size_t i = 0; i < out.size(); ++i)
        {
            const double from = axis.timeAt(static_cast<double>(i)) * fs;
            const double to = axis.timeAt(static_cast<double>(i) + 1.0) * fs;
            const auto limit = [&](double frame)
            {
                return static_cast<std::size_t>(std::clamp(frame, 0.0, static_cast<double>(sound.frames())));
            };
            const std::size_t begin = limit(from);
            const std::size_t end = std::max(limit(to), std::min(begin + 1, limit(to + 1.0)));
            out[i] = begin < end ? between(begin, end) : Column{};
        }
    }

private:
    static constexpr std::size_t base = 64;
    static constexpr std::size_t ratio = 8;

    /// Of at most 3 `base` frames, at least one.
    [[nodiscard]] Column ofSamples(std::size_t begin, std::size_t end) const
    {
        std::array<float, 3 * base> buffer;
        const std::span<float> samples = std::span(buffer).first(std::min(end - begin, buffer.size()));
        sound.read(static_cast<std::int64_t>(begin), samples);
        const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
        return {*low, *high};
    }

    static Column merged(std::span<const Column> parts)
    {
        Column all = parts.front();
        for (const Column& part : parts)
            all = {std::min(all.low, part.low), std::max(all.high, part.high)};
        return all;
    }

    /// Of frames [begin, end): the ragged ends from finer levels, the middle from coarser ones.
    [[nodiscard]] Column between(std::size_t begin, std::size_t end) const
    {
        Column all{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
        const auto add = [&](const Column& part)
        {
            all = {std::min(all.low, part.low), std::max(all.high, part.high)};
        };
        const std::size_t first = (begin + base - 1) / base;
        const std::size_t last = end / base;
        if (first >= last || levels.empty())
            return ofSamples(begin, end);
        if (begin < first * base)
            add(ofSamples(begin, first * base));
        if (last * base < end)
            add(ofSamples(last * base, end));
        std::size_t a = first;
        std::size_t b = last;
        for (std::size_t level = 0; a < b; ++level)
        {
            const bool coarsest = level + 1 == levels.size();
            for (; a < b && (a % ratio != 0 || coarsest); ++a)
                add(levels[level][a]);
            for (; a < b && (b % ratio != 0 || coarsest); --b)
                add(levels[level][b - 1]);
            a /= ratio;
            b /= ratio;
        }
        return all;
    }

    MonoSource sound;
    double fs;
    std::vector<std::vector<Column>> levels;
};

} // namespace pacini
