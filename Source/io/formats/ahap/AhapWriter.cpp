#include "io/JsonText.h"
#include "io/formats/LossList.h"
#include "io/formats/NormalisedFrequency.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/ahap/AhapFormat.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t maxControlPoints = 16; // of a curve; the last is the first of the next
constexpr double neutral = 0.5;              // sharpness of the continuous events, to which curves add
constexpr double transientLength = 0.015;    // s in which a transient needs its curve
constexpr double transientPeriods = 2.0;     // of a sine, as MPEG's reference software plays a transient
constexpr double resolved = 0.01;            // s: taps nearer than this are one for the skin
constexpr double ducking = 0.15;             // gain of the voice under a transient that stands for it: see formats.md
constexpr double lead = 0.001;               // s before it, for players that round times to floats
constexpr double shortestSection = 0.001;    // s; shorter ones become part of their neighbour: rounded to a duration
                                             // of 0 they would have no end

/// Six decimals are a microsecond, and 1/4000 of the steps that players tell apart.
double rounded(double value)
{
    return std::round(value * 1e6) / 1e6;
}

/// A section of continuous vibration, with its intensity multiplied by the curve.
struct Section
{
    double from = 0.0;
    double to = 0.0;
    double intensity = 1.0; ///< 0: there is none
};

struct Pattern
{
    std::vector<Section> sections;
    Curve intensity;
    Curve sharpness; ///< added to `base`; empty where the frequency stays
    double base = neutral;
    std::vector<Transient> transients; ///< as the file has them
};

/// Points of `curve` from `from` to `to`, with both ends.
Curve between(const Curve& curve, double from, double to)
{
    Curve result{{from, valueAt(curve, from)}};
    for (auto next = std::upper_bound(curve.begin(), curve.end(), from,
                                      [](double time, const Breakpoint&point) { return time < point.time; });
         next != curve.end() && next->time <= to; ++next)
        result.push_back(*next);
    if (result.back().time < to)
        result.push_back({to, valueAt(curve, to)});
    return result;
}

double peakOf(const Curve& curve)
{
    double peak = 0.0;
    for (const Breakpoint& point : curve)
        peak = std::max(peak, point.value);
    return peak;
}

void add(Curve& curve, const Breakpoint& point)
{
    if (curve.empty() || curve.back() != point)
        curve.push_back(point);
}

/// Continuous vibration from `from` to `to` under the curve as it is.
void addPlain(Pattern& pattern, const Curve& level, double from, double to)
{
    if (to <= from)
        return;
    const Curve points = between(level, from, to);
    pattern.sections.push_back({from, to, peakOf(points) > 0.0 ? 1.0 : 0.0});
    for (const Breakpoint& point : points)
        add(pattern.intensity, point);
}

/// The time of transients that need the curve at `need` or above, with the level at `gain` times what it is.
void addRaised(Pattern& pattern, const Curve& level, double from, double to, double need, double gain,
               LossTrack& raised)
{
    Curve points = between(level, from, to);
    for (Breakpoint& point : points)
        point.value *= gain;
    const double peak = rounded(peakOf(points));
    if (to > from)
        pattern.sections.push_back({from, to, peak > leastAmplitude ? peak : 0.0});
    for (const Breakpoint& point : points)
    {
        const double kept = peak > leastAmplitude ? std::max(point.value / peak, need) : 1.0;
        add(pattern.intensity, {point.time, std::min(kept, 1.0)});
        const double sounds = peak > leastAmplitude ? peak * kept : 0.0;
        const double error = std::abs(sounds * sounds - point.value * point.value);
        raised.add(point.time, error > leastAmplitude ? error : 0.0);
    }
}

