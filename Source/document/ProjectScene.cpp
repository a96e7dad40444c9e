#include "document/ProjectScene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace pacini
{

namespace
{
/// Whether a parameter goes in straight lines between points.
bool glides(SceneParameter parameter)
{
    return parameter != SceneParameter::transposition && parameter != SceneParameter::stretch;
}
} // namespace

Result<void> validate(const ProjectScene& scene)
{
    const auto wrong = [](std::string where, const char* what)
    {
        return Error{ErrorCode::invalidArgument, std::move(where), what};
    };
    if (scene.actuators < 1 || scene.actuators > limits::actuators)
        return wrong("actuators", "must be 1 to 16");
    if (scene.parts.size() > limits::plays)
        return wrong("parts", "has more than 10000 parts");
    for (std::size_t i = 0; i < scene.parts.size(); ++i)
    {
        const ScenePart& part = scene.parts[i];
        const std::string where = fmt::format("parts[{}]", i);
        if (part.clip < 1)
            return wrong(where + ".clipId", "must be 1 or more");
        if (part.track < 0 || part.track >= static_cast<int>(limits::plays))
            return wrong(where + ".track", "must be 0 to 9999");
        if (!(part.start >= 0.0 && part.start <= limits::duration))
            return wrong(where + ".start", "must be 0 s to 24 hours");
        for (const auto& [parameter, value, name] :
             {std::tuple(SceneParameter::gain, part.gain, ".gain"),
              {SceneParameter::pan, part.pan, ".pan"},
              {SceneParameter::transposition, part.transposition, ".transposition"},
              {SceneParameter::delay, part.delay, ".delay"}})
            if (!inRange(parameter, value))
                return wrong(where + name, "is out of its range");
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

BuiltScene sceneOf(const Project& project)
{
    BuiltScene built;
    Scene& scene = built.scene;
    scene.actuators = project.scene.actuators;
    scene.panLaw = project.scene.panLaw;
    std::map<int, std::size_t> places; // of clips in the scene, by id
    for (std::size_t i = 0; i < project.scene.parts.size(); ++i)
    {
        const ScenePart& part = project.scene.parts[i];
        const auto item = project.find(part.clip);
        if (!item)
            continue;
        const auto [place, isNew] = places.try_emplace(part.clip, scene.clips.size());
        if (isNew)
            scene.clips.push_back(*item->clip);
        ScenePlay play;
        play.name = fmt::format("{} {}", item->clip->name.empty() ? "clip" : item->clip->name, i + 1);
        play.clip = place->second;
        play.start = part.start;
        play.gain = part.gain;
        play.pan = part.pan;
        play.transposition = part.transposition;
        play.delay = part.delay;
        play.priority = part.priority;
        double begin = part.start + part.delay; // when the clip is heard to begin
        for (const SceneCurve& curve : part.curves)
            if (curve.parameter == SceneParameter::delay && !curve.points.empty())
                begin = part.start + curve.points.front().value;
        for (const SceneCurve& curve : part.curves)
        {
            if (curve.points.empty())
                continue;
            double& begins = curve.parameter == SceneParameter::gain            ? play.gain
                             : curve.parameter == SceneParameter::pan           ? play.pan
                             : curve.parameter == SceneParameter::delay         ? play.delay
                             : curve.parameter == SceneParameter::transposition ? play.transposition
                             : curve.parameter == SceneParameter::stretch       ? play.stretch
                             : curve.parameter == SceneParameter::tones         ? play.tones
                             : curve.parameter == SceneParameter::events        ? play.events
                                                                                : play.noise;
            begins = curve.points.front().value;
            for (std::size_t p = 1; p < curve.points.size(); ++p)
            {
                const Breakpoint& from = curve.points[p - 1];
                const Breakpoint& to = curve.points[p];
                const bool line = glides(curve.parameter);
                if (line && from.value == to.value)
                    continue;
                scene.changes.push_back({begin + (line ? from.time : to.time), scene.plays.size(), curve.parameter,
                                         to.value, line ? to.time - from.time : 0.0});
            }
        }
        scene.plays.push_back(std::move(play));
        built.parts.push_back(i);
    }
    std::stable_sort(scene.changes.begin(), scene.changes.end(),
                     [](const SceneChange& a, const SceneChange& b) { return a.time < b.time; });
    return built;
}

} // namespace pacini
