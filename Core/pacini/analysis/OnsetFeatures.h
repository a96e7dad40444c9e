#pragma once

// Feature extraction for onset detection: samples of any rate and channel count -> OnsetFrames.

#include <pacini/analysis/OnsetBands.h>
#include <pacini/analysis/OnsetFrame.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace pacini
{

/// Measures the short-time powers for onset detection, piece by piece, in bounded memory. push() samples, read
/// frames(), drop() the frames read; finish() once at the end. The frames do not depend on the sizes of the pieces. Not
/// real-time: allocates.
class OnsetFeatures
{
public:
    /// `sampleRate` from 2 kHz to 768 kHz, at least one channel.
    OnsetFeatures(double sampleRate, std::size_t channelCount)
        : fs(sampleRate),
          firstFrame(static_cast<std::size_t>(std::ceil(sampleRate / OnsetFrame::rate))),
          channels(channelCount, OnsetBands(sampleRate)),
          offsets(channelCount, 0.0f)
    {
        assert(sampleRate >= 2000.0 && sampleRate <= 768000.0 && channelCount > 0);
    }

    /// Adds whole frames of interleaved samples, all finite.
    void push(std::span<const float> interleaved)
    {
        assert(interleaved.size() % channels.size() == 0);
        if (started)
        {
            process(interleaved);
            return;
        }
        // The DC offset is read from the first millisecond, so nothing happens before it is complete.
        head.insert(head.end(), interleaved.begin(), interleaved.end());
        if (head.size() >= firstFrame * channels.size())
            start();
    }

    /// Completes the frames up to the end of the sound; the last one may be partial. No push() after it.
    void finish()
    {
        if (!started && !head.empty())
            start();
        if (length == 0)
            return;
        const auto limit = static_cast<std::int64_t>(std::ceil(static_cast<double>(length) * OnsetFrame::rate / fs));
        for (OnsetBands& channel : channels)
            channel.mirrorEnd();
        emit(limit);
    }

    /// The frames that are complete and not yet dropped.
    [[nodiscard]] std::span<const OnsetFrame> frames() const noexcept { return ready; }

    /// Forgets the first `count` of frames().
    void drop(std::size_t count)
    {
        ready.erase(ready.begin(), ready.begin() + static_cast<std::ptrdiff_t>(count));
        dropped += static_cast<std::int64_t>(count);
    }

private:
    static constexpr std::size_t blockFrames = 4096;

    void start()
    {
        // The median: a click in the first millisecond is no offset.
        const std::size_t count = std::min(firstFrame, head.size() / channels.size());
        std::vector<float> sorted(count);
        for (std::size_t c = 0; c < channels.size(); ++c)
        {
            for (std::size_t i = 0; i < count; ++i)
                sorted[i] = head[i * channels.size() + c];
            std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count / 2), sorted.end());
            offsets[c] = sorted[count / 2];
        }
        started = true;
        process(head);
        head = {};
    }

    void process(std::span<const float> interleaved)
    {
        const std::size_t stride = channels.size();
        const std::size_t count = interleaved.size() / stride;
        for (std::size_t done = 0; done < count; done += blockFrames)
        {
            const std::size_t n = std::min(blockFrames, count - done);
            const float* block = interleaved.data() + done * stride;
            for (std::size_t c = 0; c < stride; ++c)
                channels[c].push(block + c, static_cast<std::ptrdiff_t>(stride), static_cast<std::ptrdiff_t>(n),
                                 offsets[c]);
            length += n;
            emit(std::numeric_limits<std::int64_t>::max());
        }
    }

    void emit(std::int64_t limit)
    {
        const float weight = 1.0f / static_cast<float>(channels.size());
        for (OnsetBands& channel : channels)
            channel.emit(ready, dropped, limit, weight);
    }

    double fs;
    std::size_t firstFrame; ///< samples in the first frame
    std::vector<OnsetBands> channels;
    std::vector<float> offsets; ///< DC of each channel
    std::vector<float> head;    ///< samples before the start
    std::vector<OnsetFrame> ready;
    std::int64_t dropped = 0;
    std::uint64_t length = 0; ///< samples per channel so far
    bool started = false;
};

} // namespace pacini
