#pragma once

// The sound beside a play of a preview: where it is, frame by frame, and its fades.

#include "document/Playback.h"
#include "document/PreviewSource.h"

#include <pacini/runtime/Engine.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace pacini
{

/// A play and the sound beside it, made by the worker for the audio thread.
struct PreviewPlay
{
    std::uint64_t start = 0; ///< the call of play() that it is of
    std::uint64_t stage = 0; ///< the engine that plays it
    PlayId id;
    PlaybackWay way;
    double from = 0.0; ///< s of what is played
    std::shared_ptr<const PreviewSource> source;
};

/// Follows a play: the sound is wherever the engine is in the clip, at its speed. [audio]
class PreviewSound
{
public:
    /// After the engine has rendered `frames`; false once the play is over.
    bool follow(const PreviewPlay& play, const Engine& engine, std::size_t frames, double speed) noexcept
    {
        const PlayStatus status = engine.status(play.id);
        const double usual = speed / engine.sampleRate();
        latency = engine.latencyFrames();
        if (status.state == PlayState::waiting)
            return true;
        const auto n = static_cast<double>(frames);
        if (status.state == PlayState::ended)
        {
            if (age >= 0)
            {
                played += n * step;
                age += static_cast<std::int64_t>(frames);
            }
            return false;
        }
        const double moved = status.position - played;
        step = age >= 0 && moved > 0.0 && moved < 4.0 * n * usual ? moved / n : usual;
        played = status.position;
        age = age < 0 ? std::llround((played - play.from) / usual) : age + static_cast<std::int64_t>(frames);
        return true;
    }

    [[nodiscard]] bool begun() const noexcept { return age >= 0; }
    /// Frames of the play that have been put out; negative before it begins.
    [[nodiscard]] std::int64_t framesHeard() const noexcept { return age - static_cast<std::int64_t>(latency); }
    /// s of what is played, as it is mixed: ahead of the output by the engine's latency.
    [[nodiscard]] double mixed() const noexcept { return played; }
    /// As it is put out.
    [[nodiscard]] double heard() const noexcept { return played - static_cast<double>(latency) * step; }

    /// Another sound is beside the play from now on.
    void forgetSource() noexcept { held = {}; }

    /// Adds the sound of the last `gains.size()` frames to `out[c][at ...]`.
    void add(const PreviewPlay& play, double fs, std::span<const std::span<float>> out, std::size_t at,
             std::span<const float> gains) noexcept
    {
        if (!begun() || !play.source || play.source->channels() == 0)
            return;
        const std::size_t channels = play.source->channels();
        const double joint = std::max(1.0, jointSeconds * fs);
        for (std::size_t i = 0; i < gains.size(); ++i)
        {
            const auto behind = static_cast<std::int64_t>(latency + gains.size() - i);
            if (age < behind)
                continue;
            const double second = played - static_cast<double>(behind) * step;
            const double place = play.way.placeOf(second);
            if (play.way.kind == PlaybackWay::Kind::once && place >= play.way.end)
                continue;
            auto gain = static_cast<double>(gains[i]);
            if (play.way.loopTo > play.way.loopFrom)
            {
                const double since = (place - play.way.loopFrom) * fs;
                const bool jumped = since >= 0.0 && static_cast<double>(age - behind) * step * fs > since + 0.5;
                gain *= std::min(
                    {1.0, std::max(0.0, (play.way.loopTo - place) * fs - 1.0) / joint, jumped ? since / joint : 1.0});
            }
            std::array<double, 2> samples{};
            for (std::size_t c = 0; c < channels; ++c)
                samples[c] = read(*play.source, c, place * fs);
            for (std::size_t c = 0; c < out.size(); ++c)
                out[c][at + i] += static_cast<float>(gain * samples[std::min(c, channels - 1)]);
        }
    }

private:
    static constexpr double jointSeconds = 0.002; // over which the sound is faded where a loop jumps

    /// Between two samples at other speeds than 1; whole frames are read as they are.
    double read(const PreviewSource& source, std::size_t channel, double frame) noexcept
    {
        constexpr double whole = 1e-4;
        if (frame < -whole || frame >= static_cast<double>(source.frames()))
            return 0.0;
        const auto i = static_cast<std::size_t>(std::max(0.0, frame + whole));
        if (i >= source.frames())
            return 0.0;
        Held& part = held[channel];
        if (i < part.from || i + 2 > part.to)
        {
            source.read(channel, i, part.samples);
            part.from = i;
            part.to = i + part.samples.size();
        }
        const double fraction = frame - static_cast<double>(i);
        const auto here = static_cast<double>(part.samples[i - part.from]);
        return fraction < whole || i + 1 >= source.frames()
                   ? here
                   : here + fraction * (static_cast<double>(part.samples[i + 1 - part.from]) - here);
    }

    /// Frames [from, to) of a channel that have been read.
    struct Held
    {
        std::size_t from = 0, to = 0;
        std::array<float, 256> samples;
    };

    double played = 0.0, step = 0.0;
    std::int64_t age = -1; // frames that have been mixed since the play began; -1: it waits
    std::size_t latency = 0;
    std::array<Held, 2> held{};
};

} // namespace pacini
