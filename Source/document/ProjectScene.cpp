#include "document/ProjectScene.h"

#include "io/SceneFields.h"

#include <pacini/foundation/Units.h>
#include <pacini/synthesis/CompilePlan.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace pacini
{

namespace
{
/// Whether a parameter goes in straight lines between points.
bool glides(SceneParameter parameter) noexcept
{
    return parameter != SceneParameter::transposition && parameter != SceneParameter::stretch;
}

/// Whether a parameter is in dB, of which the gain goes in straight lines.
bool isLevel(SceneParameter parameter) noexcept
{
    return parameter == SceneParameter::gain || roleOf(parameter).has_value();
}

const Curve* curveOf(const ScenePart& part, SceneParameter parameter)
{
    for (const SceneCurve& curve : part.curves)
        if (curve.parameter == parameter && !curve.points.empty())
            return &curve.points;
    return nullptr;
}

double firstValue(const ScenePart& part, SceneParameter parameter)
{
    const Curve* curve = curveOf(part, parameter);
    return curve != nullptr ? curve->front().value : valueOf(part.play, parameter);
}

/// s of the scene: when the clip of a part is heard to begin.
double beginOf(const ScenePart& part)
{
    return part.play.start + firstValue(part, SceneParameter::delay);
}

/// s that `content` s of a clip last.
double stretched(const ScenePart& part, double content)
{
    const Curve* curve = curveOf(part, SceneParameter::stretch);
    double time = 0.0, ratio = firstValue(part, SceneParameter::stretch);
    for (std::size_t i = 1; curve != nullptr && i < curve->size() && content > 0.0; ++i)
    {
        const double until = std::min((*curve)[i].time - time, content * ratio);
        time += until;
        content -= until / ratio;
        ratio = (*curve)[i].value;
    }
    return time + std::max(0.0, content) * ratio;
}

/// s of the clip that a part plays, of a loop without end one pass.
double contentOf(const ScenePart& part, const Clip& clip)
{
    const double loop = std::min(part.play.loop, clip.duration);
    if (loop <= 0.0)
        return clip.duration;
    return loop * static_cast<double>(std::max<std::size_t>(1, part.play.passes));
}

bool isEndless(const ScenePart& part)
{
    return part.play.loop > 0.0 && part.play.passes == 0;
}

/// Where a parameter is between two points.
double between(SceneParameter parameter, Breakpoint from, Breakpoint to, double time) noexcept
{
    if (time >= to.time)
        return to.value;
    if (time <= from.time || !glides(parameter))
        return from.value;
    const double x = (time - from.time) / (to.time - from.time);
    if (!isLevel(parameter))
        return from.value + (to.value - from.value) * x;
    const double gain = sceneGain(from.value) + (sceneGain(to.value) - sceneGain(from.value)) * x;
    return gain > 0.0 ? std::max(limits::silentGain, Decibels::fromGain(gain).value) : limits::silentGain;
}

/// The points of one parameter's changes, in s from `begin`; a single one where nothing changes afterwards.
Curve pointsOf(const std::vector<SceneChange>& changes, double initial, double begin)
{
    Curve points;
    Breakpoint left{-std::numeric_limits<double>::infinity(), initial}, reached = left;
    for (const SceneChange& change : changes)
    {
        const double from = change.time - begin;
        const double to = glides(change.parameter) ? from + change.glide : from;
        const double now = between(change.parameter, left, reached, from);
        left = {from, now};
        reached = {to, change.value};
        while (!points.empty() && points.back().time > from) // it does not come to its end
            points.pop_back();
        if (points.empty() || points.back().time < from || points.back().value != now)
            points.push_back({from, now});
        points.push_back({to, change.value});
    }
    // What was changed before the beginning is how it begins.
    const auto heard = std::find_if(points.begin(), points.end(), [](const Breakpoint& p) { return p.time > 0.0; });
    if (heard != points.begin())
    {
        const Breakpoint before = *(heard - 1);
        const double start =
            heard == points.end() ? before.value : between(changes.front().parameter, before, *heard, 0.0);
        points.erase(points.begin(), heard);
        points.insert(points.begin(), {0.0, start});
    }
    return points;
}

/// A clip without any content, which lasts.
Clip silentClip(const std::string& name, double duration)
{
    Clip clip;
    clip.name = name;
    clip.duration = duration;
    return clip;
}

/// s by which a play is late when it is heard to begin: then its delay is what has passed since its start.
double delayAtBegin(const std::vector<SceneChange>& changes, double initial, double start)
{
    if (changes.empty())
        return initial;
    double low = 0.0, high = limits::playDelay;
    for (int i = 0; i < 50; ++i)
    {
        const double delay = 0.5 * (low + high);
        (pointsOf(changes, initial, start + delay).front().value > delay ? low : high) = delay;
    }
    return 0.5 * (low + high);
}
} // namespace

double& valueOf(ScenePlay& play, SceneParameter parameter) noexcept
{
    switch (parameter)
    {
    case SceneParameter::pan:
        return play.pan;
    case SceneParameter::delay:
        return play.delay;
    case SceneParameter::transposition:
        return play.transposition;
    case SceneParameter::stretch:
        return play.stretch;
    case SceneParameter::tones:
        return play.tones;
    case SceneParameter::events:
        return play.events;
    case SceneParameter::noise:
        return play.noise;
    case SceneParameter::speed:
        return play.speed;
    case SceneParameter::force:
        return play.force;
    case SceneParameter::gain:
        break;
    }
    return play.gain;
}

double valueOf(const ScenePlay& play, SceneParameter parameter) noexcept
{
    return valueOf(const_cast<ScenePlay&>(play), parameter); // which changes nothing
}

Result<void> validate(const ProjectScene& scene)
{
    const auto wrong = [](std::string where, const char* what)
    {
        return Error{ErrorCode::invalidArgument, std::move(where), what};
    };
    if (!(scene.duration >= 0.0 && scene.duration <= limits::duration))
        return wrong("duration", "must be 0 s to 24 hours");
    if (!inRange(SceneParameter::gain, scene.gain))
        return wrong("gain", "must be -1000 to 60 dB");
    if (!(scene.panDelay >= 0.0 && scene.panDelay <= 0.1))
        return wrong("panDelay", "must be 0 to 0.1 s");
    if (scene.actuators < 1 || scene.actuators > limits::actuators)
        return wrong("actuators", "must be 1 to 16");
    if (scene.textures.size() > limits::sceneTextures)
        return wrong("textures", "has more than 1000 textures");
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
        if (auto valid = validate(*scene.textures[i].content); !valid)
            return Error{valid.error().code, fmt::format("textures[{}].{}", i, valid.error().where),
                         valid.error().message};
    if (scene.parts.size() > limits::plays)
        return wrong("parts", "has more than 10000 parts");
    for (std::size_t i = 0; i < scene.parts.size(); ++i)
    {
        const ScenePart& part = scene.parts[i];
        const ScenePlay& play = part.play;
        const std::string where = fmt::format("parts[{}]", i);
        if (part.clip < 1)
            return wrong(where + ".clipId", "must be 1 or more");
        if (play.texture && *play.texture >= scene.textures.size())
            return wrong(where + ".texture", "is not one of the scene's textures");
        if (part.track < 0 || part.track >= static_cast<int>(limits::plays))
            return wrong(where + ".track", "must be 0 to 9999");
        if (!(play.start >= 0.0 && play.start <= limits::duration))
            return wrong(where + ".start", "must be 0 s to 24 hours");
        if (play.loop != 0.0 && !(play.loop >= limits::shortestLoop && play.loop <= limits::duration))
            return wrong(where + ".loop", "must be 0 (play once) or 0.005 s and longer");
        if (!(play.variation.amount >= 0.0 && play.variation.amount <= 1.0))
            return wrong(where + ".variation", "must be 0 to 1");
        for (const auto& [name, parameter] : sceneFields::parameters)
            if (!inRange(parameter, valueOf(play, parameter)))
                return wrong(fmt::format("{}.{}", where, name), "is out of its range");
        for (std::size_t k = 0; k < part.curves.size(); ++k)
        {
            const SceneCurve& curve = part.curves[k];
            const std::string place = fmt::format("{}.curves[{}]", where, k);
            for (std::size_t other = 0; other < k; ++other)
                if (part.curves[other].parameter == curve.parameter)
                    return wrong(place + ".parameter", "has a curve already");
            double before = 0.0;
            for (std::size_t p = 0; p < curve.points.size(); ++p)
            {
                const Breakpoint& point = curve.points[p];
                const std::string at = fmt::format("{}.points[{}]", place, p);
                if (!(point.time >= before && point.time <= limits::duration))
                    return wrong(at + ".time", "must be in order, from 0 s to 24 hours");
                if (!inRange(curve.parameter, point.value))
                    return wrong(at + ".value", "is out of its range");
                before = point.time;
            }
        }
    }
    return {};
}

double valueAt(SceneParameter parameter, const Curve& points, double time) noexcept
{
    const auto after = std::upper_bound(points.begin(), points.end(), time,
                                        [](double at, const Breakpoint& point) { return at < point.time; });
    if (after == points.begin())
        return points.front().value;
    if (after == points.end())
        return points.back().value;
    return between(parameter, *(after - 1), *after, time);
}

double sceneEnd(const Project& project)
{
    if (project.scene.duration > 0.0)
        return project.scene.duration;
    double end = 0.0;
    for (const ScenePart& part : project.scene.parts)
        if (const auto item = project.find(part.clip))
            end = std::max(end, beginOf(part) + stretched(part, contentOf(part, *item->clip)));
    return end;
}

double lengthOf(const Project& project, const ScenePart& part)
{
    const auto item = project.find(part.clip);
    if (!item)
        return 0.0;
    const double once = stretched(part, contentOf(part, *item->clip));
    return isEndless(part) ? std::max(once, sceneEnd(project) - beginOf(part)) : once;
}

BuiltScene sceneOf(const Project& project)
{
    BuiltScene built;
    Scene& scene = built.scene;
    scene.name = project.scene.name;
    scene.duration = project.scene.duration;
    scene.gain = project.scene.gain;
    scene.actuators = project.scene.actuators;
    scene.panLaw = project.scene.panLaw;
    scene.panDelay = project.scene.panDelay;
    for (const SceneTexture& texture : project.scene.textures)
        scene.textures.push_back(*texture.content);
    std::map<std::pair<int, bool>, std::size_t> places; // of clips in the scene, by id and whether they are silenced
    for (std::size_t i = 0; i < project.scene.parts.size(); ++i)
    {
        const ScenePart& part = project.scene.parts[i];
        const auto item = project.find(part.clip);
        if (!item)
            continue;
        const bool silenced = part.play.texture && !isSilent(*item->clip); // a texture plays instead of its clip
        const auto [place, isNew] = places.try_emplace({part.clip, silenced}, scene.clips.size());
        if (isNew)
            scene.clips.push_back(silenced ? silentClip(item->clip->name, item->clip->duration) : *item->clip);
        ScenePlay play = part.play;
        play.clip = place->second;
        if (play.name.empty())
        {
            const std::string& name = play.texture ? scene.textures[*play.texture].name : item->clip->name;
            play.name = fmt::format("{} {}", !name.empty() ? name : play.texture ? "texture" : "clip", i + 1);
        }
        play.loop = std::min(play.loop, item->clip->duration);
        if (play.loop < limits::shortestLoop)
            play.loop = 0.0;
        if (isEndless(part) && scene.duration == 0.0)
            scene.duration = sceneEnd(project);
        const double begin = beginOf(part);
        for (const SceneCurve& curve : part.curves)
        {
            if (curve.points.empty())
                continue;
            valueOf(play, curve.parameter) = curve.points.front().value;
            for (std::size_t p = 1; p < curve.points.size(); ++p)
            {
                const Breakpoint& from = curve.points[p - 1];
                const Breakpoint& to = curve.points[p];
                const bool line = glides(curve.parameter);
                if (line && from.value == to.value)
                    continue;
                // Pitches and speeds are the clip's, which is late as a whole; levels and places are the actuators'.
                scene.changes.push_back({line ? begin + from.time : part.play.start + to.time, scene.plays.size(),
                                         curve.parameter, to.value, line ? to.time - from.time : 0.0});
            }
        }
        scene.plays.push_back(std::move(play));
        built.parts.push_back(i);
    }
    std::stable_sort(scene.changes.begin(), scene.changes.end(),
                     [](const SceneChange& a, const SceneChange& b) { return a.time < b.time; });
    return built;
}

ProjectScene projectSceneOf(const Scene& scene, const std::vector<int>& clipIds)
{
    ProjectScene made;
    made.name = scene.name;
    made.duration = scene.duration;
    made.gain = scene.gain;
    made.actuators = scene.actuators;
    made.panLaw = scene.panLaw;
    made.panDelay = scene.panDelay;
    for (const Texture& texture : scene.textures)
        made.textures.push_back({std::make_shared<const Texture>(texture)});
    std::vector<std::map<SceneParameter, std::vector<SceneChange>>> changes(scene.plays.size());
    for (const SceneChange& change : scene.changes)
        changes[change.play][change.parameter].push_back(change);
    std::vector<double> trackEnds;
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
    {
        ScenePart part;
        part.play = scene.plays[i];
        const Clip& clip = scene.clips[part.play.clip];
        part.clip = clipIds[part.play.clip];
        part.play.clip = 0;
        if (part.play.loop >= clip.duration)
            part.play.loop = limits::duration; // all of it, also when it is edited
        const double begin =
            part.play.start + delayAtBegin(changes[i][SceneParameter::delay], part.play.delay, part.play.start);
        for (const auto& [parameter, ofParameter] : changes[i])
        {
            Curve points =
                pointsOf(ofParameter, valueOf(part.play, parameter), glides(parameter) ? begin : part.play.start);
            if (points.size() > 1)
                part.curves.push_back({parameter, std::move(points)});
            else if (!points.empty())
                valueOf(part.play, parameter) = points.front().value;
        }
        const double end = isEndless(part) ? std::numeric_limits<double>::infinity()
                                           : beginOf(part) + stretched(part, contentOf(part, clip));
        const auto track =
            std::find_if(trackEnds.begin(), trackEnds.end(), [&](double taken) { return taken <= part.play.start; });
        part.track = static_cast<int>(track - trackEnds.begin());
        if (track == trackEnds.end())
            trackEnds.push_back(end);
        else
            *track = end;
        made.parts.push_back(std::move(part));
    }
    return made;
}

namespace
{
/// The part that "plays[3]" or "plays[3].bands[1]" is of.
std::optional<std::size_t> partOf(const std::string& where, const BuiltScene& built)
{
    constexpr std::string_view plays = "plays[";
    std::size_t index = 0;
    if (!where.starts_with(plays) ||
        std::from_chars(where.data() + plays.size(), where.data() + where.size(), index).ec != std::errc() ||
        index >= built.parts.size())
        return {};
    return built.parts[index];
}
} // namespace

Result<SceneForecast> forecast(const BuiltScene& built, const Profile* profile, double strength)
{
    CompileParams params;
    params.sampleRate = 48000.0;
    params.adaptation.strength = strength;
    const auto planned = compilePlan(built.scene, profile, params);
    if (!planned)
        return planned.error();
    SceneForecast result;
    result.error = planned->predictedError;
    result.duration = planned->duration;
    for (const LeftOut& one : planned->leftOut)
        if (const auto part = partOf(one.where, built))
        {
            if (one.isWholePlay())
                result.leftOut[*part] = one.reason;
            else
                ++result.bands;
        }
    return result;
}

} // namespace pacini
