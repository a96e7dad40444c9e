#pragma once

// Live translation of a sound to a drive signal for several outputs.

#include "cli/live/LiveFollow.h"
#include "live/LatencyProbe.h"
#include "live/LiveDrive.h"

#include <pacini/foundation/LargestMagnitude.h>
#include <pacini/realtime/Translator.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini::cli
{

/// Mixes, translates and hands out, on the thread that the sound comes by: process() neither allocates nor waits.
/// Outputs and probes are added before the first block.
class LiveEngine
{
public:
    LiveEngine(double sampleRate, const TranslatorSetup& setup, const TranslatorParams& params)
        : fs(sampleRate), mono(longestPiece), drive(longestPiece), back(longestPiece)
    {
        translator.prepare({sampleRate, longestPiece});
        translator.setSetup(setup);
        translator.setParams(params);
        translator.reset();
    }

    /// Both outlive the engine. [message]
    void add(live::LiveDrive& output) { outputs.push_back(&output); }
    void measure(live::LatencyProbe& wanted) { probe = &wanted; }
    void follow(LiveFollow& wanted) { follower = &wanted; }

    static constexpr std::size_t longestPiece = 256; ///< frames made at a time

    /// Whole frames of `interleaved`, the mean of whose `channels` is translated, but for one that is followed. [audio]
    void process(std::span<const float> interleaved, std::size_t channels) noexcept
    {
        const std::size_t frames = interleaved.size() / channels;
        if (probe)
            probe->begin(frames, fs);
        for (std::size_t i = 0; i < frames;)
        {
            const std::size_t n = std::min(longestPiece, frames - i);
            mix(interleaved.subspan(i * channels, n * channels), channels);
            if (probe)
                probe->replace(std::span(mono).first(n), fs);
            const auto made = std::span(drive).first(n);
            note(heard, std::span(mono).first(n));
            translator.process(std::span(mono).first(n), made);
            if (follower)
                follower->process(made, std::span<const float>(back).first(n));
            note(felt, made);
            for (live::LiveDrive* output : outputs)
                output->push(made);
            i += n;
        }
        framesDone.store(framesDone.load(std::memory_order_relaxed) + frames, std::memory_order_relaxed);
    }

    /// Nothing follows. [audio]
    void end() noexcept
    {
        for (live::LiveDrive* output : outputs)
            output->end();
    }

    /// Largest magnitudes since the last call. [message]
    [[nodiscard]] float takeHeard() noexcept { return heard.exchange(0.0f, std::memory_order_relaxed); }
    [[nodiscard]] float takeFelt() noexcept { return felt.exchange(0.0f, std::memory_order_relaxed); }

    [[nodiscard]] std::uint64_t frames() const noexcept { return framesDone.load(std::memory_order_relaxed); }
    [[nodiscard]] double sampleRate() const noexcept { return fs; }
    [[nodiscard]] std::size_t latencyFrames() const noexcept
    {
        return translator.latencyFrames() + (follower ? follower->latencyFrames() : 0);
    }

private:
    static void note(std::atomic<float>& peak, std::span<const float> samples) noexcept
    {
        const float here = largestMagnitude(samples);
        if (here > peak.load(std::memory_order_relaxed))
            peak.store(here, std::memory_order_relaxed);
    }

    void mix(std::span<const float> interleaved, std::size_t channels) noexcept
    {
        const std::size_t apart = follower ? follower->followedChannel() : channels;
        const float share = 1.0f / static_cast<float>(apart < channels ? channels - 1 : channels);
        for (std::size_t i = 0; i < interleaved.size() / channels; ++i)
        {
            float sum = 0.0f;
            const auto frame = interleaved.subspan(i * channels, channels);
            for (std::size_t c = 0; c < channels; ++c)
                if (c != apart)
                    sum += frame[c];
            mono[i] = channels == 1 ? sum : share * sum;
            if (apart < channels)
                back[i] = frame[apart];
        }
    }

    double fs;
    Translator translator;
    std::vector<float> mono;
    std::vector<float> drive;
    std::vector<float> back; ///< of the channel that is followed
    std::vector<live::LiveDrive*> outputs;
    live::LatencyProbe* probe = nullptr;
    LiveFollow* follower = nullptr;
    std::atomic<float> heard{0.0f};
    std::atomic<float> felt{0.0f};
    std::atomic<std::uint64_t> framesDone{0};
};

} // namespace pacini::cli
