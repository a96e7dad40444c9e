#include "io/JsonTree.h"
#include "io/formats/ImportReport.h"
#include "io/formats/JsonEntry.h"
#include "io/formats/NormalisedFrequency.h"
#include "io/formats/RootCurve.h"
#include "io/formats/ahap/AhapFormat.h"
#include "io/formats/ahap/SumLimit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <list>
#include <set>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t maxPoints = 4'000'000;

/// Time of a continuous event that does not sustain and states no decay, in s. Core Haptics has a shortest decay there
/// but does not say how long it is.
constexpr double shortestDecay = 0.01;

/// Parameters of events that say how long a part of their envelope is. Those of the whole pattern have names such as
/// HapticAttackTimeControl.
enum EnvelopeTime : std::size_t
{
    attack,
    decay,
    release
};
constexpr std::array<std::string_view, 3> envelopeTimes{"AttackTime", "DecayTime", "ReleaseTime"};
constexpr std::array<std::string_view, 3> envelopeControls{"HapticAttackTimeControl", "HapticDecayTimeControl",
                                                           "HapticReleaseTimeControl"};

struct HapticEvent
{
    double time = 0.0;
    double end = 0.0; ///< of a continuous one; at most its time: no end given
    double intensity = 1.0;
    double sharpness = 0.5;
    std::array<double, 3> times{}; ///< of a continuous one's envelope, in s
    bool sustains = true;

    [[nodiscard]] bool isEndless() const { return sustains && end <= time; }
};

double roundedTime(double time)
{
    // Sums of decimals that are the same time as another event's must be it.
    return std::min(std::round(time * 1e9) / 1e9, limits::duration);
}

/// The envelope of an event: it rises for the attack; then it holds until the event's end and falls for the release
/// after it, or falls for the decay at once.
Curve envelopeOf(const HapticEvent& event)
{
    const double top = roundedTime(event.time + event.times[attack]);
    Curve envelope{{event.time, event.times[attack] > 0.0 ? 0.0 : 1.0}};
    if (!event.sustains)
    {
        if (top > event.time)
            envelope.push_back({top, 1.0});
        envelope.push_back({roundedTime(top + std::max(event.times[decay], shortestDecay)), 0.0});
        return envelope;
    }
    if (top > event.time && top < event.end)
        envelope.push_back({top, 1.0});
    const double reached = top > event.end ? (event.end - event.time) / (top - event.time) : 1.0;
    envelope.push_back({event.end, reached});
    if (event.times[release] > 0.0)
        envelope.push_back({roundedTime(event.end + event.times[release]), 0.0});
    return envelope;
}

/// `level` times `envelope`, which has no steps. Where both move, lines stand for the parabola between them.
Curve shaped(Curve level, const Curve& envelope)
{
    for (const Breakpoint& corner : envelope)
    {
        const auto next = std::lower_bound(level.begin(), level.end(), corner.time,
                                           [](const Breakpoint& point, double time) { return point.time < time; });
        if (next != level.end() && next->time > corner.time)
            level.insert(next, {corner.time, valueAt(level, corner.time)});
    }
    Curve result;
    for (std::size_t i = 0; i < level.size(); ++i)
    {
        const Breakpoint to{level[i].time, valueAt(envelope, level[i].time)};
        if (i > 0 && to.time > level[i - 1].time)
        {
            const Breakpoint from{level[i - 1].time, valueAt(envelope, level[i - 1].time)};
            const bool bothMove = from.value != to.value && level[i - 1].value != level[i].value;
            constexpr double pieces = 8.0; // off by 1/256 of the product of both changes
            for (double k = 1.0; bothMove && k < pieces; k += 1.0)
            {
                const double part = k / pieces;
                result.push_back(
                    {from.time + part * (to.time - from.time),
                     std::lerp(level[i - 1].value, level[i].value, part) * std::lerp(from.value, to.value, part)});
            }
        }
        result.push_back({to.time, level[i].value * to.value});
    }
    return result;
}

/// All controls of one dynamic parameter, one after another, from the value it has without any.
Curve joined(std::list<Curve> controls, double initial)
{
    controls.sort([](const Curve& a, const Curve& b) { return a.front().time < b.front().time; });
    Curve curve{{0.0, initial}};
    for (const Curve& control : controls)
    {
        const double start = control.front().time;
        cutAfter(curve, start);
        if (curve.back().time < start)
            curve.push_back({start, curve.back().value});
        for (const Breakpoint& point : control)
            if (point != curve.back())
                curve.push_back(point);
    }
    return curve;
}

