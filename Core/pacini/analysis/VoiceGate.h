#pragma once

// Voice gate: turns down what sounds like speech, above the lowest range of touch; live and offline the same.

#include <pacini/analysis/VoiceFeatures.h>
#include <pacini/analysis/VoiceWeights.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/filters/StateVariable.h>
#include <pacini/filters/WholeDecimator.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Evidence for a voice as log odds, above 0 more likely than not: a weighted sum of the features.
[[nodiscard]] inline double voiceEvidence(const std::array<double, voiceFeatures>& features) noexcept
{
    double sum = voiceBias;
    for (std::size_t i = 0; i < voiceFeatures; ++i)
        sum += voiceWeights[i] * features[i];
    return clampTo(sum, -4.0, 4.0);
}

/// Decision whether a voice sounds: evidence of about 30 ms, with hysteresis. It stays in pauses. A sound that begins
/// is judged after 64 ms, when a spectrum lies on it alone: in silence a tick begins like a consonant.
class VoiceDecision
{
public:
    void prepare(double hopSeconds) noexcept { share = 1.0 - std::exp(-hopSeconds / 0.030); }

    void reset() noexcept
    {
        evidence = -1.0;
        hops = 0;
        voice = false;
    }

    /// For each hop; returns whether a voice sounds.
    bool tick(double found, bool active) noexcept
    {
        hops = active ? std::min(hops + 1, hopsToJudge) : 0;
        if (active && (voice || hops == hopsToJudge || found < evidence))
            evidence += share * (found - evidence);
        voice = evidence > (voice ? stays : begins);
        return voice;
    }

private:
    static constexpr std::size_t hopsToJudge = 4;
    static constexpr double begins = 2.0;
    static constexpr double stays = 0.4;

    double share = 1.0;
    double evidence = -1.0;
    std::size_t hops = 0; // of the sound since the last pause
    bool voice = false;
};

/// Parameters of the voice gate.
struct VoiceGateParams
{
    double speech = 1.0; ///< share of speech that stays, 0 to 1; 1: all of it, and the gate does nothing
    bool operator==(const VoiceGateParams&) const = default;
};

/// Voice gate. While a voice sounds, everything above 75 Hz is turned down: a low-pass takes over within 15 ms, so that
/// what lies below the pitch of voices, kicks and explosions, is kept, and gives back within 80 ms. One decision, on
/// the mean of all channels, holds for each. No latency. At `speech` 1 samples pass as they are.
class VoiceGate
{
public:
    using Params = VoiceGateParams;

    VoiceGate() { prepare(ProcessSpec{}); }

    /// Of one channel. Allocates.
    void prepare(const ProcessSpec& spec) { prepare(spec.sampleRate, 1); }

    /// Of `count` interleaved channels, 1 or more, at `rate` Hz. Allocates.
    void prepare(double rate, std::size_t count)
    {
        channels = count;
        const std::size_t factor = std::max<std::size_t>(1, static_cast<std::size_t>(rate / 8000.0));
        decimator = WholeDecimator(factor, rate, 3600.0);
        features = VoiceFeatures(rate / static_cast<double>(factor));
        decision.prepare(features.hopSeconds());
        low = designButterworth({ButterworthType::lowpass, 4, Hertz(75.0)}, rate);
        states.assign(channels * low.sections.size(), {});
        downShare = 1.0 - std::exp(-1.0 / (0.015 * rate));
        upShare = 1.0 - std::exp(-1.0 / (0.080 * rate));
        reset();
    }

    void setParams(const Params& wanted) noexcept
    {
        const bool wasOn = isOn();
        floor = std::isfinite(wanted.speech) ? clampTo(wanted.speech, 0.0, 1.0) : floor;
        if (isOn() && !wasOn)
            reset();
    }

    void reset() noexcept
    {
        features.reset();
        decision.reset();
        decimator.reset();
        std::fill(states.begin(), states.end(), StateVariableState{});
        untilFrame = 0;
        gain = 1.0;
        voice = false;
    }

    /// Does the gate change what it gets?
    [[nodiscard]] bool isOn() const noexcept { return floor < 1.0 || gain < 1.0; }

    /// Does a voice sound now?
    [[nodiscard]] bool hearsVoice() const noexcept { return voice; }

    /// Whole frames of interleaved channels; `in` and `out` may be the same memory.
    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        assert(in.size() == out.size() && in.size() % channels == 0);
        if (!isOn())
        {
            std::transform(in.begin(), in.end(), out.begin(), passedSample);
            return;
        }
        while (!in.empty())
        {
            const std::size_t n = std::min(in.size(), channels * longestPiece);
            piece(in.first(n), out.first(n));
            in = in.subspan(n);
            out = out.subspan(n);
        }
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return 0; }

private:
    void piece(std::span<const float> in, std::span<float> out) noexcept
    {
        const std::size_t frames = in.size() / channels;
        for (std::size_t i = 0; i < frames; ++i)
        {
            double sum = 0.0;
            for (std::size_t c = 0; c < channels; ++c)
                sum += finiteOrZero(in[i * channels + c]);
            mono[i] = toSample(sum / static_cast<double>(channels));
        }
        const std::size_t made = decimator.framesFor(frames);
        decimator.process(std::span(mono).first(frames), std::span(decimated).first(made),
                          std::span(peaks).first(made));
        const std::size_t sections = low.sections.size();
        for (std::size_t i = 0, next = 0; i < frames; ++i)
        {
            if (untilFrame == 0)
                listen(static_cast<double>(decimated[next++]));
            untilFrame = untilFrame > 0 ? untilFrame - 1 : decimator.factor() - 1;
            const double target = voice ? floor : 1.0;
            gain += (target < gain ? downShare : upShare) * (target - gain);
            if (target == 1.0 && 1.0 - gain < 1e-6)
                gain = 1.0;
            for (std::size_t c = 0; c < channels; ++c)
            {
                const double x = finiteOrZero(in[i * channels + c]);
                double below = x;
                for (std::size_t s = 0; s < sections; ++s)
                    below = states[c * sections + s].tick(low.sections[s], below);
                out[i * channels + c] = toSample(gain == 1.0 ? x : x + (gain - 1.0) * (x - below));
            }
        }
        for (StateVariableState& state : states)
            state.flush();
    }

    void listen(double x) noexcept
    {
        if (features.push(x))
            voice = decision.tick(voiceEvidence(features.found()), features.isActive());
    }

    static constexpr std::size_t longestPiece = 256; // frames

    std::size_t channels = 1;
    VoiceFeatures features{8000.0};
    VoiceDecision decision;
    WholeDecimator decimator; // to the rate of the features
    std::array<float, longestPiece> mono{}, decimated{}, peaks{};
    BiquadCascadeCoefficients low;
    std::vector<StateVariableState> states; // of the low-pass, by channel
    double downShare = 1.0, upShare = 1.0;
    double floor = 1.0;
    double gain = 1.0;
    std::size_t untilFrame = 0;
    bool voice = false;
};

static_assert(DspBlock<VoiceGate>);

} // namespace pacini
