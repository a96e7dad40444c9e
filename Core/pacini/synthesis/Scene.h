#pragma once

// A scene: clips that play together, with changes over time. A plain value; validate() states the rules.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/PanLaw.h>
#include <pacini/synthesis/Roles.h>
#include <pacini/synthesis/Variation.h>
#include <pacini/texture/Texture.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// One clip that plays, or a texture.
struct ScenePlay
{
    std::string name;
    std::size_t clip = 0;                          ///< index into the scene's clips
    double start = 0.0;                            ///< s
    double loop = 0.0;                             ///< s of the clip that are repeated; 0 plays it once
    std::size_t passes = 0;                        ///< how often a loop is played; 0 = until the scene ends
    double gain = 0.0;                             ///< dB; silent at -120 and below
    double pan = 0.5;                              ///< 0 = first actuator, 1 = last
    double transposition = 0.0;                    ///< semitones
    double stretch = 1.0;                          ///< 2 = twice as long
    int priority = 0;                              ///< 0 is kept longest when voices run out
    VariationParams variation;                     ///< every pass of a loop has a new variation
    double delay = 0.0;                            ///< delay after its start, s, 0 to 1
    double tones = 0.0, events = 0.0, noise = 0.0; ///< dB, levels of the roles of its clip; silent at -120 and below
    std::optional<std::size_t> texture = {}; ///< index into the scene's textures; sounds as long as its clip, which is
                                             ///< silent then; pitch and variation are without effect but for the seed
    double speed = 0.5, force = 1.0;         ///< 0 to 1, of the texture
    bool operator==(const ScenePlay&) const = default;
};

/// Parameter of a play that can change over time.
enum class SceneParameter
{
    gain,          ///< dB
    pan,           ///< 0-1
    delay,         ///< s, 0 to 1; while it glides, pitches bend as they do when a source moves
    transposition, ///< semitones
    stretch,
    tones, ///< dB, as are the next two: levels of the roles of its clip
    events,
    noise,
    speed, ///< 0 to 1, as is the next: of the texture
    force
};

/// The role whose level a parameter is, if it is one.
[[nodiscard]] constexpr std::optional<Role> roleOf(SceneParameter parameter) noexcept
{
    switch (parameter)
    {
    case SceneParameter::tones:
        return Role::tones;
    case SceneParameter::events:
        return Role::events;
    case SceneParameter::noise:
        return Role::noise;
    case SceneParameter::gain:
    case SceneParameter::pan:
    case SceneParameter::delay:
    case SceneParameter::transposition:
    case SceneParameter::stretch:
    case SceneParameter::speed:
    case SceneParameter::force:
        break;
    }
    return {};
}

/// The initial level of a role in a play, dB.
[[nodiscard]] inline double roleLevel(const ScenePlay& play, Role role) noexcept
{
    return role == Role::tones ? play.tones : role == Role::events ? play.events : play.noise;
}

/// Automation event: a parameter of a play that changes while it plays. Levels, pan, delay, speed and force glide in a
/// straight line; transposition and stretch step.
struct SceneChange
{
    double time = 0.0;    ///< s of the scene
    std::size_t play = 0; ///< index into the scene's plays
    SceneParameter parameter = SceneParameter::gain;
    double value = 0.0;
    double glide = 0.005; ///< s until a level, pan or delay is reached
    bool operator==(const SceneChange&) const = default;
};

/// Clips, their plays and changes over time.
struct Scene
{
    std::string name;
    double duration = 0.0; ///< s; 0 = until the last play ends
    double gain = 0.0;     ///< dB
    int actuators = 1;     ///< 1-16 channels of output
    PanLaw panLaw = PanLaw::constantPower;
    double panDelay = 0.01; ///< delay of an actuator at the other end, s, for delay panning
    std::vector<Clip> clips;
    std::vector<ScenePlay> plays;
    std::vector<SceneChange> changes;   ///< in order of time
    std::vector<Texture> textures = {}; ///< of plays
    bool operator==(const Scene&) const = default;
};

/// Returns a scene that plays a clip once, unchanged.
[[nodiscard]] inline Scene sceneOf(Clip clip)
{
    Scene scene;
    scene.clips.push_back(std::move(clip));
    scene.plays.push_back({});
    return scene;
}

namespace limits
{
inline constexpr std::size_t plays = 10'000;
inline constexpr std::size_t sceneChanges = 1'000'000;
inline constexpr std::size_t sceneTextures = 1'000;
inline constexpr double shortestLoop = 0.005; ///< s
inline constexpr int actuators = 16;
inline constexpr double silentGain = -120.0; ///< dB
inline constexpr double playDelay = 1.0;     ///< s
} // namespace limits

/// The linear gain of a scene's gain in dB.
[[nodiscard]] inline double sceneGain(double dB) noexcept
{
    return dB <= limits::silentGain ? 0.0 : portable::exp10(dB / 20.0);
}

/// Range of a parameter, and its text.
struct ParameterRange
{
    const char* name;
    double low, high;
    const char* rule;
};

/// In the order of SceneParameter.
inline constexpr std::array<ParameterRange, 10> parameterRanges{
    {{"gain", -1000.0, 60.0, "must be -1000 to 60 dB"},
     {"pan", 0.0, 1.0, "must be 0 to 1"},
     {"delay", 0.0, limits::playDelay, "must be 0 to 1 s"},
     {"transposition", -96.0, 96.0, "must be -96 to 96 semitones"},
     {"stretch", 0.01, 100.0, "must be 0.01 to 100"},
     {"tones", -1000.0, 60.0, "must be -1000 to 60 dB"},
     {"events", -1000.0, 60.0, "must be -1000 to 60 dB"},
     {"noise", -1000.0, 60.0, "must be -1000 to 60 dB"},
     {"speed", 0.0, 1.0, "must be 0 to 1"},
     {"force", 0.0, 1.0, "must be 0 to 1"}}};

