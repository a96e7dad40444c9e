#pragma once

// What an engine is made for.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/ClipAdaptation.h>
#include <pacini/synthesis/DecoderChoice.h>
#include <pacini/synthesis/Scene.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace pacini
{

/// One output of an engine.
struct EngineActuator
{
    std::optional<Profile> profile; ///< none: the drive signal as it is, within full drive
    double gain = 1.0;              ///< linear, 0 to 1, behind the protection
    Seconds delay{0.0};             ///< 0 to 1 s, to line actuators up
    bool operator==(const EngineActuator&) const = default;
};

/// Budget of simultaneous playback. The least important parts beyond it are skipped.
struct EngineBudget
{
    double nanosecondsPerFrame = 0.0; ///< by the predicted cost of plays; 0 = no limit
    std::size_t voices = 0;           ///< plays that sound at a time; 0 = no limit
    bool operator==(const EngineBudget&) const = default;
};

/// What an engine is made for.
struct EngineParams
{
    double sampleRate = 48000.0;           ///< Hz, 2000 to 768000
    std::vector<EngineActuator> actuators; ///< 1 to 16, in a row from pan 0 to pan 1
    PanLaw panLaw = PanLaw::constantPower;
    Seconds panDelay{0.01};     ///< for the whole row, for delay panning, 0 to 0.1 s
    Seconds longestDelay{0.25}; ///< of a play, set live; 0 to 1 s
    bool protect = true;
    std::size_t maxPlays = 256;     ///< at a time, 1 to 10000
    std::size_t maxCommands = 4096; ///< that wait, 16 to 1000000
    EngineBudget budget;
    /// Plans each play as `pacini render` plans a scene of that play alone: bands that are too weak to matter are left
    /// out, and where an actuator is the only one with its profile a play's own interpolator does the filtering of its
    /// output. The samples are those of `pacini render` then, and one play costs less, many cost more. Without a
    /// budget, and without levels of roles.
    bool asRendered = false;
    DecoderChoice decoder;
    AdaptationParams adaptation;
};

/// Checks them; errors (invalidArgument) name the place, such as `actuators[1].gain`.
[[nodiscard]] inline Result<void> validate(const EngineParams& params)
{
    using namespace detail;
    const auto wrong = [](const std::string& where, const char* what)
    {
        return Error{ErrorCode::invalidArgument, where, what};
    };
    const auto within = [](double value, double low, double high)
    {
        return std::isfinite(value) && value >= low && value <= high;
    };
    if (!isPlayableRate(params.sampleRate))
        return wrong("sampleRate", "must be 2000 to 768000 Hz");
    if (params.actuators.empty() || params.actuators.size() > static_cast<std::size_t>(limits::actuators))
        return wrong("actuators", "must be 1 to 16");
    if (!within(params.panDelay.value, 0.0, 0.1))
        return wrong("panDelay", "must be 0 to 0.1 s");
    if (!within(params.longestDelay.value, 0.0, limits::playDelay))
        return wrong("longestDelay", "must be 0 to 1 s");
    if (params.maxPlays < 1 || params.maxPlays > limits::plays)
        return wrong("maxPlays", "must be 1 to 10000");
    if (params.maxCommands < 16 || params.maxCommands > 1'000'000)
        return wrong("maxCommands", "must be 16 to 1000000");
    if (!within(params.budget.nanosecondsPerFrame, 0.0, 1e9))
        return wrong("budget.nanosecondsPerFrame", "must be 0 to 1e9");
    if (params.asRendered && (params.budget.nanosecondsPerFrame > 0.0 || params.budget.voices > 0))
        return wrong("budget", "must not be set when the engine plays clips as rendered");
    for (std::size_t i = 0; i < params.actuators.size(); ++i)
    {
        const EngineActuator& actuator = params.actuators[i];
        if (!within(actuator.gain, 0.0, 1.0))
            return wrong(indexed("actuators", i) + ".gain", "must be 0 to 1");
        if (!within(actuator.delay.value, 0.0, 1.0))
            return wrong(indexed("actuators", i) + ".delay", "must be 0 to 1 s");
        if (actuator.profile)
            if (auto valid = validate(*actuator.profile); !valid)
                return wrong(indexed("actuators", i) + ".profile." + valid.error().where,
                             valid.error().message.c_str());
    }
    return {};
}

} // namespace pacini
