#pragma once

// Mixer of an engine: voices through their players into the outputs, with gains and delays of the actuators.

#include <pacini/foundation/Glide.h>
#include <pacini/runtime/ActuatorKind.h>
#include <pacini/runtime/EngineParams.h>
#include <pacini/runtime/EngineVoices.h>
#include <pacini/synthesis/DelayTap.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Outputs of an engine. [audio]
class EngineMixer
{
public:
    static constexpr std::size_t blockFrames = MixBuffers::frames; ///< mixed at a time, at most

    EngineMixer(const EngineParams& params, std::vector<ActuatorKind>& players)
        : kinds(players), taps(params.actuators.size()), discarded(params.actuators.size() * blockFrames)
    {
        for (const ActuatorKind& kind : kinds)
            latency = std::max(latency, kind.player->latencyFrames());
        for (const EngineActuator& actuator : params.actuators)
            gains.emplace_back(actuator.gain);
        for (const ActuatorKind& kind : kinds)
            for (const std::size_t a : kind.actuators)
            {
                const double frames = params.actuators[a].delay.value * params.sampleRate +
                                      static_cast<double>(latency - kind.player->latencyFrames());
                if (frames > 0.0)
                    taps[a].emplace(Tap{DelayTap(frames, blockFrames), frames});
            }
    }

    [[nodiscard]] std::size_t actuators() const noexcept { return gains.size(); }
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return latency; }

    void setGain(std::size_t actuator, double gain, std::size_t frames) noexcept
    {
        gains[actuator].glideTo(gain, frames);
    }

    /// Outputs of n frames that nobody hears.
    [[nodiscard]] std::array<std::span<float>, limits::actuators> unheard(std::size_t n) noexcept
    {
        std::array<std::span<float>, limits::actuators> outputs;
        for (std::size_t a = 0; a < gains.size(); ++a)
            outputs[a] = std::span(discarded).subspan(a * blockFrames, n);
        return outputs;
    }

    /// Frames [at, at + n) of `out`, at most blockFrames.
    void mix(EngineVoices& voices, std::span<const std::span<float>> out, std::size_t at, std::size_t n) noexcept
    {
        std::array<std::span<float>, limits::actuators> channels;
        for (std::size_t k = 0; k < kinds.size(); ++k)
        {
            const auto& actuators = kinds[k].actuators;
            for (std::size_t c = 0; c < actuators.size(); ++c)
                // What the caller does not want is played unheard: its protection goes on.
                channels[c] = actuators[c] < out.size() ? out[actuators[c]].subspan(at, n)
                                                        : std::span(discarded).subspan(actuators[c] * blockFrames, n);
            LiveMix live{voices, buffers, k};
            kinds[k].player->process(std::span(channels).first(actuators.size()), live);
        }
        for (std::size_t a = 0; a < std::min(out.size(), gains.size()); ++a)
            finish(a, out[a].subspan(at, n));
    }

    /// What protection takes now at most, dB.
    [[nodiscard]] double gainReduction() const noexcept
    {
        double reduction = 0.0;
        for (const ActuatorKind& kind : kinds)
            for (std::size_t a = 0; a < kind.actuators.size(); ++a)
                if (const ProtectionMeter* meter = kind.player->protectionMeter(a))
                    reduction = std::max(reduction, meter->gainReduction);
        return reduction;
    }

private:
    /// What plays beside the scene on one kind of actuator.
    struct LiveMix
    {
        EngineVoices& voices;
        MixBuffers& buffers;
        std::size_t kind;
        void mix(std::span<const std::span<float>> out, std::size_t at, std::size_t n, std::int64_t frame) noexcept
        {
            voices.mix(kind, {out, at, n, frame}, buffers);
        }
    };

    struct Tap
    {
        DelayTap line;
        double frames;
    };

    void finish(std::size_t a, std::span<float> samples) noexcept
    {
        Glide& gain = gains[a];
        if (!gain.restsAt(1.0))
            for (float& sample : samples)
                sample = toSample(gain.next() * static_cast<double>(sample));
        if (taps[a])
        {
            taps[a]->line.write(samples);
            for (std::size_t i = 0; i < samples.size(); ++i)
                samples[i] = taps[a]->line.read(i, taps[a]->frames);
        }
    }

    std::vector<ActuatorKind>& kinds;
    std::vector<Glide> gains;
    std::vector<std::optional<Tap>> taps;
    std::size_t latency = 0;
    MixBuffers buffers;
    std::vector<float> discarded;
};

} // namespace pacini