/// The value just before `time`: at a step its first one.
double valueBefore(const Curve& curve, double time)
{
    const auto next = std::lower_bound(curve.begin(), curve.end(), time,
                                       [](const Breakpoint& point, double t) { return point.time < t; });
    return next != curve.end() && next->time == time ? next->value : valueAt(curve, time);
}

/// The part of `curve` from `from` to `to`, with points at both ends.
Curve part(const Curve& curve, double from, double to)
{
    Curve result{{from, valueAt(curve, from)}};
    auto next = std::upper_bound(curve.begin(), curve.end(), from,
                                 [](double time, const Breakpoint& point) { return time < point.time; });
    for (; next != curve.end() && next->time < to; ++next)
        result.push_back(*next);
    result.push_back({to, valueBefore(curve, to)});
    return result;
}

class Reader
{
public:
    explicit Reader(const nlohmann::json& tree) : root(&tree, "", error) {}

    Result<ImportedClip> read()
    {
        const JsonEntry version = root.optional("Version");
        if (const double number = version.numberOrText(); number > 1.0)
            version.fail(fmt::format("is {}, but only version 1 is read", number), ErrorCode::unsupportedVersion);
        clip.name = root.optional("Metadata").optional("Project").text();
        root.required("Pattern").forEach([&](const JsonEntry& entry, std::size_t) { readEntry(entry); });
        if (!error)
            finish();
        if (error)
            return *error;
        if (auto valid = validate(clip); !valid)
            return valid.error();
        for (const std::string& what : ignored)
            warnings.push_back(what);
        return ImportedClip{std::move(clip), std::move(warnings)};
    }

private:
    void readEntry(const JsonEntry& entry)
    {
        const JsonEntry event = entry.optional("Event");
        const JsonEntry parameter = entry.optional("Parameter");
        const JsonEntry curve = entry.optional("ParameterCurve");
        // One each as a rule, but nothing of an entry is left out that has several.
        if (event.exists())
            readEvent(event);
        if (parameter.exists())
            addControl(parameter, {{timeOf(parameter), parameter.required("ParameterValue").number()}});
        if (curve.exists())
            readCurve(curve);
        if (!event.exists() && !parameter.exists() && !curve.exists())
            entry.fail("is neither an Event, a Parameter nor a ParameterCurve");
    }

    double timeOf(const JsonEntry& object) const
    {
        const JsonEntry entry = object.required("Time");
        return checkedTime(entry, entry.number());
    }

    static double checkedTime(const JsonEntry& entry, double time)
    {
        if (time < 0.0)
            entry.fail("is before 0");
        else if (time > limits::duration)
            entry.fail("is later than 24 hours", ErrorCode::tooLarge);
        return time;
    }

    /// A value moved into its range, as Core Haptics does.
    double limited(const JsonEntry& entry, double low, double high)
    {
        const double value = entry.number();
        constexpr std::size_t maxWarnings = 20;
        if ((value < low || value > high) && warnings.size() < maxWarnings)
            warnings.push_back(
                fmt::format("{}: is outside of {} to {} and is limited to this range", entry.path(), low, high));
        return std::clamp(value, low, high);
    }

    void readEvent(const JsonEntry& entry)
    {
        const std::string type = entry.required("EventType").text();
        if (type == "AudioContinuous" || type == "AudioCustom")
        {
            ignore("Pattern: audio events are not kept");
            return;
        }
        HapticEvent event;
        event.time = timeOf(entry);
        const JsonEntry duration = entry.optional("EventDuration");
        event.end = checkedTime(duration, std::round((event.time + std::max(duration.number(), 0.0)) * 1e9) / 1e9);
        if (duration.number() < 0.0)
            duration.fail("is below 0");
        const bool hasEnvelope = type == "HapticContinuous";
        entry.optional("EventParameters")
            .forEach([&](const JsonEntry& parameter, std::size_t) { readParameter(parameter, hasEnvelope, event); });
        if (event.times[event.sustains ? decay : release] > 0.0)
            ignore("Pattern: DecayTime of events that sustain and ReleaseTime of those that do not have no "
                   "effect in Core Haptics and are not kept");
        if (type == "HapticTransient")
            transients.push_back(event);
        else if (type == "HapticContinuous")
            continuous.push_back(event);
        else if (!type.empty())
            entry.optional("EventType").fail("is no type of event: '" + shownText(type) + "'");
    }

    void ignore(std::string warning) { ignored.insert(std::move(warning)); }
    void ignoreParameter(std::string_view id)
    {
        ignore(fmt::format("Pattern: the parameter {} is not kept", shownText(id)));
    }