/// The curves of a voice and, unless they have a file of their own, its events compensated for them. While an event
/// plays the voice has the gain `duck`.
Pattern patternOf(const NormalisedVoice& voice, bool split, double duck, LossList& losses)
{
    Pattern pattern;
    const auto [lowest, highest] =
        std::minmax_element(voice.frequency.begin(), voice.frequency.end(),
                            [](const Breakpoint& a, const Breakpoint& b) { return a.value < b.value; });
    if (highest->value - lowest->value < 1e-6 || peakOf(voice.level) <= 0.0)
        pattern.base = lowest->value;
    else
        for (const Breakpoint& point : voice.frequency)
            pattern.sharpness.push_back({point.time, point.value - neutral});
    pattern.transients = voice.events;
    if (split && duck == 1.0)
    {
        addPlain(pattern, voice.level, 0.0, voice.duration);
        return pattern;
    }

    LossTrack raised(LossKind::event, "the curve is raised around events so that it does not weaken them");
    LossTrack shifted(LossKind::event, "sharpness too far from the curve for one file");
    double done = 0.0;
    for (std::size_t i = 0; i < voice.events.size();)
    {
        // Events too near to each other to have curves of their own share one.
        const double first = voice.events[i].time;
        double last = first;
        double need = 0.0, length = transientLength;
        for (; i < voice.events.size() && voice.events[i].time <= last + 2.0 * lead; ++i)
        {
            last = voice.events[i].time;
            if (!split)
                need = std::max(need, voice.events[i].amplitude);
            if (duck < 1.0)
                length = transientPeriods / sharpnessRange.hertzOf(voice.events[i].sharpness);
        }
        const double next = i < voice.events.size() ? voice.events[i].time - lead : voice.duration;
        double from = std::max(split ? first : first - lead, done);
        double end = std::min(last + length, next);
        if (from - done < shortestSection)
            from = done;
        if (next - end < shortestSection)
            end = next;
        addPlain(pattern, voice.level, done, from);
        addRaised(pattern, voice.level, from, end, need, std::sqrt(duck), raised);
        done = end;
    }
    addPlain(pattern, voice.level, done, voice.duration);
    if (split)
        return pattern;
    for (Transient& event : pattern.transients)
    {
        const double curve = valueAt(pattern.intensity, event.time);
        const double strength = event.amplitude;
        event.amplitude = curve > 0.0 ? std::min(strength / curve, 1.0) : 1.0;
        const double weaker = std::abs(std::pow(event.amplitude * curve, 2.0) - strength * strength);
        raised.add(event.time, weaker > leastAmplitude ? weaker : 0.0);
        const double shift = valueAt(pattern.sharpness, event.time);
        const double wanted = event.sharpness - shift;
        event.sharpness = std::clamp(wanted, 0.0, 1.0);
        shifted.add(event.time, std::abs(wanted - event.sharpness) > leastAmplitude ? event.amplitude : 0.0);
    }
    losses.append(raised);
    losses.append(shifted);
    return pattern;
}

/// Builds the text of a file entry by entry.
class Writer
{
public:
    explicit Writer(const std::string& name)
    {
        text = fmt::format("{{\n  \"Version\": 1.0,\n  \"Metadata\": {{\"Project\": {}, \"Created By\": \"Pacini\"}},\n"
                           "  \"Pattern\": [",
                           inQuotes(name));
    }

    void transient(const Transient& event)
    {
        begin();
        fmt::format_to(out(), FMT_COMPILE("{{\"Event\": {{\"Time\": {}, \"EventType\": \"HapticTransient\", "),
                       rounded(event.time));
        parameters(event.amplitude, event.sharpness);
    }

    void continuous(double from, double to, double intensity, double sharpness)
    {
        begin();
        fmt::format_to(out(),
                       FMT_COMPILE("{{\"Event\": {{\"Time\": {}, \"EventType\": \"HapticContinuous\", "
                                   "\"EventDuration\": {}, "),
                       rounded(from), rounded(rounded(to) - rounded(from)));
        parameters(intensity, sharpness);
    }

