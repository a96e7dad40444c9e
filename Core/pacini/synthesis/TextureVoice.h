#pragma once

// A texture as a play has it: by curves of speed and force, or live.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/Glide.h>
#include <pacini/synthesis/Roles.h>
#include <pacini/texture/TexturePlayer.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Texture of a play. Its curves are over seconds of the scene, and the delay of the player is taken out of them; live
/// values count from then on instead and come TexturePlayer::latencyFrames() later. The first and the last 5 ms of the
/// play fade. Output does not depend on how it is cut into blocks.
class TextureVoice
{
public:
    /// `frames`: of one block, at most. Curves may be empty: speed 0, force 1. Allocates. [worker]
    TextureVoice(std::shared_ptr<const TextureTable> table, std::uint64_t seed, Curve speedCurve, Curve forceCurve,
                 std::size_t frames)
        : fs(table->sampleRate()),
          player(std::move(table), seed),
          speeds(std::move(speedCurve)),
          forces(std::move(forceCurve)),
          speed(speeds.empty() ? 0.0 : speeds.front().value),
          force(forces.empty() ? 1.0 : forces.front().value),
          made(std::max(frames, player.latencyFrames()))
    {
    }

    /// Glides to a speed (0 to 1) from now on, instead of the curve. [audio]
    void setSpeed(double wanted, std::size_t frames) noexcept
    {
        speed.glideTo(wanted, frames);
        speedIsLive = true;
    }

    /// The same of the force. [audio]
    void setForce(double wanted, std::size_t frames) noexcept
    {
        force.glideTo(wanted, frames);
        forceIsLive = true;
    }

    /// Takes over what is live of another one. [audio]
    void follow(const TextureVoice& other) noexcept
    {
        speed = other.speed;
        force = other.force;
        speedIsLive = other.speedIsLive;
        forceIsLive = other.forceIsLive;
    }

    /// Live values go on by `frames`. [audio]
    void jump(std::size_t frames) noexcept
    {
        speed.jump(frames);
        force.jump(frames);
    }

    /// Begins again. [audio]
    void reset() noexcept
    {
        player.reset();
        begun = false;
    }

    /// Adds the next frames: the first is frame `now` of the scene and frame `played` of `total` of the play; at most
    /// the frames of the constructor. [audio]
    void add(std::span<float> out, std::int64_t now, std::int64_t played, std::int64_t total,
             const RoleGains& gains) noexcept
    {
        if (!begun)
        {
            // What the interpolator delays is made before the first frame is given out.
            begun = true;
            late = static_cast<std::int64_t>(player.latencyFrames());
            make(std::span(made).first(player.latencyFrames()), now - late, gains, false);
        }
        const auto block = std::span(made).first(out.size());
        make(block, now, gains, true);
        const double fade = 0.005 * fs;
        for (std::size_t i = 0; i < out.size(); ++i)
        {
            const double in = static_cast<double>(played + static_cast<std::int64_t>(i)) + 1.0;
            const double gain = std::clamp(std::min(in, static_cast<double>(total) - in) / fade, 0.0, 1.0);
            out[i] += static_cast<float>(gain * static_cast<double>(block[i]));
        }
    }

private:
    /// Speed and force are read where the player reads them, whatever the blocks are.
    void make(std::span<float> out, std::int64_t now, const RoleGains& gains, bool glides) noexcept
    {
        for (std::size_t done = 0; done < out.size();)
        {
            if (player.framesMade() == 0)
            {
                const double time = static_cast<double>(now + static_cast<std::int64_t>(done) + late) / fs;
                player.setSpeed(speedIsLive || speeds.empty() ? speed.now() : valueAt(speeds, time));
                player.setForce(forceIsLive || forces.empty() ? force.now() : valueAt(forces, time));
                player.setRoles(gains[Role::noise].at(done), gains[Role::tones].at(done));
            }
            const std::size_t ready = player.framesMade() > 0 ? player.framesMade() : player.hopLength();
            const std::size_t n = std::min(out.size() - done, ready);
            player.process(out.subspan(done, n));
            if (glides)
            {
                speed.skip(n);
                force.skip(n);
            }
            done += n;
        }
    }

    double fs;
    TexturePlayer player;
    Curve speeds, forces;
    Glide speed, force;
    bool speedIsLive = false, forceIsLive = false, begun = false;
    std::int64_t late = 0;
    std::vector<float> made;
};

} // namespace pacini