    void readParameter(const JsonEntry& parameter, bool hasEnvelope, HapticEvent& event)
    {
        const JsonEntry value = parameter.required("ParameterValue");
        const std::string id = parameter.required("ParameterID").text();
        if (id == "HapticIntensity")
            event.intensity = limited(value, 0.0, 1.0);
        else if (id == "HapticSharpness")
            event.sharpness = limited(value, 0.0, 1.0);
        else if (const auto part = std::find(envelopeTimes.begin(), envelopeTimes.end(), id);
                 hasEnvelope && part != envelopeTimes.end())
            event.times[static_cast<std::size_t>(part - envelopeTimes.begin())] = limited(value, 0.0, 1.0);
        else if (hasEnvelope && id == "Sustained")
            event.sustains = limited(value, 0.0, 1.0) >= 0.5;
        else if (!id.empty() && (value.number() != 0.0 || id == "Sustained") &&
                 !(id == "Sustained" && value.number() == 1.0))
            ignoreParameter(id);
    }

    void readCurve(const JsonEntry& entry)
    {
        const double start = timeOf(entry);
        Curve points;
        double before = 0.0;
        entry.required("ParameterCurveControlPoints")
            .forEach(
                [&](const JsonEntry& point, std::size_t)
                {
                    const JsonEntry offset = point.required("Time");
                    const double relative = checkedTime(offset, offset.number());
                    checkedTime(offset, start + relative);
                    if (relative < before)
                        offset.fail("is earlier than the point before it");
                    before = relative;
                    points.push_back({roundedTime(start + relative), point.required("ParameterValue").number()});
                });
        if (points.empty() && !error)
            return entry.optional("ParameterCurveControlPoints").fail("has no point");
        addControl(entry, std::move(points));
    }

    /// `points` may still have values outside of what the parameter can be.
    void addControl(const JsonEntry& entry, Curve points)
    {
        const std::string id = entry.required("ParameterID").text();
        if (error)
            return;
        const bool intensity = id == "HapticIntensityControl";
        std::list<Curve>* const controls = intensity                        ? &intensityControls
                                           : id == "HapticSharpnessControl" ? &sharpnessControls
                                                                            : timeControlsOf(id);
        if (controls == nullptr)
        {
            ignoreParameter(id);
            return;
        }
        const double low = intensity ? 0.0 : -1.0;
        for (Breakpoint& point : points)
        {
            if (point.value < low || point.value > 1.0)
                ignored.insert(
                    fmt::format("Pattern: values of {} outside of {} to 1 are limited to this range", id, low));
            point.value = std::clamp(point.value, low, 1.0);
        }
        pointCount += points.size();
        if (pointCount > maxPoints)
            return entry.fail("is beyond 4 million points", ErrorCode::tooLarge);
        controls->push_back(std::move(points));
    }

    /// The controls of the envelopes' part that `id` names; null when it names none.
    std::list<Curve>* timeControlsOf(std::string_view id)
    {
        for (std::size_t part = 0; part < envelopeControls.size(); ++part)
            if (id == envelopeControls[part])
                return &timeControls[part];
        return nullptr;
    }

    void finish()
    {
        const Curve intensity = joined(std::move(intensityControls), 1.0);
        const Curve sharpness = joined(std::move(sharpnessControls), 0.0);
        const auto earlier = [](const HapticEvent& a, const HapticEvent& b)
        {
            return a.time < b.time;
        };
        transients.sort(earlier);
        continuous.sort(earlier);
        CurveReader scale(intensity), shift(sharpness);
        for (const HapticEvent& event : transients)
        {
            const double strength = event.intensity * scale.at(event.time);
            clip.transients.push_back(
                {event.time, strength * strength, std::clamp(event.sharpness + shift.at(event.time), 0.0, 1.0)});
            clip.duration = std::max(clip.duration, event.time);
        }
        std::array<Curve, 3> times;
        for (std::size_t part = 0; part < times.size(); ++part)
            times[part] = joined(std::move(timeControls[part]), 0.0);
        for (HapticEvent& event : continuous)
            if (!event.isEndless())
                finishEnvelope(event, times);
        clip.duration = std::max({clip.duration, intensity.back().time, sharpness.back().time});
        lastUntilSounded(clip);
        const double patternEnd = clip.duration;
        for (HapticEvent& event : continuous)
        {
            if (event.isEndless())
            {
                ignore("Pattern: continuous events without a duration last to the end of the pattern, but at "
                       "most 30 s");
                const double latest = std::min(event.time + longestAhapEvent, limits::duration);
                event.end = event.time < patternEnd ? std::min(patternEnd, latest) : latest;
                finishEnvelope(event, times);
            }
            addContinuous(event, intensity, sharpness);
            if (error)
                return;
        }
        for (Band& band : clip.bands)
            if (band.amplitude.back().time < clip.duration)
                band.amplitude.push_back({band.amplitude.back().time, 0.0});
        const auto limited = limitSum(clip.bands, 1.0, maxPoints);
        if (!limited)
            return root.optional("Pattern").fail(limited.error().message, limited.error().code);
        if (*limited)
            ignore("Pattern: continuous events that sound together are weaker where they add up to more than "
                   "full drive");
    }

