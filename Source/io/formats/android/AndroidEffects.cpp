#include "io/formats/android/AndroidEffects.h"

#include "io/formats/ForeignText.h"
#include "io/formats/NormalisedFrequency.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/android/AndroidWaveform.h"
#include "io/formats/android/EnvelopeFit.h"

#include <pacini/foundation/NumberText.h>
#include <pacini/synthesis/TransientPulse.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

namespace pacini
{

namespace
{
constexpr double steepest = 0.020;   // s: a segment that every device plays
constexpr double usualPoints = 60.0; // per second

struct Peaks
{
    Curve amplitude; ///< the voice with events as peaks
    Curve frequency; ///< Hz at the top of each
};

/// Events as peaks as long as the pulse that the decoder plays, with its frequency at the top. Peaks of the 20 ms that
/// every device plays to each side lost up to 16 points of HTS in fast trains, peaks at the voice's frequency up to 10.
/// Peaks that meet share their valley.
Peaks withPeaks(const SingleVoice& voice)
{
    Peaks peaks{voice.amplitude, {}};
    Curve& curve = peaks.amplitude;
    for (std::size_t i = 0; i < voice.events.size(); ++i)
    {
        const Transient& event = voice.events[i];
        const double last = i > 0 ? voice.events[i - 1].time : -limits::duration;
        const double next = i + 1 < voice.events.size() ? voice.events[i + 1].time : limits::duration;
        constexpr double fs = 48000.0;
        const Pulse pulse = makePulse({}, event.sharpness, std::min(event.time - last, next - event.time), fs, 1.0);
        const double from = event.time;
        const double to =
            std::min({event.time + static_cast<double>(pulse.frames) / fs, 0.5 * (event.time + next), voice.duration});
        const double top = 0.5 * (from + to);
        const double level = std::min(std::hypot(valueAt(voice.amplitude, top), event.amplitude), 1.0);
        const Breakpoint before{from, valueAt(curve, from)}, after{to, valueAt(voice.amplitude, to)};
        std::erase_if(curve, [&](const Breakpoint& point) { return point.time >= from && point.time <= to; });
        const auto place = std::upper_bound(curve.begin(), curve.end(), from,
                                            [](double t, const Breakpoint& point) { return t < point.time; });
        curve.insert(place, {before, {top, level}, after});
        peaks.frequency.push_back({top, pulse.cyclesPerFrame * fs});
    }
    return peaks;
}

struct Target
{
    double amplitude = 0.0, frequency = 0.0;
};

/// Both curves at the ms at which either bends; a step takes one ms.
std::map<std::int64_t, Target> targetsOf(const Peaks& peaks, const Curve& frequency, bool keepsPoints)
{
    std::map<std::int64_t, Target> targets;
    std::int64_t last = -1;
    for (const Breakpoint& point : peaks.amplitude)
    {
        const std::int64_t tick = std::max(androidTick(point.time), last + 1);
        targets[tick] = {point.value, valueAt(frequency, point.time)};
        last = tick;
    }
    const std::int64_t room = keepsPoints ? 1 : androidTick(steepest);
    for (const Breakpoint& point : frequency)
    {
        const std::int64_t tick = androidTick(point.time);
        const auto next = targets.lower_bound(tick);
        if ((next == targets.end() || next->first >= tick + room) &&
            (next == targets.begin() || std::prev(next)->first + room <= tick))
            targets[tick] = {valueAt(peaks.amplitude, point.time), point.value};
    }
    for (const Breakpoint& top : peaks.frequency)
        if (const auto at = targets.find(androidTick(top.time)); at != targets.end())
            at->second.frequency = top.value;
    return targets;
}

/// Nodes from 0 to 0; none is nearer than 1 ms.
std::vector<EnvelopeNode> nodesOf(const std::map<std::int64_t, Target>& targets, std::int64_t end)
{
    std::vector<EnvelopeNode> nodes{{0, 0.0, targets.begin()->second.frequency}};
    for (const auto& [tick, target] : targets)
        if (tick > 0 || target.amplitude > 0.0)
            nodes.push_back({std::max(tick, nodes.back().tick + 1), target.amplitude, target.frequency});
    if (nodes.back().amplitude > 0.0 || nodes.size() == 1)
        nodes.push_back({std::max(end, nodes.back().tick + 1), 0.0, nodes.back().frequency});
    return nodes;
}

double largestRounding(const SingleVoice& voice)
{
    double worst = 0.0;
    const auto look = [&](double time)
    {
        worst = std::max(worst, std::abs(androidTime(androidTick(time)) - time));
    };
    for (const Breakpoint& point : voice.amplitude)
        look(point.time);
    for (const Transient& event : voice.events)
        look(event.time);
    return worst;
}
} // namespace

namespace
{
/// The voice from which all effects are made, and its losses.
struct AndroidVoice
{
    SingleVoice voice;
    LossList losses;
    bool keepsPoints = false;
};

AndroidVoice androidVoiceOf(const Clip& clip, const ExportParams& params, const char* events)
{
    auto [voice, losses] = reducedVoice(clip, params, androidMotorFrequency);
    losses.limit(voice.events, 1.0);
    losses.addCrowding(voice.events, 2.0 * steepest);
    for (const Transient& event : voice.events)
        losses.add(LossKind::event, event.time, 0.0, 0.0, events);
    return {std::move(voice), std::move(losses), isSingleVoice(clip) && !params.amplitudePoints};
}

void addRounding(LossList& losses, const SingleVoice& voice)
{
    if (const double moved = largestRounding(voice); moved > 1e-9)
        losses.add(LossKind::timeStep, 0.0, voice.duration, moved, "times are rounded to milliseconds");
}

/// The nodes of the voice, thinned to what is asked for or usual.
std::vector<EnvelopeNode> nodesOf(AndroidVoice& android, const ExportParams& params)
{
    SingleVoice& voice = android.voice;
    if (!android.keepsPoints)
    {
        const Curve before = voice.amplitude;
        voice.amplitude = thinned(voice.amplitude, params.amplitudePoints.value_or(usualPoints), voice.duration);
        voice.frequency = thinned(voice.frequency, params.frequencyPoints.value_or(20.0), voice.duration);
        android.losses.addThinned(before, voice.amplitude);
    }
    const auto targets = targetsOf(withPeaks(voice), voice.frequency, android.keepsPoints);
    return nodesOf(targets, std::max<std::int64_t>(1, androidTick(voice.duration)));
}

/// The nodes within limits.
Result<std::vector<EnvelopeNode>> limitedNodes(const std::vector<EnvelopeNode>& nodes, const EnvelopeLimits& limits,
                                               LossList& losses)
{
    auto fitted = fittedNodes(nodes, limits);
    if (fitted)
        addFitLosses(losses, nodes, *fitted);
    return fitted;
}

/// The same envelope with sharpness in the place of Hz.
AndroidEnvelope basicOf(AndroidEnvelope envelope, const ExportParams& params, double duration, LossList& losses)
{
    const NormalisedRange range = normalisedRangeOf(params.profile, sharpnessRange);
    double bent = 0.0;
    const auto sharpnessOf = [&](double hertz)
    {
        const double sharpness = range.normalisedOf(hertz);
        bent = std::max(bent, std::abs(std::log2(range.hertzOf(sharpness) / hertz)));
        return sharpness;
    };
    envelope.initialFrequency = sharpnessOf(envelope.initialFrequency);
    for (AndroidPoint& point : envelope.points)
        point.frequency = sharpnessOf(point.frequency);
    if (bent > 1e-9)
        losses.add(LossKind::frequency, 0.0, duration, bent,
                   fmt::format("basic envelope: frequencies are limited to {} to {} Hz", shortDecimalText(range.low, 0),
                               shortDecimalText(range.high, 0)));
    return envelope;
}

/// What not every device plays.
void addDeviceLosses(LossList& losses, const std::vector<AndroidPoint>& points, double duration)
{
    constexpr std::size_t advised = 16;
    if (points.size() > advised)
        losses.add(
            LossKind::points, 0.0, duration, 0.0,
            fmt::format("envelopes: {} control points; devices may support only 16 at once, Android splits the effect",
                        points.size()));
    std::int64_t at = 0;
    for (const AndroidPoint& point : points)
    {
        if (androidTime(point.duration) < steepest - 1e-9)
            losses.add(LossKind::crowding, androidTime(at), androidTime(point.duration), 0.0,
                       "envelopes: segments of less than 20 ms, which some devices do not play");
        at += point.duration;
    }
}
} // namespace

Result<AndroidExport> androidEffectsOf(const Clip& clip, const ExportParams& params)
{
    auto android = androidVoiceOf(clip, params, "events become bursts in the waveform and peaks in the envelopes");
    auto& [voice, losses, keepsPoints] = android;
    AndroidExport result;
    result.effects.waveform = androidWaveformOf(voice, params.amplitudePoints, keepsPoints);
    addStepLosses(losses, voice, result.effects.waveform);
    addRounding(losses, voice);
    losses.add(LossKind::frequency, 0.0, voice.duration, 0.0, "waveform: no frequency");

    auto nodes = nodesOf(android, params);
    if (params.envelope)
    {
        auto fitted = limitedNodes(nodes, *params.envelope, losses);
        if (!fitted)
            return fitted.error();
        nodes = std::move(*fitted);
    }
    result.effects.envelope = envelopeThrough(nodes, params.envelope.value_or(EnvelopeLimits()).longest);
    result.effects.basic = basicOf(result.effects.envelope, params, voice.duration, losses);
    addDeviceLosses(losses, result.effects.envelope.points, voice.duration);
    result.losses = std::move(losses);
    return result;
}

Result<AndroidEnvelopeExport> androidEnvelopeOf(const Clip& clip, const ExportParams& params, bool isBasic)
{
    auto android = androidVoiceOf(clip, params, "events become peaks");
    LossList& losses = android.losses;
    const double duration = android.voice.duration;
    addRounding(losses, android.voice);
    auto nodes = nodesOf(android, params);
    if (params.envelope || !android.keepsPoints)
    {
        auto fitted = limitedNodes(nodes, params.envelope.value_or(EnvelopeLimits()), losses);
        if (!fitted)
            return fitted.error();
        nodes = std::move(*fitted);
    }
    AndroidEnvelope envelope = envelopeThrough(nodes, params.envelope.value_or(EnvelopeLimits()).longest);
    addDeviceLosses(losses, envelope.points, duration);
    if (isBasic)
        envelope = basicOf(std::move(envelope), params, duration, losses);
    else if (!params.profile)
        losses.add(LossKind::frequency, 0.0, duration, 0.0,
                   "waveform envelope: Android rejects frequencies outside the device's range; a profile sets it");
    return AndroidEnvelopeExport{std::move(envelope), std::move(losses)};
}

Clip clipOfWaveform(const std::vector<AndroidStep>& steps)
{
    SingleVoice voice;
    std::int64_t at = 0;
    for (const AndroidStep& step : steps)
    {
        const double level = step.amplitude / 255.0;
        voice.amplitude.push_back({androidTime(at), level});
        at += step.duration;
        voice.amplitude.push_back({androidTime(at), level});
    }
    voice.duration = androidTime(at);
    voice.frequency = {{0.0, androidMotorFrequency}};
    return clipOfVoice(std::move(voice));
}

Clip clipOfEnvelope(const AndroidEnvelope& envelope, bool isBasic)
{
    const auto hertz = [&](double said)
    {
        return isBasic ? sharpnessRange.hertzOf(said) : said;
    };
    SingleVoice voice;
    std::int64_t at = 0;
    voice.amplitude = {{0.0, 0.0}};
    voice.frequency = {{0.0, hertz(envelope.initialFrequency)}};
    for (const AndroidPoint& point : envelope.points)
    {
        at += point.duration;
        voice.amplitude.push_back({androidTime(at), point.amplitude});
        voice.frequency.push_back({androidTime(at), hertz(point.frequency)});
    }
    voice.duration = androidTime(at);
    return clipOfVoice(std::move(voice));
}

} // namespace pacini