    /// A curve as curves of at most 16 points, whose times count from the first of each.
    void curve(const char* id, const Curve& points)
    {
        for (std::size_t first = 0; first + 1 < points.size(); first += maxControlPoints - 1)
        {
            const std::size_t last = std::min(first + maxControlPoints, points.size());
            const double start = rounded(points[first].time);
            begin();
            fmt::format_to(out(),
                           FMT_COMPILE("{{\"ParameterCurve\": {{\"ParameterID\": \"{}\", \"Time\": {}, "
                                       "\"ParameterCurveControlPoints\": ["),
                           id, start);
            for (std::size_t i = first; i < last; ++i)
                fmt::format_to(out(), FMT_COMPILE("{}{{\"Time\": {}, \"ParameterValue\": {}}}"), i == first ? "" : ", ",
                               rounded(rounded(points[i].time) - start), rounded(points[i].value));
            text += "]}}";
        }
    }

    std::string finish()
    {
        text += empty ? "]\n}\n" : "\n  ]\n}\n";
        return std::move(text);
    }

private:
    std::back_insert_iterator<std::string> out() { return std::back_inserter(text); }

    void begin()
    {
        text += empty ? "\n    " : ",\n    ";
        empty = false;
    }

    void parameters(double intensity, double sharpness)
    {
        fmt::format_to(out(),
                       FMT_COMPILE("\"EventParameters\": [{{\"ParameterID\": \"HapticIntensity\", "
                                   "\"ParameterValue\": {}}}, {{\"ParameterID\": \"HapticSharpness\", "
                                   "\"ParameterValue\": {}}}]}}}}"),
                       rounded(intensity), rounded(sharpness));
    }

    std::string text;
    bool empty = true;
};

/// The continuous events of the sections: neighbours of one intensity are one, none is longer than 30 s.
void writeContinuous(Writer& writer, const Pattern& pattern)
{
    for (std::size_t i = 0; i < pattern.sections.size();)
    {
        Section joined = pattern.sections[i++];
        while (i < pattern.sections.size() && pattern.sections[i].intensity == joined.intensity)
            joined.to = pattern.sections[i++].to;
        if (joined.intensity <= 0.0)
            continue;
        // Equal parts: what is left after the last whole 30 s may be too short.
        const double from = rounded(joined.from), to = rounded(joined.to);
        const double parts = std::max(1.0, std::ceil((to - from) / longestAhapEvent));
        const auto at = [&](double k)
        {
            return from + (to - from) * k / parts;
        };
        for (double k = 0.0; k < parts; k += 1.0)
            writer.continuous(at(k), at(k + 1.0), joined.intensity, pattern.base);
    }
}
} // namespace

Result<ExportedClip> writeAhap(const Clip& clip, const ExportParams& params)
{
    if (auto valid = validate(clip); !valid)
        return valid.error();
    // Players play transients on top of the voice: the file has to make room for those that stand for it.
    EmphasisPlayer player{.range = sharpnessRange};
    if (params.events.value_or(usualEvents) == EventExport::transients)
    {
        player.ducking = ducking;
        player.separation = resolved;
        player.periods = transientPeriods;
    }
    NormalisedVoice voice =
        normalisedVoice(clip, params, {.scale = LevelScale::root, .range = sharpnessRange, .events = player});
    voice.losses.addCrowding(voice.events, resolved);
    const double duck = voice.wasSingle ? 1.0 : player.ducking;
    // A file without continuous vibration has no curves that its events would have to be kept from.
    const bool split = params.split && !voice.events.empty() && peakOf(voice.level) > 0.0;
    const Pattern pattern = patternOf(voice, split, duck, voice.losses);
    ExportedClip result;
    Writer main(voice.name);
    writeContinuous(main, pattern);
    const bool sounds = std::any_of(pattern.sections.begin(), pattern.sections.end(),
                                    [](const Section& section) { return section.intensity > 0.0; });
    if (sounds)
    {
        main.curve("HapticIntensityControl", pattern.intensity);
        main.curve("HapticSharpnessControl", pattern.sharpness);
    }
    Writer second(voice.name);
    for (const Transient& event : pattern.transients)
        (split ? second : main).transient(event);
    result.files.push_back({"", main.finish()});
    if (split)
        result.files.push_back({std::string(ahapTransients), second.finish()});
    result.losses = std::move(voice.losses).sorted();
    return result;
}

} // namespace pacini
