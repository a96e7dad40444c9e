#include "io/formats/LossList.h"

#include "io/formats/ForeignText.h"

#include <pacini/foundation/NumberText.h>
#include <pacini/simplify/HatBasis.h>
#include <pacini/synthesis/SingleVoice.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pacini
{

namespace
{
constexpr const char* inVoice = "residual noise is merged into the voice";

double largestValue(const Curve& curve)
{
    double largest = 0.0;
    for (const Breakpoint& point : curve)
        largest = std::max(largest, point.value);
    return largest;
}

std::string cutMessage(double most)
{
    return fmt::format("amplitudes above {} are clipped", shortDecimalText(most, 3));
}
} // namespace

void LossList::add(LossKind kind, double time, double duration, double error, std::string message)
{
    losses.push_back({kind, time, duration, error, std::move(message)});
}

void LossList::addShared(const Clip& clip, std::size_t bands, std::size_t voices)
{
    add(LossKind::bands, 0.0, clip.duration, 0.0,
        voices == 1 ? fmt::format("{} bands share {} voice", bands, voices)
                    : fmt::format("{} bands share {} voices", bands, voices));
}

void LossList::addMarkers(const Clip& clip)
{
    for (const Marker& marker : clip.markers)
        add(LossKind::text, marker.time, 0.0, 0.0, "markers are left out");
}

void LossList::addText(const Clip& clip, bool keepsName)
{
    addMarkers(clip);
    const bool losesName = !keepsName && !clip.name.empty();
    if (losesName || !clip.source.file.empty() || !clip.encoder.empty())
        add(LossKind::text, 0.0, 0.0, 0.0,
            losesName ? "the name, the source and the encoder's parameters are left out"
                      : "the source and the encoder's parameters are left out");
}

void LossList::addNoise(const Clip& clip, const std::string& message)
{
    for (const NoiseBand& band : clip.noise)
    {
        LossTrack track(LossKind::noise, !message.empty() ? message
                                                          : fmt::format("noise from {} to {} Hz is left out",
                                                                        shortDecimalText(band.lowFrequency, 0),
                                                                        shortDecimalText(band.highFrequency, 0)));
        const Curve curve = detail::overWholeTime(band.amplitude, clip.duration);
        for (std::size_t i = 1; i < curve.size(); ++i)
        {
            const double most = std::max(curve[i - 1].value, curve[i].value);
            for (const double time : {curve[i - 1].time, curve[i].time})
                track.add(time, curve[i].time > curve[i - 1].time && most > leastAmplitude ? most : 0.0);
        }
        append(track);
    }
}

void LossList::addThinned(const Curve& before, const Curve& after)
{
    LossTrack track(LossKind::points, "amplitude curve is simplified");
    forEachPlace(before, after,
                 [&](std::size_t i, const HatPlace& place)
                 {
                     const double error = std::abs(place.of(after) - before[i].value);
                     track.add(before[i].time, error > leastAmplitude ? error : 0.0);
                 });
    append(track);
}

void LossList::limit(Curve& curve, double most)
{
    LossTrack track(LossKind::amplitude, cutMessage(most));
    for (Breakpoint& point : curve)
    {
        track.add(point.time, point.value - most);
        point.value = std::min(point.value, most);
    }
    append(track);
}

void LossList::limit(std::vector<Transient>& events, double most)
{
    LossTrack track(LossKind::amplitude, cutMessage(most));
    for (Transient& event : events)
    {
        track.add(event.time, event.amplitude - most);
        event.amplitude = std::min(event.amplitude, most);
    }
    append(track);
}

void LossList::addOmitted(const std::vector<Transient>& events, const std::vector<Transient>& transients,
                          const std::string& message)
{
    auto next = transients.begin();
    for (const Transient& event : events)
    {
        while (next != transients.end() && next->time < event.time)
            ++next;
        if (next == transients.end() || next->time > event.time)
            add(LossKind::transient, event.time, 0.0, event.amplitude, message);
        else
            ++next;
    }
}

void LossList::addCrowding(const std::vector<Transient>& events, double gap)
{
    LossTrack track(LossKind::crowding,
                    fmt::format("events less than {} ms apart overlap", shortDecimalText(1000.0 * gap, 1)));
    for (std::size_t i = 1; i < events.size(); ++i)
        track.add(events[i].time, events[i].time - events[i - 1].time < gap ? events[i].amplitude : 0.0);
    append(track);
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
                                             return loss.kind != LossKind::transient && earlier.kind == loss.kind &&
                                                    earlier.message == loss.message &&
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

void addVoiceLosses(LossList& losses, const Clip& clip, const SingleVoice& voice)
{
    LossTrack bands(
        LossKind::bands,
        fmt::format("{} bands are merged into one voice; bands more than 1/3 octave away play at its frequency",
                    clip.bands.size()));
    for (const Breakpoint& point : voice.displaced)
        bands.add(point.time, point.value > leastAmplitude ? point.value : 0.0);
    losses.append(bands);
    if (std::any_of(clip.bands.begin(), clip.bands.end(), [](const Band& band) { return band.phase != 0.0; }))
        losses.add(LossKind::bands, 0.0, clip.duration, 0.0, "the initial phase of carriers is left out");
    losses.addNoise(clip, inVoice);
    addEmptyParts(losses, voice);
}

void addStrengthLosses(LossList& losses, const Clip& clip, const SingleVoice& voice)
{
    if (!clip.bands.empty())
        losses.add(LossKind::bands, 0.0, clip.duration, 0.0,
                   clip.bands.size() == 1
                       ? "only the strength of the band is kept, not the frequency"
                       : fmt::format("only the strength of {} bands is kept, not the frequency", clip.bands.size()));
    for (const Transient& event : voice.events)
        losses.add(LossKind::event, event.time, 0.0, 0.0, "events become bursts without sharpness");
    losses.addNoise(clip, inVoice);
    addEmptyParts(losses, voice);
}

void addEmptyParts(LossList& losses, const SingleVoice& voice)
{
    constexpr double shortestGap = 0.25; // s: less is the end of a decay
    const Curve& curve = voice.amplitude;
    double strongest = 0.0;
    for (const Transient& event : voice.events)
        strongest = std::max(strongest, event.amplitude);
    if (std::max(strongest, largestValue(curve)) < leastAmplitude)
        return losses.add(LossKind::empty, 0.0, voice.duration, std::max(strongest, largestValue(curve)),
                          "too weak to be felt");
    std::size_t event = 0, end = 0;
    for (std::size_t begin = 0; begin < curve.size(); begin = end + 1)
    {
        double peak = 0.0;
        for (end = begin; end < curve.size() && curve[end].value < leastAmplitude; ++end)
            peak = std::max(peak, curve[end].value);
        const double from = curve[begin].time;
        const double to = end == curve.size() ? voice.duration : end > begin ? curve[end - 1].time : from;
        while (event < voice.events.size() && voice.events[event].time < from)
            ++event;
        const bool hasEvent = event < voice.events.size() && voice.events[event].time <= to;
        if (peak > 0.0 && to - from >= shortestGap && !hasEvent)
            losses.add(LossKind::empty, from, to - from, peak, "too weak to be felt");
    }
}

} // namespace pacini
