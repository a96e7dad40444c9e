#include "cli/SceneReport.h"

#include "cli/Console.h"
#include "io/SceneFields.h"

#include <pacini/clip/Clip.h>
#include <pacini/synthesis/SceneTimeline.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

constexpr std::size_t maxListed = 20;

std::string_view lawName(PanLaw law)
{
    return nameOf(law, sceneFields::panLaws);
}

std::vector<std::size_t> playCounts(const Scene& scene)
{
    std::vector<std::size_t> counts(scene.clips.size(), 0);
    for (const ScenePlay& play : scene.plays)
        ++counts[play.clip];
    return counts;
}

/// Whether nothing but textures play as long as the clip, which has nothing of its own.
bool isLengthOfTextures(const Scene& scene, std::size_t clip)
{
    std::size_t textures = 0;
    for (const ScenePlay& play : scene.plays)
        if (play.clip == clip && !play.texture)
            return false;
        else if (play.clip == clip)
            ++textures;
    return textures > 0 && isSilent(scene.clips[clip]);
}

std::string counted(std::size_t count, std::string_view one)
{
    return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::string quoted(const std::string& name)
{
    return name.empty() ? "" : " \"" + printable(name) + "\"";
}

std::string clipText(std::size_t i, const Clip& clip, std::size_t plays)
{
    return fmt::format("  clips[{}]{}: {}, {}, {}; {}\n", i, quoted(clip.name), durationText(clip.duration),
                       counted(clip.bands.size(), "band"), counted(clip.transients.size(), "transient"),
                       plays == 0 ? "not played" : "played " + counted(plays, "time"));
}

std::string playText(const TimedPlay& timed, const Scene& scene)
{
    const ScenePlay& play = scene.plays[timed.play];
    const std::string what =
        play.texture ? fmt::format("textures[{}]{}", *play.texture, quoted(scene.textures[*play.texture].name))
                     : fmt::format("clips[{}]{}", play.clip, quoted(scene.clips[play.clip].name));
    std::string text = fmt::format("  plays[{}]{}: {}, {:.3f} to {:.3f} s", timed.play, quoted(play.name), what,
                                   timed.start, timed.end);
    if (play.loop > 0.0)
        text += fmt::format(", loops {:.3f} s{}", play.loop,
                            play.passes > 0 ? " " + counted(play.passes, "time") : std::string());
    if (play.gain != 0.0)
        text += fmt::format(", {:+g} dB", play.gain);
    if (scene.actuators > 1)
        text += fmt::format(", pan {:g}", play.pan);
    if (play.delay != 0.0)
        text += fmt::format(", {:g} ms late", 1e3 * play.delay);
    if (play.transposition != 0.0)
        text += fmt::format(", {:+g} semitones", play.transposition);
    if (play.stretch != 1.0)
        text += fmt::format(", stretched {:g} times", play.stretch);
    for (const Role role : allRoles)
        if (const double level = roleLevel(play, role); level != 0.0)
            text += fmt::format(", {} {:+g} dB", nameOf(role), level);
    if (play.variation.amount > 0.0)
        text += fmt::format(", varied by {:g}", play.variation.amount);
    if (timed.changes > 0)
        text += ", " + counted(timed.changes, "change");
    return text + "\n";
}

/// The first lines of a list, and the number of the others.
template <typename Line>
void appendList(std::string& text, std::size_t count, std::string_view one, Line line)
{
    for (std::size_t i = 0; i < std::min(count, maxListed); ++i)
        text += line(i);
    if (count > maxListed)
        text += fmt::format("  and {} more\n", counted(count - maxListed, one));
}
} // namespace

nlohmann::ordered_json sceneReport(const Scene& scene)
{
    const SceneTimeline timeline = timelineOf(scene);
    const auto counts = playCounts(scene);
    Json clips = Json::array(), plays = Json::array();
    for (std::size_t i = 0; i < scene.clips.size(); ++i)
    {
        const Clip& clip = scene.clips[i];
        clips.push_back({{"name", clip.name},
                         {"duration", clip.duration},
                         {"bands", clip.bands.size()},
                         {"breakpoints", breakpointCount(clip)},
                         {"transients", clip.transients.size()},
                         {"plays", counts[i]}});
    }
    for (const TimedPlay& timed : timeline.plays)
    {
        const ScenePlay& play = scene.plays[timed.play];
        plays.push_back({{"name", play.name},
                         {"clip", play.clip},
                         {"start", timed.start},
                         {"end", timed.end},
                         {"loop", play.loop},
                         {"passes", play.passes},
                         {"gain", play.gain},
                         {"pan", play.pan},
                         {"delay", play.delay},
                         {"transposition", play.transposition},
                         {"stretch", play.stretch},
                         {"tones", play.tones},
                         {"events", play.events},
                         {"noise", play.noise},
                         {"priority", play.priority},
                         {"changes", timed.changes}});
        if (play.texture)
            plays.back().update({{"texture", *play.texture}, {"speed", play.speed}, {"force", play.force}});
    }
    return {{"kind", "scene"},
            {"format", "scene"},
            {"name", scene.name},
            {"duration", timeline.duration},
            {"gain", scene.gain},
            {"actuators", scene.actuators},
            {"panLaw", lawName(scene.panLaw)},
            {"clips", clips},
            {"plays", plays},
            {"changes", scene.changes.size()}};
}

std::string sceneText(const std::string& file, const Scene& scene)
{
    const SceneTimeline timeline = timelineOf(scene);
    const auto counts = playCounts(scene);
    std::string text =
        fmt::format("{}: scene{}, {}\n", printable(file), quoted(scene.name), durationText(timeline.duration));
    text += fmt::format("  actuators     {}{}\n", scene.actuators,
                        scene.actuators > 1 ? fmt::format(", panned by {}", lawName(scene.panLaw)) : "");
    if (scene.gain != 0.0)
        text += fmt::format("  gain          {:+g} dB\n", scene.gain);
    if (!scene.textures.empty())
        text += fmt::format("  textures      {}\n", scene.textures.size());
    std::vector<std::size_t> clips;
    for (std::size_t i = 0; i < scene.clips.size(); ++i)
        if (!isLengthOfTextures(scene, i))
            clips.push_back(i);
    if (scene.textures.empty() || !clips.empty())
        text += fmt::format("  clips         {}\n", clips.size());
    text += fmt::format("  plays         {}\n  changes       {}\n", scene.plays.size(), scene.changes.size());
    appendList(text, scene.textures.size(), "texture",
               [&](std::size_t i)
               {
                   const Texture& texture = scene.textures[i];
                   return fmt::format("  textures[{}]{}: {}, {}\n", i, quoted(texture.name),
                                      counted(texture.nodes.size(), "speed"), counted(texture.tones.size(), "tone"));
               });
    appendList(text, clips.size(), "clip",
               [&](std::size_t i) { return clipText(clips[i], scene.clips[clips[i]], counts[clips[i]]); });
    appendList(text, scene.plays.size(), "play", [&](std::size_t i) { return playText(timeline.plays[i], scene); });
    text.pop_back();
    return text;
}

} // namespace pacini::cli
