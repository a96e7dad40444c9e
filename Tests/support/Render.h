#pragma once

// Whole signals of what plays.

#include "support/Catch.h"

#include <pacini/actuator/FeltModel.h>
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

/// Fills `out` from a player in blocks of `block` frames.
template <typename Player>
void fillChannels(Player& player, Channels& out, std::size_t block)
{
    for (std::size_t i = 0; i < out[0].size(); i += block)
    {
        std::vector<std::span<float>> part;
        for (auto& channel : out)
            part.push_back(std::span(channel).subspan(i, std::min(block, channel.size() - i)));
        player.process(part);
    }
}

/// All frames of a player of `channels` actuators.
template <typename Player>
Channels renderChannels(Player& player, std::size_t channels, std::size_t block)
{
    Channels out(channels, std::vector<float>(static_cast<std::size_t>(player.totalFrames())));
    fillChannels(player, out, block);
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

/// What of a drive is felt through the body of its actuator.
inline std::vector<float> felt(std::vector<float> y, const Profile& profile)
{
    FeltModel model;
    model.prepare({48000.0, y.size()});
    model.setParams(*feltModelParams(profile));
    model.reset();
    model.process(y, y);
    return y;
}

} // namespace pacini::test
