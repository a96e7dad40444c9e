#pragma once

// Render plan: the needed and the skipped parts of a scene.

#include <pacini/actuator/OutputFilter.h>
#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/synthesis/DecoderParams.h>
#include <pacini/synthesis/PanSends.h>
#include <pacini/synthesis/PlayTimeline.h>
#include <pacini/texture/TextureTable.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// One play as it will be decoded: loops unrolled, adapted to the actuator, without bands that are not needed.
struct PlannedPlay
{
    std::size_t play = 0; ///< index into the scene's plays
    Clip clip;
    double start = 0.0; ///< s
    DecoderParams decoder;
    PlayTimeline timeline;
    std::shared_ptr<const TextureTable> texture = {}; ///< plays instead of the clip, which says what it will be like
    std::uint64_t textureSeed = 1;
};

/// Report of culling: something that is not played.
struct LeftOut
{
    std::string where;       ///< such as `plays[3]` or `plays[3].bands[2]`
    std::string reason;      ///< in plain words
    double error = 0.0;      ///< largest error of leaving it out, dB below the whole scene's energy; -infinity = none
    bool unplayable = false; ///< left out as the actuator cannot do it, not as nobody would feel it
    bool operator==(const LeftOut&) const = default;

    /// Whether it is all of a play, not a part of one.
    [[nodiscard]] bool isWholePlay() const noexcept { return where.find('.') == std::string::npos; }
};

/// Report of the adaptation: changes made for the actuator.
struct Adaptation
{
    std::string where; ///< such as `clips[2]`
    std::string what;  ///< in plain words
    bool operator==(const Adaptation&) const = default;
};

/// Report of a play: content of its decoder.
struct DecodedPlay
{
    std::size_t play = 0;  ///< index into the scene's plays
    double start = 0.0;    ///< s
    double duration = 0.0; ///< s, with the changes that were known
    DecoderReport decoder;
};

/// Everything that players need to play a scene on its actuators.
struct RenderPlan
{
    double duration = 0.0; ///< s
    std::size_t actuators = 1;
    ActuatorRow row;                ///< where they stand, for live panning
    std::optional<Profile> profile; ///< with the sections of its equaliser that matter
    std::optional<Flattening> flattening;
    bool motor = false;             ///< plays are strengths, which become the voltage of a motor
    std::vector<PlannedPlay> plays; ///< in order of start
    std::vector<Adaptation> adaptations;
    std::vector<LeftOut> leftOut;
    double culledError = 0.0; ///< dB below all that the actuator can play, of what nobody feels and is left out, behind
                              ///< limiters; at most the tolerance; -infinity = nothing lost
    double predictedError = 0.0; ///< dB below the whole scene, of that and of what the actuator cannot play
};

/// The frames of a plan at `sampleRate` Hz; none at a rate that nothing plays at.
[[nodiscard]] inline std::int64_t frameCount(const RenderPlan& plan, double sampleRate) noexcept
{
    return isPlayableRate(sampleRate) ? static_cast<std::int64_t>(std::floor(plan.duration * sampleRate + 0.5)) : 0;
}

} // namespace pacini
