#pragma once

// One play of a scene while it sounds: its decoder, its live gain, and its level and delay towards every actuator.

#include <pacini/foundation/DspBlock.h>
#include <pacini/synthesis/CurvePieces.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/DelayTap.h>
#include <pacini/synthesis/RenderPlan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace pacini
{

/// Linear gain ramp.
class LiveGain
{
public:
    /// Glides to `gain` within 5 ms.
    void set(double gain, double fs) noexcept
    {
        step = (gain - value) / (0.005 * fs);
        target = gain;
    }

    [[nodiscard]] bool isUnity() const noexcept { return value == 1.0 && target == 1.0; }

    void apply(std::span<float> block) noexcept
    {
        if (isUnity())
            return;
        for (float& sample : block)
        {
            sample = toSample(value * static_cast<double>(sample));
            const double next = value + step;
            value = step > 0.0 ? std::min(next, target) : std::max(next, target);
        }
    }

private:
    double value = 1.0, target = 1.0, step = 0.0;
};

/// Memory for mixing one block, shared by all voices.
struct MixBuffers
{
    static constexpr std::size_t frames = 1024;
    std::array<float, frames> mono{}, delayed{};
    std::array<double, frames> delays{};
};

/// Where a block is mixed to: frames [at, at + frames) of `out`, one span for each actuator; the first is frame `now`
/// of the scene.
struct MixTarget
{
    std::span<const std::span<float>> out;
    std::size_t at = 0, frames = 0;
    std::int64_t now = 0;
};

/// Voice of one play. Made without a decoder: prepare() and release() bound the memory of long scenes. Every call gets
/// the play that the voice was made for.
class PlayVoice
{
public:
    PlayVoice(const PlannedPlay& play, std::size_t actuators, double sampleRate)
        : fs(sampleRate), start(static_cast<std::int64_t>(std::floor(play.start * fs + 0.5))), levels(actuators)
    {
    }

    [[nodiscard]] std::int64_t startFrame() const noexcept { return start; }
    [[nodiscard]] bool ended() const noexcept { return over; }
    [[nodiscard]] const Decoder* decoding() const noexcept { return decoder.get(); }

    /// Makes the decoder and the delay line. [worker]
    void prepare(const PlannedPlay& play)
    {
        DecoderParams params = play.decoder;
        params.sampleRate = fs;
        decoder = std::make_unique<Decoder>(play.clip, params, play.timeline.changes);
        if (play.timeline.delays.empty())
            return;
        double longest = 0.0;
        for (const Curve& curve : play.timeline.delays)
            for (const Breakpoint& point : curve)
                longest = std::max(longest, point.value);
        delay = DelayTap(longest * fs, MixBuffers::frames);
        tail = static_cast<std::int64_t>(std::ceil(longest * fs)) + 4;
    }

    /// Frees their memory. [worker]
    void release()
    {
        decoder.reset();
        delay = {};
    }

    void setGain(double wanted) noexcept { gain.set(wanted, fs); }

    /// As Decoder::change does.
    void change(double transposition, double stretch) noexcept
    {
        if (decoder)
            decoder->change(transposition, stretch);
    }

    /// Adds what sounds in the block. A voice that is `lone` in a block that has been cleared may overwrite it. [audio]
    void mix(const PlannedPlay& play, const MixTarget& target, bool lone, MixBuffers& buffers) noexcept
    {
        const auto from = static_cast<std::size_t>(std::max<std::int64_t>(start - target.now, 0));
        if (from >= target.frames)
            return;
        const std::size_t n = target.frames - from;
        const std::int64_t now = target.now + static_cast<std::int64_t>(from);
        if (lone && isPlain(play, target.out.size()))
            decoder->process(target.out.front().subspan(target.at + from, n));
        else
            addTo(play, target.out, target.at + from, now, std::span(buffers.mono).first(n), buffers);
        over = now + static_cast<std::int64_t>(n) >= start + decoder->totalFrames() + tail;
    }

private:
    /// How far the curves towards one actuator have been read.
    struct Level
    {
        std::size_t gain = 0;
        std::size_t delay = 0;
    };

    /// Whether the play goes to one actuator as it is.
    [[nodiscard]] bool isPlain(const PlannedPlay& play, std::size_t channels) const noexcept
    {
        const auto& gains = play.timeline.gains;
        return channels == 1 && gains.size() == 1 && gains[0].size() == 1 && gains[0][0].value == 1.0 && gain.isUnity();
    }

    void addTo(const PlannedPlay& play, std::span<const std::span<float>> out, std::size_t at, std::int64_t now,
               std::span<float> block, MixBuffers& buffers) noexcept
    {
        decoder->process(block);
        gain.apply(block);
        const bool delayed = !play.timeline.delays.empty();
        if (delayed)
            delay.write(block);
        for (std::size_t a = 0; a < std::min(out.size(), levels.size()); ++a)
        {
            std::span<const float> in = block;
            if (delayed)
                in = readDelayed(play.timeline.delays[a], levels[a].delay, now, block.size(), buffers);
            addScaled(play.timeline.gains[a], levels[a].gain, now, in, out[a].subspan(at, block.size()));
        }
    }

    std::span<const float> readDelayed(const Curve& curve, std::size_t& next, std::int64_t now, std::size_t n,
                                       MixBuffers& buffers) const noexcept
    {
        forCurvePieces(curve, next, now, n, fs,
                       [&](std::size_t i, std::size_t end, const CurvePiece& piece)
                       {
                           for (; i < end; ++i)
                               buffers.delays[i] = std::max(0.0, piece.at(now + static_cast<std::int64_t>(i)));
                       });
        for (std::size_t i = 0; i < n; ++i)
            buffers.delayed[i] = delay.read(i, fs * buffers.delays[i]);
        return std::span(buffers.delayed).first(n);
    }

    void addScaled(const Curve& gains, std::size_t& next, std::int64_t now, std::span<const float> in,
                   std::span<float> out) const noexcept
    {
        forCurvePieces(gains, next, now, in.size(), fs,
                       [&](std::size_t i, std::size_t end, const CurvePiece& piece)
                       {
                           if (piece.slope != 0.0)
                               for (; i < end; ++i)
                                   out[i] += static_cast<float>(piece.at(now + static_cast<std::int64_t>(i)) *
                                                                static_cast<double>(in[i]));
                           else if (piece.value != 0.0)
                               for (; i < end; ++i)
                                   out[i] += static_cast<float>(piece.value * static_cast<double>(in[i]));
                       });
    }

    double fs;
    std::int64_t start;
    std::unique_ptr<Decoder> decoder;
    DelayTap delay;
    std::int64_t tail = 0; // frames that sound longer because of delays
    std::vector<Level> levels;
    LiveGain gain;
    bool over = false;
};

} // namespace pacini
