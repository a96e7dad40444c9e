#include "cli/plot/Waveform.h"

#include "cli/plot/SeriesDrawing.h"

namespace pacini::plot
{

Waveform::Waveform(TimeRange range, std::size_t columns, double sampleRate, std::size_t channels)
    : shown(range),
      columnsPerSecond(static_cast<double>(columns) / (range.to - range.from)),
      fs(sampleRate),
      channelCount(channels),
      maxKept(16 * columns + 65536)
{
}

void Waveform::push(std::span<const float> interleaved)
{
    for (std::size_t i = 0; i + channelCount <= interleaved.size(); i += channelCount, ++frame)
    {
        const double time = static_cast<double>(frame) / fs;
        // One sample on either side lets the line reach the edge.
        if (time < shown.from - 1.0 / fs || time > shown.to + 1.0 / fs)
            continue;
        double sum = 0.0;
        for (const float sample : interleaved.subspan(i, channelCount))
            sum += static_cast<double>(sample);
        kept.push_back({(time - shown.from) * columnsPerSecond, sum / static_cast<double>(channelCount)});
        if (kept.size() >= maxKept)
            kept = thinned(kept);
    }
}

std::vector<Point> Waveform::points() const
{
    std::vector<Point> result = thinned(kept);
    for (Point& point : result)
        point.x = shown.from + point.x / columnsPerSecond;
    return result;
}

} // namespace pacini::plot