    /// Adds what the controls say to the times of the envelope, and lets the clip last until the event has sounded.
    void finishEnvelope(HapticEvent& event, const std::array<Curve, 3>& controls)
    {
        for (std::size_t part = 0; part < controls.size(); ++part)
        {
            const double when = part == release ? event.end : event.time;
            event.times[part] = std::clamp(event.times[part] + valueAt(controls[part], when), 0.0, 1.0);
        }
        if (event.times[attack] > 0.0 || event.times[event.sustains ? release : decay] > 0.0)
            ignore("Pattern: AttackTime, DecayTime and ReleaseTime are read as seconds, since Apple does not "
                   "say how long they are on a phone");
        clip.duration = std::max({clip.duration, event.end, envelopeOf(event).back().time});
    }

    /// The first band that is silent by then goes on with the event.
    void addContinuous(const HapticEvent& event, const Curve& intensity, const Curve& sharpness)
    {
        constexpr double touching = 1e-6; // s; times are written with six decimals
        auto band = std::find_if(clip.bands.begin(), clip.bands.end(),
                                 [&](const Band& b) { return b.amplitude.back().time <= event.time + touching; });
        if (band == clip.bands.end())
        {
            if (clip.bands.size() == limits::bands)
                return root.optional("Pattern").fail("has more than 256 continuous events at a time",
                                                     ErrorCode::tooLarge);
            const NormalisedRange& range = sharpnessRange;
            clip.bands.push_back(
                {range.low, range.hertzOf(0.5), range.high, static_cast<int>(clip.bands.size()), {}, {}});
            band = std::prev(clip.bands.end());
        }
        const Curve envelope = envelopeOf(event);
        Curve level = shaped(part(intensity, event.time, envelope.back().time), envelope);
        Curve pitch = part(sharpness, event.time, envelope.back().time);
        for (Breakpoint& point : level)
            point.value *= event.intensity;
        for (Breakpoint& point : pitch)
            point.value = sharpnessRange.hertzOf(std::clamp(event.sharpness + point.value, 0.0, 1.0));
        level = squareOf(level);
        pointCount += level.size() + pitch.size();
        if (pointCount > maxPoints)
            return root.optional("Pattern").fail("is beyond 4 million points", ErrorCode::tooLarge);
        const bool goesOn = !band->amplitude.empty() && band->amplitude.back().time >= event.time - touching;
        if (!goesOn)
        {
            if (!band->amplitude.empty())
                band->amplitude.push_back({band->amplitude.back().time, 0.0});
            if (event.time > 0.0)
                band->amplitude.push_back({event.time, 0.0});
        }
        append(band->amplitude, level, 1e-4);
        append(band->pitch, pitch, 0.1);
    }

    /// Where the curves meet, two points that differ only by rounding are one.
    static void append(Curve& curve, const Curve& more, double rounding)
    {
        for (Breakpoint point : more)
        {
            if (!curve.empty())
                point.time = std::max(point.time, curve.back().time);
            if (curve.empty() || point.time > curve.back().time ||
                std::abs(point.value - curve.back().value) > rounding)
                curve.push_back(point);
        }
    }

    std::optional<Error> error;
    JsonEntry root;
    Clip clip;
    std::list<HapticEvent> transients, continuous;
    std::list<Curve> intensityControls, sharpnessControls;
    std::array<std::list<Curve>, 3> timeControls;
    std::size_t pointCount = 0;
    std::set<std::string> ignored; ///< warnings that are given once
    std::vector<std::string> warnings;
};
} // namespace

bool isAhap(std::string_view bytes)
{
    return bytes.find("\"Pattern\"") != std::string_view::npos &&
           (bytes.find("\"Event\"") != std::string_view::npos ||
            bytes.find("\"ParameterCurve\"") != std::string_view::npos ||
            bytes.find("\"Version\"") != std::string_view::npos);
}

Result<ImportedClip> readAhap(std::string_view text)
{
    const auto tree = readJsonTree(text, largestAhapText);
    if (!tree)
        return tree.error();
    return Reader(*tree).read();
}

} // namespace pacini
