#include "io/formats/LossList.h"

#include "io/formats/ForeignText.h"
#include "io/formats/FormatLosses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini
{

void LossList::add(LossKind kind, double time, double duration, double error, std::string message)
{
    losses.push_back({kind, time, duration, error, std::move(message)});
}

void LossList::addNoise(const Clip& clip)
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
}

void LossList::addText(const Clip& clip, bool keepsName)
{
    for (const Marker& marker : clip.markers)
        add(LossKind::text, marker.time, 0.0, 0.0, "markers are left out");
    const bool losesName = !keepsName && !clip.name.empty();
    if (losesName || !clip.source.file.empty() || !clip.encoder.empty())
        add(LossKind::text, 0.0, 0.0, 0.0,
            losesName ? "the name, the source and the encoder's parameters are left out"
                      : "the source and the encoder's parameters are left out");
}

void LossList::addVoice(const Clip& clip, const SingleVoice& voice, bool keepsName)
{
    double noise = 0.0;
    for (const NoiseBand& band : clip.noise)
        for (const Breakpoint& point : band.amplitude)
            noise = std::max(noise, point.value);
    if (noise > 0.0)
        add(LossKind::noise, 0.0, clip.duration, noise, "residual noise becomes part of the voice");
    addText(clip, keepsName);
    const auto silent = [](const Breakpoint& point)
    {
        return point.value <= 0.0;
    };
    if (voice.events.empty() && std::all_of(voice.amplitude.begin(), voice.amplitude.end(), silent))
        add(LossKind::empty, 0.0, clip.duration, 0.0, "nothing sounds");
}

void LossList::addOneVoice(const Clip& clip, const SingleVoice& voice, bool keepsName)
{
    LossTrack bands(LossKind::bands, fmt::format("{} bands share one voice", clip.bands.size()));
    for (const Breakpoint& point : voice.displaced)
        bands.add(point.time, point.value > leastAmplitude ? point.value : 0.0);
    bands.appendTo(losses);
    addVoice(clip, voice, keepsName);
}

void LossList::addStrengthOnly(const Clip& clip, const SingleVoice& voice, bool keepsName)
{
    if (!clip.bands.empty())
        add(LossKind::bands, 0.0, clip.duration, 0.0,
            fmt::format("{} become a strength without frequency",
                        clip.bands.size() == 1 ? "the band" : fmt::format("{} bands", clip.bands.size())));
    for (std::size_t i = 0; i < voice.events.size(); ++i)
        add(LossKind::event, voice.events[i].time, 0.0, 0.0, "events become bursts without sharpness");
    addVoice(clip, voice, keepsName);
}

void LossList::addThinned(const Curve& before, const Curve& after, double duration)
{
    double worst = 0.0;
    CurveReader reader(after);
    for (const Breakpoint& point : before)
        worst = std::max(worst, std::abs(reader.at(point.time) - point.value));
    if (worst > leastAmplitude)
        add(LossKind::points, 0.0, duration, worst, "amplitudes have fewer points than are played");
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
                                                     loss.kind == LossKind::text || loss.kind == LossKind::event);
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
