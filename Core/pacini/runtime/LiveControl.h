#pragma once

// Live controls of a play: their ranges, and their places in PlayControls.

#include <pacini/foundation/Result.h>
#include <pacini/runtime/PlayControls.h>

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace pacini
{

/// Live control of a play, or of all plays in a group.
enum class LiveControl
{
    gain,          ///< linear, 0 to 1000
    intensity,     ///< 0 to 1, beside the gain
    pan,           ///< 0 = first actuator, 1 = last
    delay,         ///< s, 0 to EngineParams::longestDelay
    transposition, ///< semitones, -96 to 96; steps
    speed,         ///< 0.01 to 100, pitches stay; steps
    priority,      ///< 0 is kept longest; steps
    tones,         ///< linear, 0 to 1000, as are the next two: levels of the roles of the clip
    events,
    noise,
    textureSpeed, ///< 0 to 1, as is the next: of a texture
    textureForce
};

/// The control that is the level of a role.
[[nodiscard]] constexpr LiveControl controlOf(Role role) noexcept
{
    return role == Role::tones ? LiveControl::tones : role == Role::events ? LiveControl::events : LiveControl::noise;
}

/// The role whose level a control is, if it is one.
[[nodiscard]] constexpr std::optional<Role> roleOf(LiveControl control) noexcept
{
    for (const Role role : allRoles)
        if (controlOf(role) == control)
            return role;
    return {};
}

/// Checks a value; `longestDelay`: s, of the engine. Error invalidArgument, with the name of the control.
[[nodiscard]] inline Result<void> checkControl(LiveControl control, double value, double longestDelay)
{
    struct Range
    {
        const char* where;
        double low, high;
        const char* message;
    };
    const std::array<Range, 12> ranges{{{"gain", 0.0, 1000.0, "must be 0 to 1000"},
                                        {"intensity", 0.0, 1.0, "must be 0 to 1"},
                                        {"pan", 0.0, 1.0, "must be 0 to 1"},
                                        {"delay", 0.0, longestDelay, "must be 0 to the engine's longest delay"},
                                        {"transposition", -96.0, 96.0, "must be -96 to 96 semitones"},
                                        {"speed", 0.01, 100.0, "must be 0.01 to 100"},
                                        {"priority", -1e9, 1e9, "must be -1e9 to 1e9"},
                                        {"tones", 0.0, 1000.0, "must be 0 to 1000"},
                                        {"events", 0.0, 1000.0, "must be 0 to 1000"},
                                        {"noise", 0.0, 1000.0, "must be 0 to 1000"},
                                        {"textureSpeed", 0.0, 1.0, "must be 0 to 1"},
                                        {"textureForce", 0.0, 1.0, "must be 0 to 1"}}};
    const Range& range = ranges[static_cast<std::size_t>(control)];
    if (!(value >= range.low && value <= range.high))
        return Error{ErrorCode::invalidArgument, range.where, range.message};
    return {};
}

/// All controls that PlayControls has, with their values.
[[nodiscard]] inline std::array<std::pair<LiveControl, double>, 11> valuesOf(const PlayControls& c)
{
    return {{{LiveControl::gain, c.gain},
             {LiveControl::intensity, c.intensity},
             {LiveControl::pan, c.pan},
             {LiveControl::delay, c.delay},
             {LiveControl::transposition, c.transposition},
             {LiveControl::speed, c.speed},
             {LiveControl::tones, c.roles[Role::tones]},
             {LiveControl::events, c.roles[Role::events]},
             {LiveControl::noise, c.roles[Role::noise]},
             {LiveControl::textureSpeed, c.textureSpeed},
             {LiveControl::textureForce, c.textureForce}}};
}

/// Sets a control; the priority is none of PlayControls.
inline void apply(PlayControls& controls, LiveControl control, double value) noexcept
{
    switch (control)
    {
    case LiveControl::gain:
        controls.gain = value;
        break;
    case LiveControl::intensity:
        controls.intensity = value;
        break;
    case LiveControl::pan:
        controls.pan = value;
        break;
    case LiveControl::delay:
        controls.delay = value;
        break;
    case LiveControl::transposition:
        controls.transposition = value;
        break;
    case LiveControl::speed:
        controls.speed = value;
        break;
    case LiveControl::tones:
    case LiveControl::events:
    case LiveControl::noise:
        controls.roles[*roleOf(control)] = value;
        break;
    case LiveControl::textureSpeed:
        controls.textureSpeed = value;
        break;
    case LiveControl::textureForce:
        controls.textureForce = value;
        break;
    case LiveControl::priority:
        break;
    }
}

} // namespace pacini
