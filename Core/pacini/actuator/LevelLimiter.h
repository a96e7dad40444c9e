#pragma once

// Look-ahead limiter: keeps a drive signal within full scale if no actuator is known.

#include <pacini/actuator/LimiterGain.h>
#include <pacini/actuator/Protection.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Parameters of the limiter.
struct LevelLimiterParams
{
    Hertz lowFrequency{20.0}; ///< the lowest tone to be played, 1 to 20000 Hz: the gain does not follow its waveform
    Seconds lookAhead{0.001}; ///< 0 to 1 ms
    bool operator==(const LevelLimiterParams&) const = default;
};

/// Level limiter, the part of Protection for drives without a profile. The output stays within +-1 for every input. A
/// signal within +-1 passes bit for bit, delayed by the look-ahead. The knee is therefore hard and the mean is kept:
/// other programs view, measure and process the drive rendered without a profile.
class LevelLimiter
{
public:
    using Params = LevelLimiterParams;

    void prepare(const ProcessSpec& spec)
    {
        fs = spec.sampleRate;
        const auto frames = static_cast<std::size_t>(Protection::maxLookAhead * fs);
        line.assign(frames + lineRoom, 0.0f);
        gain.prepare(frames, static_cast<std::size_t>(longestLimiterHold * fs));
        setParams(current);
        reset();
    }

    /// A changed look-ahead starts again from silence. NaN counts as the lower end.
    void setParams(const Params& params) noexcept
    {
        current = params;
        const double seconds = clampTo(params.lookAhead.value, 0.0, Protection::maxLookAhead);
        const auto frames = std::min(static_cast<std::size_t>(seconds * fs), line.size() - lineRoom);
        if (frames != latency)
        {
            latency = frames;
            std::fill(line.begin(), line.end(), 0.0f);
            position = latency;
        }
        gain.design(latency, static_cast<std::size_t>(limiterHold(params.lowFrequency) * fs), fs);
    }

    void reset() noexcept
    {
        gain.reset();
        std::fill(line.begin(), line.end(), 0.0f);
        position = latency;
        lastCall = {};
    }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        // Nearly always: nothing exceeds 1, which a loop without branches finds out at a fraction of what gains cost.
        const bool passes = gain.idle() && staysWithin(in);
        double smallest = 1.0;
        for (std::size_t begin = 0; begin < in.size();)
        {
            const std::size_t frames = std::min(in.size() - begin, longestStretch);
            float* const newest = roomFor(frames);
            const auto from = in.subspan(begin, frames);
            const auto to = out.subspan(begin, frames);
            if (passes)
                passOn(from, newest, to);
            else
                smallest = std::min(smallest, limit(from, newest, to));
            begin += frames;
        }
        lastCall = {};
        if (passes)
            return;
        lastCall.level = smallest < 1.0;
        lastCall.gainReduction = -Decibels::fromGain(smallest).value;
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return latency; }

    /// Activity in the last call of process(). For the thread that calls process().
    [[nodiscard]] const ProtectionMeter& meter() const noexcept { return lastCall; }

private:
    static constexpr std::size_t longestStretch = 256;
    static constexpr std::size_t lineRoom = 4 * longestStretch; ///< long enough that the line rarely moves

    /// The place of the next `frames` in the line; the frames before them lie in front of it.
    [[nodiscard]] float* roomFor(std::size_t frames) noexcept
    {
        if (position + frames > line.size())
        {
            const auto end = line.begin() + static_cast<std::ptrdiff_t>(position);
            std::copy(end - static_cast<std::ptrdiff_t>(latency), end, line.begin());
            position = latency;
        }
        float* const place = line.data() + position;
        position += frames;
        return place;
    }

    /// Delays frames that are within +-1 as all those before them that still wait.
    void passOn(std::span<const float> in, float* newest, std::span<float> out) const noexcept
    {
        std::copy(in.begin(), in.end(), newest);
        const float* const delayed = newest - latency;
        constexpr float least = 1e-30f; // as in toSample()
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = std::abs(delayed[i]) >= least ? delayed[i] : 0.0f;
    }

    /// Delays and limits; returns the smallest gain.
    double limit(std::span<const float> in, float* newest, std::span<float> out) noexcept
    {
        const float* const delayed = newest - latency;
        double smallest = 1.0;
        for (std::size_t i = 0; i < in.size(); ++i)
        {
            const double x = finiteOrZero(in[i]);
            const double g = gain.tick(x * x);
            smallest = std::min(smallest, g);
            newest[i] = static_cast<float>(x);
            // The mean of gains can be above each of them by its rounding.
            out[i] = toSample(clampTo(g * static_cast<double>(delayed[i]), -1.0, 1.0));
        }
        return smallest;
    }

    /// Whether no sample is beyond +-1 or not a number.
    [[nodiscard]] static bool staysWithin(std::span<const float> in) noexcept
    {
        int beyond = 0;
        for (const float x : in)
            beyond |= static_cast<int>(!(x <= 1.0f)) | static_cast<int>(!(x >= -1.0f));
        return beyond == 0;
    }

    double fs = ProcessSpec{}.sampleRate;
    Params current;
    KneeLimiterGain<HardKnee> gain;
    std::vector<float> line = std::vector<float>(lineRoom, 0.0f); ///< oldest first
    std::size_t latency = 0;
    std::size_t position = 0; ///< where the next frame goes in the line
    ProtectionMeter lastCall;
};

static_assert(DspBlock<LevelLimiter>);

} // namespace pacini
