#pragma once

// Whole signals of what plays.

#include "support/Catch.h"

#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini::test
{

using Channels = std::vector<std::vector<float>>;

/// All frames of a decoder, asked for in blocks of `block` frames.
inline std::vector<float> render(Decoder& decoder, std::size_t block)
{
    std::vector<float> y(static_cast<std::size_t>(decoder.totalFrames()));
    for (std::size_t i = 0; i < y.size(); i += block)
        decoder.process(std::span(y).subspan(i, std::min(block, y.size() - i)));
    return y;
}

/// All frames of a player of `channels` actuators.
template <typename Player>
Channels renderChannels(Player& player, std::size_t channels, std::size_t block)
{
    const auto frames = static_cast<std::size_t>(player.totalFrames());
    Channels out(channels, std::vector<float>(frames));
    for (std::size_t i = 0; i < frames; i += block)
    {
        std::vector<std::span<float>> part;
        for (auto& channel : out)
            part.push_back(std::span(channel).subspan(i, std::min(block, frames - i)));
        player.process(part);
    }
    return out;
}

/// What drives an actuator when a clip is played on it.
inline std::vector<float> drive(const Clip& clip, const Profile& profile, const CompileParams& params = {},
                                const ScenePlayerParams& playing = {})
{
    Scene scene;
    scene.clips = {clip};
    scene.plays.resize(1);
    const auto plan = compilePlan(scene, &profile, params);
    REQUIRE(plan.ok());
    ScenePlayer player(*plan, playing);
    const auto frames = static_cast<std::size_t>(player.totalFrames());
    return renderChannels(player, 1, std::max<std::size_t>(frames, 1)).front();
}

} // namespace pacini::test
