// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Live engine of the plugin: all signal processing, without any host.

#include "plugin/engine/ClipPreview.h"
#include "plugin/engine/DriveRouting.h"
#include "plugin/engine/MainDelay.h"
#include "plugin/engine/ParameterValues.h"
#include "plugin/engine/SourceMix.h"

#include <pacini/realtime/CaptureRing.h>
#include <pacini/realtime/Translator.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini::plugin
{

inline constexpr std::size_t maxMainChannels = 16;
inline constexpr std::size_t maxSidechainChannels = 8;
inline constexpr std::size_t maxHapticChannels = 8;
inline constexpr double captureSeconds = 30.0;

/// The channels of one block. Main goes in and comes out in place. A haptic channel may lie in the memory of a
/// sidechain channel: what goes in is read before anything is written.
struct EngineBlock
{
    std::span<float* const> main;
    std::span<const float* const> sidechain;
    std::span<float* const> haptic;
    std::size_t frames = 0;
};

class LiveEngine
{
public:
    /// Allocates. [message], while no block is processed
    void prepare(double sampleRate, std::size_t mainChannels);

    /// Whose clips are heard in the place of the drive while they play; null: nobody's. [message], before prepare()
    void setClips(HostedProject* wanted) noexcept { clips = wanted; }

    /// As freshly prepared. [audio]
    void reset() noexcept;

    /// Any number of frames. [audio]
    void process(const EngineBlock& block, const ParameterValues& values, bool bypassed) noexcept;

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return translator.latencyFrames(); }
    [[nodiscard]] double sampleRate() const noexcept { return fs.load(std::memory_order_relaxed); }

    /// The set-up of the translator: one thread at a time, and not while prepare() runs. [message]
    void setSetup(const TranslatorSetup& setup) { translator.setSetup(setup); }

    [[nodiscard]] TranslatorMeterReading readMeters() const noexcept { return translator.meters().read(); }
    /// The largest sample of the source since the last call. [message]
    [[nodiscard]] float takeInputPeak() noexcept { return inputPeak.exchange(0.0f, std::memory_order_relaxed); }
    /// The newest of the source. [message]
    [[nodiscard]] Capture capture(double seconds) const;

private:
    static constexpr std::size_t pieceFrames = ClipPreview::pieceFrames;

    void piece(std::span<const std::span<float>> main, std::span<const std::span<const float>> sidechain,
               std::span<const std::span<float>> haptic, std::size_t frames) noexcept;

    std::atomic<double> fs{48000.0};
    Translator translator;
    SourceMix mix;
    MainDelay delay;
    ClipPreview preview;
    HostedProject* clips = nullptr;
    DriveRouting routing;
    CaptureRing ring;
    std::atomic<float> inputPeak{0.0f};
    std::array<float, pieceFrames> source{};
    std::array<float, pieceFrames> drive{};
};

} // namespace pacini::plugin
