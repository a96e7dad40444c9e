#pragma once

// One play of a scene while it sounds: its decoder, its live gain, and its level and delay towards every actuator.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/synthesis/Decoder.h>
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

/// A straight piece of a curve. Values follow from the frame alone, so that they do not depend on blocks.
struct CurvePiece
{
    double value = 0.0; // at `origin`
    double slope = 0.0; // per s
    double origin = 0.0;
    double fs = 1.0;
    [[nodiscard]] double at(std::int64_t frame) const noexcept
    {
        return value + slope * (static_cast<double>(frame) / fs - origin);
    }
};

/// Calls use(i, end, piece) for the straight pieces of a curve (not empty, over s) over frames [now, now + n). `next`
/// is the point that is reached next: 0 at first, then as the call before has left it. [audio]
template <typename Use>
void forCurvePieces(const Curve& curve, std::size_t& next, std::int64_t now, std::size_t n, double fs,
                    Use&& use) noexcept
{
    for (std::size_t i = 0; i < n;)
    {
        const double t = static_cast<double>(now + static_cast<std::int64_t>(i)) / fs;
        while (next < curve.size() && curve[next].time <= t)
            ++next;
        std::size_t end = n;
        if (next < curve.size())
        {
            const double until = std::ceil(curve[next].time * fs) - static_cast<double>(now);
            end = until < static_cast<double>(n) ? std::max(i + 1, static_cast<std::size_t>(until)) : n;
        }
        if (next == 0 || next == curve.size() || curve[next - 1].value == curve[next].value)
            use(i, end, CurvePiece{next == 0 ? curve.front().value : curve[next - 1].value, 0.0, 0.0, fs});
        else
        {
            const Breakpoint& a = curve[next - 1];
            const Breakpoint& b = curve[next];
            use(i, end, CurvePiece{a.value, (b.value - a.value) / (b.time - a.time), a.time, fs});
        }
        i = end;
    }
}

/// Fractional delay line. Remembers a signal and reads it back with delays that may change from sample to sample:
/// between samples by the cubic through four of them (Lagrange), flat within 0.1 dB up to an eighth of the rate. Haptic
/// signals end far below.
class DelayTap
{
public:
    DelayTap() = default;

    /// For delays up to `longest` frames and blocks up to `block` frames. Allocates.
    DelayTap(double longest, std::size_t block)
        : history(static_cast<std::size_t>(std::ceil(longest)) + 4), buffer(history + block, 0.0f)
    {
    }

    void reset() noexcept { std::fill(buffer.begin(), buffer.end(), 0.0f); }

    /// The next samples of the signal. [audio]
    void write(std::span<const float> samples) noexcept
    {
        const std::size_t n = samples.size();
        if (last > 0)
            std::copy(buffer.begin() + static_cast<std::ptrdiff_t>(last),
                      buffer.begin() + static_cast<std::ptrdiff_t>(last + history), buffer.begin());
        std::copy(samples.begin(), samples.end(), buffer.begin() + static_cast<std::ptrdiff_t>(history));
        last = n;
    }

    /// Sample `n` of the last block, `delay` frames late, 1 frame at least for the cubic: it adds 1 to every delay.
    [[nodiscard]] float read(std::size_t n, double delay) const noexcept
    {
        const double whole = std::floor(delay);
        const double u = delay - whole; // towards the older sample
        const std::size_t at = history + n - 1 - static_cast<std::size_t>(whole);
        const double newer = static_cast<double>(buffer[at + 1]), a = static_cast<double>(buffer[at]),
                     b = static_cast<double>(buffer[at - 1]), older = static_cast<double>(buffer[at - 2]);
        const double value = -u * (u - 1.0) * (u - 2.0) / 6.0 * newer + (u + 1.0) * (u - 1.0) * (u - 2.0) / 2.0 * a -
                             (u + 1.0) * u * (u - 2.0) / 2.0 * b + (u + 1.0) * u * (u - 1.0) / 6.0 * older;
        return static_cast<float>(value);
    }

private:
    std::size_t history = 4;
    std::vector<float> buffer;
    std::size_t last = 0;
};

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

    /// Makes the decoder, with `filter` behind it if there is one, and the delay line; the scene ends at frame `until`.
    /// [worker]
    void prepare(const PlannedPlay& play, const BiquadCascadeCoefficients* filter = nullptr, std::int64_t until = 0)
    {
        DecoderParams params = play.decoder;
        params.sampleRate = fs;
        decoder = std::make_unique<Decoder>(play.clip, params, play.timeline.changes);
        if (filter != nullptr)
            decoder->filterBy(*filter, until - start);
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
        over = now + static_cast<std::int64_t>(n) >= start + decoder->totalFrames() + tail && !decoder->rings();
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
