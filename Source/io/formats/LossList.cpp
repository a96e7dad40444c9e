#include "io/formats/LossList.h"

#include "io/formats/ForeignText.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace pacini
{

void LossList::add(LossKind kind, double time, double duration, double error, std::string message)
{
    losses.push_back({kind, time, duration, error, std::move(message)});
}

void LossList::addNoiseAndText(const Clip& clip, bool keepsName)
{
    for (const NoiseBand& band : clip.noise)
    {
        double peak = 0.0;
        for (const Breakpoint& point : band.amplitude)
            peak = std::max(peak, point.value);
        if (peak > 0.0)
            add(LossKind::noise, 0.0, clip.duration, peak,
                fmt::format("noise from {} to {} Hz is left out", decimal(band.lowFrequency, 0),
                            decimal(band.highFrequency, 0)));
    }
    for (const Marker& marker : clip.markers)
        add(LossKind::text, marker.time, 0.0, 0.0, "markers are left out");
    const bool losesName = !keepsName && !clip.name.empty();
    if (losesName || !clip.source.file.empty() || !clip.encoder.empty())
        add(LossKind::text, 0.0, 0.0, 0.0,
            losesName ? "the name, the source and the encoder's parameters are left out"
                      : "the source and the encoder's parameters are left out");
}

void LossList::addBands(const Clip& clip, std::string message)
{
    if (clip.bands.size() > 1)
        add(LossKind::bands, 0.0, clip.duration, 0.0, std::move(message));
}

void LossList::addAbove(const Curve& curve, double most)
{
    for (std::size_t i = 0; i < curve.size(); ++i)
    {
        if (curve[i].value <= most)
            continue;
        const double end = i + 1 < curve.size() ? curve[i + 1].time : curve[i].time;
        add(LossKind::amplitude, curve[i].time, end - curve[i].time, curve[i].value - most,
            fmt::format("amplitudes above {} are cut", decimal(most, 3)));
    }
}

void LossList::addCrowding(const std::vector<Transient>& events, double gap)
{
    for (std::size_t i = 1; i < events.size(); ++i)
        if (events[i].time - events[i - 1].time < gap)
            add(LossKind::crowding, events[i - 1].time, events[i].time - events[i - 1].time, events[i].amplitude,
                fmt::format("events less than {} ms apart run into each other", decimal(1000.0 * gap, 1)));
}

void LossList::addEmpty(double duration)
{
    add(LossKind::empty, 0.0, duration, 0.0, "nothing sounds");
}

std::vector<FormatLoss> LossList::sorted() &&
{
    constexpr double touching = 1e-6;
    std::stable_sort(losses.begin(), losses.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    std::vector<FormatLoss> merged;
    for (FormatLoss& loss : losses)
    {
        const auto before = std::find_if(merged.rbegin(), merged.rend(),
                                         [&](const FormatLoss& earlier)
                                         {
                                             return earlier.kind == loss.kind && earlier.message == loss.message &&
                                                    (earlier.time + earlier.duration >= loss.time - touching ||
                                                     loss.kind == LossKind::text);
                                         });
        if (before == merged.rend())
        {
            merged.push_back(std::move(loss));
            continue;
        }
        before->duration = std::max(before->duration, loss.time + loss.duration - before->time);
        before->error = std::max(before->error, loss.error);
    }
    return merged;
}

} // namespace pacini
