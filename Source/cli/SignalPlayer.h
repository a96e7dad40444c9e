#pragma once

// Offline player of a render plan: its drive signals, or the accelerations felt from them, block by block.

#include "cli/Felt.h"

#include <pacini/synthesis/ScenePlayer.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pacini::cli
{

/// The drive signals of a plan, or the accelerations felt from them; both start at the same frame and are equally long.
class SignalPlayer
{
public:
    /// `params.builtUntil` does not count: decoders are made shortly before they sound.
    SignalPlayer(RenderPlan plan, ScenePlayerParams params, const std::optional<FeltSettings>& felt);

    [[nodiscard]] std::int64_t totalFrames() const noexcept { return player.totalFrames(); }
    [[nodiscard]] std::size_t maxSounding() const noexcept { return player.maxSounding(); }
    [[nodiscard]] double maxReduction() const noexcept { return player.maxReduction(); }

    /// What the decoder of every play plays, in order of start. Those that have not sounded yet are made for it.
    [[nodiscard]] const std::vector<DecodedPlay>& decodedPlays();

    /// Writes the next frames: one span for each actuator, all of the same length.
    void process(std::span<const std::span<float>> out);

private:
    void play(std::span<const std::span<float>> out);

    ScenePlayer player;
    double fs;
    std::vector<FeltModel> models; ///< one for each actuator, or none
    double driveScale = 1.0;
    double feltScale = 1.0;
    std::size_t late = 0;      ///< frames to be played before the first one is given out
    std::int64_t position = 0; ///< frames that were played
};

} // namespace pacini::cli
