#pragma once

// Synchronous playback and recording: plays the sweeps and records the sensors in one go.

#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Result.h>
#include <pacini/linearize/SweepSchedule.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// State of a run.
enum class PlayAndRecordState
{
    idle,
    playing,
    finished
};

/// Plays a signal once and records one to three inputs from the same frame on, so that their latency is that of the
/// converters and of the device, and the same in every measurement with one setting. One message thread prepares,
/// starts, watches and takes the recording away; one audio thread calls process().
class PlayAndRecord
{
public:
    static constexpr std::size_t maxChannels = 3;

    /// [message] Makes room for the sweeps of `params` and `tail` s (0 to 60) of more recording, for the latency. Not
    /// while process() may run. Errors: those of validate(params); invalidArgument at `channels` for other than 1 to 3,
    /// at `tail`.
    [[nodiscard]] Result<void> prepare(const SweepParams& params, std::size_t channels, double tail = 0.5)
    {
        auto made = makeSweepSignal(params);
        if (!made)
            return made.error();
        return prepare(std::move(made).value(), params.sampleRate, channels, tail);
    }

    /// The same for the samples of a measurement at `sampleRate` Hz, such as sweeps through an equalizer.
    [[nodiscard]] Result<void> prepare(std::vector<float> samples, double sampleRate, std::size_t channels,
                                       double tail = 0.5)
    {
        if (channels < 1 || channels > maxChannels)
            return Error{ErrorCode::invalidArgument, "channels", "must be 1 to 3"};
        if (!(tail >= 0.0 && tail <= 60.0))
            return Error{ErrorCode::invalidArgument, "tail", "must be 0 to 60 s"};
        signal = std::move(samples);
        const std::size_t frames = signal.size() + static_cast<std::size_t>(std::lround(tail * sampleRate));
        recorded.assign(channels, std::vector<float>(frames, 0.0f));
        position = 0;
        progressFrames.store(0, std::memory_order_relaxed);
        current.store(PlayAndRecordState::idle, std::memory_order_release);
        return {};
    }

    /// [message] Starts with the next call of process(); restarts a measurement that runs or has ended. Does nothing
    /// before prepare().
    void start() noexcept
    {
        if (!recorded.empty())
            command.store(Command::start, std::memory_order_release);
    }

    /// [message] Falls silent with the next call of process(), idle again.
    void stop() noexcept { command.store(Command::stop, std::memory_order_release); }

    /// [any]
    [[nodiscard]] PlayAndRecordState state() const noexcept { return current.load(std::memory_order_acquire); }

    /// [any] 0 to 1.
    [[nodiscard]] double progress() const noexcept
    {
        if (recorded.empty())
            return 0.0;
        return static_cast<double>(progressFrames.load(std::memory_order_relaxed)) /
               static_cast<double>(recorded.front().size());
    }

    /// [message] The largest magnitude of an input since the last call, also while idle, to set its gain by; infinite
    /// after a sample that is not finite. 0 for inputs that do not exist. One caller only.
    [[nodiscard]] float takePeak(std::size_t channel) noexcept
    {
        return channel < maxChannels ? peaks[channel].exchange(0.0f, std::memory_order_relaxed) : 0.0f;
    }

    /// [message] The channels once the state is finished, of equal length, for analyseSweeps(); unchanged until
    /// start(). Empty before.
    [[nodiscard]] std::span<const std::vector<float>> recording() const noexcept
    {
        return state() == PlayAndRecordState::finished ? std::span<const std::vector<float>>(recorded)
                                                       : std::span<const std::vector<float>>();
    }

    /// [audio] Writes the next frames of the signal, zeros when there is nothing to play, and keeps what came in.
    /// `inputs`: any number of channels of out.size() frames each; missing ones record as silence, further ones are
    /// ignored. An input may be the memory of `out`.
    void process(std::span<const std::span<const float>> inputs, std::span<float> out) noexcept
    {
        switch (command.exchange(Command::none, std::memory_order_acq_rel))
        {
        case Command::start:
            position = 0;
            current.store(PlayAndRecordState::playing, std::memory_order_release);
            break;
        case Command::stop:
            current.store(PlayAndRecordState::idle, std::memory_order_release);
            break;
        case Command::none:
            break;
        }
        measurePeaks(inputs, out.size());
        if (current.load(std::memory_order_relaxed) != PlayAndRecordState::playing)
        {
            std::fill(out.begin(), out.end(), 0.0f);
            return;
        }
        const std::size_t count = std::min(out.size(), recorded.front().size() - position);
        for (std::size_t c = 0; c < recorded.size(); ++c)
        {
            float* target = recorded[c].data() + position;
            if (c < inputs.size())
                std::copy_n(inputs[c].begin(), count, target);
            else
                std::fill_n(target, count, 0.0f);
        }
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = position + i < signal.size() ? signal[position + i] : 0.0f;
        position += count;
        progressFrames.store(position, std::memory_order_relaxed);
        if (position == recorded.front().size())
            current.store(PlayAndRecordState::finished, std::memory_order_release);
    }

private:
    enum class Command
    {
        none,
        start,
        stop
    };

    void measurePeaks(std::span<const std::span<const float>> inputs, std::size_t frames) noexcept
    {
        for (std::size_t c = 0; c < std::min(inputs.size(), maxChannels); ++c)
        {
            float largest = 0.0f;
            for (std::size_t i = 0; i < frames; ++i)
            {
                const float magnitude = std::abs(inputs[c][i]);
                largest = magnitude > largest ? magnitude : largest;
                if (!(magnitude <= std::numeric_limits<float>::max()))
                    largest = std::numeric_limits<float>::infinity();
            }
            // A peak that the message thread takes at this moment may be counted twice, never lost.
            if (largest > peaks[c].load(std::memory_order_relaxed))
                peaks[c].store(largest, std::memory_order_relaxed);
        }
    }

    std::vector<float> signal;
    std::vector<std::vector<float>> recorded;
    std::size_t position = 0; // of the audio thread
    std::atomic<std::size_t> progressFrames{0};
    std::atomic<PlayAndRecordState> current{PlayAndRecordState::idle};
    std::atomic<Command> command{Command::none};
    std::array<std::atomic<float>, maxChannels> peaks{};
};

} // namespace pacini
