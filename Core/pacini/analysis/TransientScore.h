#pragma once

// Transient score: how much a sound rises at once, as the distance between a fast and a slow envelope.

#include <pacini/analysis/DecayTime.h>
#include <pacini/analysis/EnvelopeFollower.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <cmath>
#include <cstddef>
#include <span>

namespace pacini
{

/// Reading of the score's formula.
enum class TransientScoreReading
{
    absolute, ///< |fast - slow|: the thesis's; depends on the level of the sound
    relative, ///< (fast - slow) / (slow + floor)
};

/// Parameters of the transient score. Two envelope followers that differ in their attack only. Times are clamped like
/// those of EnvelopeFollowerParams, the floor to 1e-9 and above.
struct TransientScoreParams
{
    TransientScoreReading reading = TransientScoreReading::absolute;
    double floor = 0.03; ///< of the relative score, linear amplitude
    Seconds fastAttack{0.001};
    Seconds slowAttack{0.030};
    Seconds hold{0.016};
    Seconds release{0.100};
    DecayDefinition decay = DecayDefinition::percent99;
    bool operator==(const TransientScoreParams&) const = default;
};

/// The transient score sample by sample (Weber 2020, Algorithm 4.2, lines 3 to 5).
class TransientScore
{
public:
    using Params = TransientScoreParams;

    void prepare(const ProcessSpec& spec) noexcept
    {
        fast.prepare(spec);
        slow.prepare(spec);
        setParams(current);
    }
    void setParams(const Params& params) noexcept
    {
        current = params;
        current.floor = clampTo(params.floor, 1e-9, 1e9);
        EnvelopeFollowerParams follower{
            .attack = params.fastAttack, .hold = params.hold, .release = params.release, .decay = params.decay};
        fast.setParams(follower);
        follower.attack = params.slowAttack;
        slow.setParams(follower);
    }
    void reset() noexcept
    {
        fast.reset();
        slow.reset();
    }

    /// The score after one more sample (finite).
    double tick(double x) noexcept
    {
        const double ahead = fast.tick(x);
        const double behind = slow.tick(x);
        return current.reading == TransientScoreReading::absolute ? std::abs(ahead - behind)
                                                                  : (ahead - behind) / (behind + current.floor);
    }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        forEachSample(
            in, out, [this](double x) { return tick(x); }, [this] { flush(); });
    }

    /// For callers of tick(), like EnvelopeFollower::flush().
    void flush() noexcept
    {
        fast.flush();
        slow.flush();
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return 0; }

private:
    Params current;
    EnvelopeFollower fast;
    EnvelopeFollower slow;
};

static_assert(DspBlock<TransientScore>);

} // namespace pacini
