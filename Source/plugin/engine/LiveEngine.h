// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Live engine of the plugin: all signal processing, without any host.

#include "plugin/engine/ClipPreview.h"
#include "plugin/engine/DriveRouting.h"
#include "plugin/engine/HapticRow.h"
#include "plugin/engine/MainDelay.h"
#include "plugin/engine/ParameterValues.h"
#include "plugin/engine/SilenceWatch.h"
#include "plugin/engine/SourceMix.h"

#include <pacini/realtime/CaptureRing.h>
#include <pacini/realtime/TranslatorMeters.h>
#include <pacini/realtime/TranslatorParams.h>
#include <pacini/realtime/TranslatorSetup.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace pacini
{
class Translator;
}
namespace pacini::live
{
class LiveDrive;
}

namespace pacini::plugin
{

inline constexpr std::size_t maxMainChannels = 16;
inline constexpr std::size_t maxSidechainChannels = 8;
inline constexpr double captureSeconds = 30.0;

/// The channels of one block. The main channels are processed in place. A haptic channel may share the memory of a
/// sidechain channel: all inputs are read before any output is written.
struct EngineBlock
{
    std::span<float* const> main;
    std::span<const float* const> sidechain;
    std::span<float* const> haptic;
    std::size_t frames = 0;
    live::LiveDrive* controller = nullptr; ///< plays the drive of the first haptic channel; null: none
};

/// Translates the sound for each actuator that is in use, once for all channels that share one, and hands the drives
/// to the haptic channels. After long silence it rests until something comes or is changed; the samples are then,
/// within 1e-7, those of an engine that never rests.
class LiveEngine
{
public:
    LiveEngine();
    ~LiveEngine();

    /// Allocates. [message], while no block is processed
    void prepare(double sampleRate, std::size_t mainChannels, std::size_t hapticChannels);

    /// Sets the preview whose clips replace the drive while they play; null: none. [message], before prepare()
    void setClips(HostedProject* wanted) noexcept { clips = wanted; }

    /// Sets whether the engine may rest in silence (default: yes). [message], while no block is processed
    void setRests(bool wanted) noexcept { mayRest = wanted; }
    /// Whether the engine rests now. [audio]
    [[nodiscard]] bool resting() const noexcept { return watch.resting(); }

    /// Resets to the state after prepare(). [audio]
    void reset() noexcept;

    /// Any number of frames. [audio]
    void process(const EngineBlock& block, const ParameterValues& values, bool bypassed) noexcept;

    /// Latency in frames. It is the same at 44.1 and 48 kHz: hosts load plugins at one rate and play at the other, and
    /// compensate the first blocks by the earlier value.
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return latency; }
    [[nodiscard]] double sampleRate() const noexcept { return fs.load(std::memory_order_relaxed); }

    /// Sets the actuator of a channel, which then has its own translation. One thread at a time, and not during
    /// prepare(). [message]
    void setSetup(std::size_t channel, const TranslatorSetup& setup);
    /// Lets a channel play the translation of an earlier channel with a set-up. [message]
    void share(std::size_t channel, std::size_t other) noexcept
    {
        sources[channel].store(other, std::memory_order_release);
        disturbed.store(true, std::memory_order_release);
    }

    /// Returns the meters of the translation that a channel plays.
    [[nodiscard]] TranslatorMeterReading readMeters(std::size_t channel = 0) const noexcept;
    /// Sets the haptic channels that are connected to an output, one bit each; all at first, since a host does not
    /// tell. [any]
    void setConnected(unsigned haptics) noexcept { connected.store(haptics, std::memory_order_relaxed); }
    /// Returns the largest output sample of a channel since the last call, 0 if there is no such channel. [message]
    [[nodiscard]] float takePeak(std::size_t channel) noexcept
    {
        return peaks[channel].exchange(0.0f, std::memory_order_relaxed);
    }
    /// Haptic channels that were played last. [any thread]
    [[nodiscard]] std::size_t channelsInUse() const noexcept { return inUse.load(std::memory_order_relaxed); }
    /// The largest sample of the source since the last call. [message]
    [[nodiscard]] float takeInputPeak() noexcept { return inputPeak.exchange(0.0f, std::memory_order_relaxed); }
    /// The newest of the source. [message]
    [[nodiscard]] Capture capture(double seconds) const;

private:
    static constexpr std::size_t pieceFrames = ClipPreview::pieceFrames;

    void aim(const EngineBlock& block, const ParameterValues& values, bool bypassed) noexcept;
    void piece(std::span<const std::span<float>> main, std::span<const std::span<const float>> sidechain,
               std::span<const std::span<float>> haptic, std::size_t frames, live::LiveDrive* controller) noexcept;

    /// One translation.
    struct Voice
    {
        std::unique_ptr<Translator> translator; ///< null until a channel wants it
        MainDelay late;                         ///< up to the latency of the engine
        bool plays = false;                     ///< some channel listened to it in the last piece
        std::atomic<double> restSeconds{0.0};   ///< see restSeconds()
        std::array<float, pieceFrames> drive{};
    };

    void prepareVoice(Voice& voice) const;
    void followSources(std::size_t frames) noexcept;
    void wake() noexcept;
    [[nodiscard]] bool isStill(std::span<const std::span<float>> main, std::size_t frames) const noexcept;
    [[nodiscard]] std::size_t framesToRest() const noexcept;
    void translate(std::span<const float> in) noexcept;
    void meterPeaks(std::size_t mainChannels, std::size_t frames, bool onController) noexcept;

    std::atomic<double> fs{48000.0};
    std::array<Voice, maxHapticChannels> voices;
    std::array<std::atomic<std::size_t>, maxHapticChannels> sources{}; ///< the voice that each channel shall play
    std::array<std::size_t, maxHapticChannels> playing{};              ///< that it does
    std::array<std::size_t, maxHapticChannels> settling{};             ///< frames until that is heard
    bool begun = false;
    bool mayRest = true;
    SilenceWatch watch;
    std::atomic<bool> disturbed{false}; ///< what is played was changed
    ParameterValues seen;               ///< in the last block
    bool seenBypass = false;
    std::array<std::size_t, 3> seenChannels{};
    SourceMix mix;
    std::size_t latency = 0;
    MainDelay delay;
    ClipPreview preview;
    HostedProject* clips = nullptr;
    HapticRow row;
    DriveRouting routing;
    CaptureRing ring;
    TranslatorParams params;
    std::size_t channels = 1; ///< in use
    bool hearsSidechain = false;
    std::atomic<std::size_t> inUse{1};
    std::atomic<unsigned> connected{~0u};
    std::atomic<float> inputPeak{0.0f};
    std::array<std::atomic<float>, maxHapticChannels> peaks{};
    std::array<float, pieceFrames> source{};
    std::array<std::array<float, pieceFrames>, maxHapticChannels> drives{};
};

} // namespace pacini::plugin
