#include "io/formats/ForeignText.h"
#include "io/formats/LossList.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/haptic/HapticFormat.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace pacini
{

namespace
{
struct Emphasis
{
    float amplitude = 0.0f;
    float sharpness = 0.0f;
};

struct Point
{
    float time = 0.0f;
    float value = 0.0f;
    std::optional<Emphasis> emphasis;
};

/// Rounding keeps order and limits, as floats have 0 and 1.
std::vector<Point> rounded(const Curve& curve)
{
    std::vector<Point> points;
    points.reserve(curve.size());
    for (const Breakpoint& point : curve)
        points.push_back({static_cast<float>(point.time), static_cast<float>(std::clamp(point.value, 0.0, 1.0)), {}});
    return points;
}

/// Puts each event on a point of its time. Events at a step go to its first side that is not above them; where there
/// are more events than points, points are doubled.
void attach(std::vector<Point>& points, const std::vector<Transient>& events, LossList& losses)
{
    LossTrack raised(LossKind::event, "events are raised to the surrounding amplitude");
    std::vector<Point> result;
    result.reserve(points.size());
    std::size_t next = 0;
    for (std::size_t i = 0; i < points.size();)
    {
        const float time = points[i].time;
        std::vector<Point> here;
        for (; i < points.size() && points[i].time == time; ++i)
            here.push_back(points[i]);
        std::size_t end = next;
        while (end < events.size() && static_cast<float>(events[end].time) <= time)
            ++end;
        while (here.size() < end - next)
            here.push_back(here.back());
        std::size_t from = 0;
        for (; next < end; ++next)
        {
            const Transient& event = events[next];
            Emphasis emphasis{static_cast<float>(std::clamp(event.amplitude, 0.0, 1.0)),
                              static_cast<float>(std::clamp(event.sharpness, 0.0, 1.0))};
            // The last point that leaves one for each event to come.
            const std::size_t last = here.size() - (end - next);
            std::size_t at = from;
            while (at < last && here[at].value > emphasis.amplitude)
                ++at;
            if (here[at].value > emphasis.amplitude)
                at = from;
            const double lift = static_cast<double>(here[at].value) - static_cast<double>(emphasis.amplitude);
            raised.add(event.time, lift > leastAmplitude ? lift : 0.0);
            emphasis.amplitude = std::max(emphasis.amplitude, here[at].value);
            here[at].emphasis = emphasis;
            from = at + 1;
        }
        result.insert(result.end(), here.begin(), here.end());
    }
    points = std::move(result);
    losses.append(raised);
}

std::string textOf(const NormalisedVoice& voice, const std::string& source, const std::vector<Point>& amplitude,
                   const std::vector<Point>& frequency)
{
    std::string text = fmt::format("{{\n"
                                   "  \"version\": {{\"major\": 1, \"minor\": 0, \"patch\": 0}},\n"
                                   "  \"metadata\": {{\"editor\": \"Pacini\", \"author\": \"\", \"source\": {}, "
                                   "\"project\": {}, \"tags\": [], \"description\": \"\"}},\n"
                                   "  \"signals\": {{\"continuous\": {{\"envelopes\": {{\n"
                                   "    \"amplitude\": [\n",
                                   inQuotes(source), inQuotes(voice.name));
    auto out = std::back_inserter(text);
    for (const Point& point : amplitude)
    {
        fmt::format_to(out, FMT_COMPILE("      {{\"time\": {}, \"amplitude\": {}"), point.time, point.value);
        if (point.emphasis)
            fmt::format_to(out, FMT_COMPILE(", \"emphasis\": {{\"amplitude\": {}, \"frequency\": {}}}"),
                           point.emphasis->amplitude, point.emphasis->sharpness);
        text += &point == &amplitude.back() ? "}\n" : "},\n";
    }
    text += "    ],\n    \"frequency\": [\n";
    for (const Point& point : frequency)
    {
        fmt::format_to(out, FMT_COMPILE("      {{\"time\": {}, \"frequency\": {}}}"), point.time, point.value);
        text += &point == &frequency.back() ? "\n" : ",\n";
    }
    text += "    ]\n  }}}\n}\n";
    return text;
}

/// Where floats are coarse.
void addTimeLoss(const NormalisedVoice& voice, LossList& losses)
{
    constexpr double visible = 1e-4; // s
    LossTrack track(LossKind::timeStep, "times are rounded to 32-bit floats, which are coarse here");
    for (const Breakpoint& point : voice.level)
    {
        const double error = std::abs(static_cast<double>(static_cast<float>(point.time)) - point.time);
        track.add(point.time, error > visible ? error : 0.0);
    }
    losses.append(track);
}
} // namespace

Result<ExportedClip> writeHaptic(const Clip& clip, const ExportParams& params)
{
    if (auto valid = validate(clip); !valid)
        return valid.error();
    // An emphasis of the same power begins and ends at once, so more of it is felt: with 0.85 of its amplitude, and a
    // point beside that of each event, thirty recordings gain 0.9 points of HTS on a player of .haptic.
    const VoiceFormat format{.range = questRange, .events = questPlayer, .pointsPerEvent = 1.0, .eventLevel = 0.85};
    NormalisedVoice voice = normalisedVoice(clip, params, format);
    addTimeLoss(voice, voice.losses);
    voice.losses.addCrowding(voice.events, questPlayer.crispLength);
    std::vector<Point> amplitude = rounded(voice.level);
    attach(amplitude, voice.events, voice.losses);
    return oneFile(textOf(voice, clip.source.file, amplitude, rounded(voice.frequency)), std::move(voice.losses));
}

} // namespace pacini
