#pragma once

// Playback of trials in the callback of a sound device: sound and touch start at the same sample.

#include "study/TrialSound.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace pacini::study
{

/// Outcome of a started trial.
struct PlaybackReport
{
    bool playing = false;
    bool complete = false;                        ///< it was played to its end
    std::size_t frame = 0;                        ///< that is played next
    int dropouts = 0;                             ///< while it played
    std::optional<double> soundOnset, touchOnset; ///< s of the device's clock, which counts its frames
};

/// One trial at a time. Every call but process() and drop() from one thread. [message]
class TrialPlayback
{
public:
    /// Prepares for the start of the device; its clock starts at 0.
    void prepare(double sampleRate) noexcept;

    /// Starts a trial at the next block and stops the present one.
    void play(TrialSound trial);

    /// Fades out within 5 ms.
    void stop() noexcept;

    [[nodiscard]] PlaybackReport report() const noexcept;

    /// Fills the block for both ears and each actuator of the row; all of the same length, and not null. Actuators that
    /// the trial does not have stay silent. [audio]
    void process(std::span<float> left, std::span<float> right, std::span<const std::span<float>> touches) noexcept;

    /// The same for one actuator. [audio]
    void process(std::span<float> left, std::span<float> right, std::span<float> touch) noexcept
    {
        process(left, right, std::span<const std::span<float>>(&touch, 1));
    }

    /// Something dropped out: the device reported it, or stopped. [audio]
    void drop() noexcept;

    ~TrialPlayback();
    TrialPlayback() = default;
    TrialPlayback(const TrialPlayback&) = delete;
    TrialPlayback& operator=(const TrialPlayback&) = delete;

private:
    struct Running
    {
        TrialSound trial;
        std::size_t next = 0;
    };

    void collect() noexcept;

    // The message thread hands a trial over by `given` and takes played ones back by `done`.
    std::atomic<Running*> given{nullptr};
    std::atomic<Running*> done{nullptr};
    Running* current = nullptr; ///< of the audio thread
    std::int64_t clock = 0;     ///< frames, of the audio thread
    double gain = 1.0;          ///< of a fade, of the audio thread
    std::atomic<double> fs{48000.0};
    std::atomic<bool> stopping{false};
    std::atomic<bool> playing{false};
    std::atomic<bool> complete{false};
    std::atomic<std::size_t> frame{0};
    std::atomic<int> dropouts{0};
    std::atomic<std::int64_t> startFrame{-1};
    std::optional<std::size_t> soundAt, touchAt; ///< of the trial that was given last
};

} // namespace pacini::study
