#include "io/formats/ImportReport.h"

#include <pacini/clip/BandPriority.h>
#include <pacini/synthesis/TransientPulse.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace pacini
{

namespace
{
/// A curve holds its last value: it ends at `end` unless it is silent there.
void stopAt(Curve& curve, double end)
{
    if (curve.empty() || curve.back().value <= 0.0)
        return;
    if (curve.back().time < end)
        curve.push_back({end, curve.back().value});
    curve.push_back({end, 0.0});
}

/// s for which an event sounds that stands alone.
double pulseLength(const Transient& event)
{
    constexpr double fs = 48000.0, alone = 1.0;
    return static_cast<double>(makePulse({}, event.sharpness, alone, fs, 1.0).frames) / fs;
}
} // namespace

void ImportReport::warn(std::string_view where, std::string_view message)
{
    constexpr std::size_t most = 50;
    if (warnings.size() < most)
        warnings.push_back(fmt::format("{}: {}", where, message));
}

void ImportReport::fail(std::string where, std::string message, ErrorCode code)
{
    if (!error)
        error = Error{code, std::move(where), std::move(message)};
}

Band* ImportLanes::take(double start, double end, std::size_t most)
{
    std::size_t lane = 0;
    while (lane < bands.size() && ends[lane] > start)
        ++lane;
    if (lane == bands.size())
    {
        if (bands.size() >= most)
            return nullptr;
        bands.emplace_back();
        ends.push_back(0.0);
    }
    ends[lane] = end;
    return &bands[lane];
}

void lengthen(Clip& clip, double duration)
{
    if (duration <= clip.duration)
        return;
    stopAt(clip.envelope, clip.duration);
    for (Band& band : clip.bands)
        stopAt(band.amplitude, clip.duration);
    for (NoiseBand& band : clip.noise)
        stopAt(band.amplitude, clip.duration);
    clip.duration = duration;
}

void lastUntilSounded(Clip& clip)
{
    constexpr double margin = 0.0005; // s
    double end = 0.0;
    for (const Transient& event : clip.transients)
        end = std::max(end, event.time + pulseLength(event));
    if (end = std::min(end, limits::duration); end > clip.duration + margin)
        lengthen(clip, end);
}

void sortByTime(std::span<Transient> events)
{
    std::stable_sort(events.begin(), events.end(),
                     [](const Transient& a, const Transient& b) { return a.time < b.time; });
}

void finishImported(Clip& clip, bool endIsStated)
{
    sortByTime(clip.transients);
    if (!endIsStated)
        lastUntilSounded(clip);
    rankByEnergy(clip);
}

} // namespace pacini