/// Whether a value is one that a parameter takes.
[[nodiscard]] inline bool inRange(SceneParameter parameter, double value) noexcept
{
    const auto i = static_cast<std::size_t>(parameter);
    return i < parameterRanges.size() && value >= parameterRanges[i].low && value <= parameterRanges[i].high;
}

/// Whether a clip has nothing that sounds.
[[nodiscard]] inline bool isSilent(const Clip& clip) noexcept
{
    return std::none_of(allRoles.begin(), allRoles.end(), [&](Role role) { return hasRole(clip, role); });
}

namespace detail
{
/// Checks the variable values of a play, at its start and in its changes.
inline Result<void> checkParameters(const Scene& scene)
{
    const auto outside = [](std::size_t parameter, const std::string& where)
    {
        return brokenRule(where + parameterRanges[parameter].name, parameterRanges[parameter].rule);
    };
    if (!inRange(SceneParameter::gain, scene.gain))
        return outside(0, "");
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
    {
        const ScenePlay& play = scene.plays[i];
        const double values[] = {play.gain,  play.pan,    play.delay, play.transposition, play.stretch,
                                 play.tones, play.events, play.noise, play.speed,         play.force};
        for (std::size_t k = 0; k < std::size(values); ++k)
            if (!inRange(static_cast<SceneParameter>(k), values[k]))
                return outside(k, indexed("plays", i) + ".");
    }
    for (std::size_t i = 0; i < scene.changes.size(); ++i)
        if (const SceneChange& change = scene.changes[i]; !inRange(change.parameter, change.value))
            return brokenRule(indexed("changes", i) + ".value",
                              parameterRanges[static_cast<std::size_t>(change.parameter)].rule);
    return {};
}
} // namespace detail

/// Checks a scene, its clips included; errors name the place, such as `plays[3].clip`.
[[nodiscard]] inline Result<void> validate(const Scene& scene)
{
    using namespace detail;
    if (auto r = checkParameters(scene); !r)
        return r;
    if (auto r = checkNumber(scene.duration, 0.0, limits::duration, "duration"); !r)
        return r;
    if (scene.actuators < 1 || scene.actuators > limits::actuators)
        return brokenRule("actuators", "must be 1 to 16");
    if (auto r = checkNumber(scene.panDelay, 0.0, 0.1, "panDelay"); !r)
        return r;
    if (scene.plays.size() > limits::plays)
        return brokenRule("plays", "has more than 10000 plays", ErrorCode::tooLarge);
    for (std::size_t i = 0; i < scene.clips.size(); ++i)
        if (auto r = validate(scene.clips[i]); !r)
            return brokenRule(indexed("clips", i) + "." + r.error().where, r.error().message, r.error().code);
    if (scene.textures.size() > limits::sceneTextures)
        return brokenRule("textures", "has more than 1000 textures", ErrorCode::tooLarge);
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
        if (auto r = validate(scene.textures[i]); !r)
            return brokenRule(indexed("textures", i) + "." + r.error().where, r.error().message, r.error().code);
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
    {
        const ScenePlay& play = scene.plays[i];
        const std::string where = indexed("plays", i);
        if (play.texture && *play.texture >= scene.textures.size())
            return brokenRule(where + ".texture",
                              "is not one of the scene's " + std::to_string(scene.textures.size()) + " textures");
        if (play.clip >= scene.clips.size())
            return brokenRule(where + ".clip",
                              "is not one of the scene's " + std::to_string(scene.clips.size()) + " clips");
        if (play.texture && !isSilent(scene.clips[play.clip]))
            return brokenRule(where + ".texture", "plays instead of a clip; use two plays");
        if (auto r = checkNumber(play.start, 0.0, limits::duration, where + ".start"); !r)
            return r;
        if (play.loop != 0.0 && !(play.loop >= limits::shortestLoop && play.loop <= limits::duration))
            return brokenRule(where + ".loop", "must be 0 (play once) or 0.005 s and longer");
        if (play.loop > scene.clips[play.clip].duration)
            return brokenRule(where + ".loop", "is longer than the clip");
        if (play.loop > 0.0 && play.passes == 0 && scene.duration == 0.0)
            return brokenRule(where + ".passes", "is needed, or a duration of the scene: the loop would never end");
        if (auto r = checkNumber(play.variation.amount, 0.0, 1.0, where + ".variation"); !r)
            return r;
    }
    if (scene.changes.size() > limits::sceneChanges)
        return brokenRule("changes", "has more than 1000000 changes", ErrorCode::tooLarge);
    double before = 0.0;
    for (std::size_t i = 0; i < scene.changes.size(); ++i)
    {
        const SceneChange& change = scene.changes[i];
        const std::string where = indexed("changes", i);
        if (auto r = checkNumber(change.time, 0.0, limits::duration, where + ".time"); !r)
            return r;
        if (change.time < before)
            return brokenRule(where + ".time", "is earlier than the change before it");
        before = change.time;
        if (change.play >= scene.plays.size())
            return brokenRule(where + ".play", "is not one of the scene's plays");
        if (auto r = checkNumber(change.glide, 0.0, limits::duration, where + ".glide"); !r)
            return r;
    }
    return {};
}

} // namespace pacini
