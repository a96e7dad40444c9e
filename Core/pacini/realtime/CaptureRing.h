#pragma once

// Capture buffer: the last minutes of a sound, kept by the audio thread for whoever wants to encode them.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace pacini
{

/// Frames of a capture and where they begin, counted from reset.
struct Capture
{
    std::uint64_t firstFrame = 0;
    std::vector<float> samples;
};

/// A ring of mono samples with one writer that never waits. A reader copies while the writer goes on. The writer
/// announces which frames it is about to write, writes them, and says that they are there; the reader copies what is
/// there, then looks at the announcements: frames that may have been overwritten meanwhile are those more than a ring's
/// length before the newest announcement, and they are dropped from the copy's beginning (the protocol of H.-J. Boehm,
/// "Can seqlocks get along with programming language memory models?", MSPC 2012, with positions instead of a sequence
/// number, so that a copy never fails as a whole). Samples are atomics of their own,
/// plain moves on x86.
class CaptureRing
{
public:
    /// Room for `frames` (at least 1). Allocates; neither writer nor reader may be at work. [message]
    void prepare(std::size_t frames)
    {
        capacity = std::max<std::size_t>(frames, 1);
        ring = std::make_unique<std::atomic<float>[]>(capacity);
        reset();
    }

    /// Forgets everything; no reader may be at work. [audio]
    void reset() noexcept
    {
        announced.store(0, std::memory_order_relaxed);
        written.store(0, std::memory_order_release);
    }

    /// Keeps the newest frames. [audio]
    void push(std::span<const float> in) noexcept
    {
        if (!ring)
            return;
        std::uint64_t position = written.load(std::memory_order_relaxed);
        if (in.size() > capacity)
        {
            position += in.size() - capacity;
            in = in.last(capacity);
        }
        const std::uint64_t end = position + in.size();
        announced.store(end, std::memory_order_relaxed);
        auto at = static_cast<std::size_t>(position % capacity);
        for (const float sample : in)
        {
            ring[at].store(sample, std::memory_order_release); // whoever sees it sees its announcement
            at = at + 1 == capacity ? 0 : at + 1;
        }
        written.store(end, std::memory_order_release);
    }

    /// A copy of the newest `frames` or as many as there are and survive the copying. Allocates. [message]
    [[nodiscard]] Capture newest(std::size_t frames) const
    {
        Capture capture;
        if (!ring)
            return capture;
        const std::uint64_t end = written.load(std::memory_order_acquire);
        const std::uint64_t wanted = std::min<std::uint64_t>({frames, capacity, end});
        capture.firstFrame = end - wanted;
        capture.samples.resize(static_cast<std::size_t>(wanted));
        auto at = static_cast<std::size_t>(capture.firstFrame % capacity);
        for (float& sample : capture.samples)
        {
            sample = ring[at].load(std::memory_order_acquire);
            at = at + 1 == capacity ? 0 : at + 1;
        }
        const std::uint64_t newestEnd = announced.load(std::memory_order_relaxed);
        const std::uint64_t oldest = newestEnd > capacity ? newestEnd - capacity : 0;
        if (oldest > capture.firstFrame)
        {
            const auto lost = std::min<std::uint64_t>(oldest - capture.firstFrame, wanted);
            capture.samples.erase(capture.samples.begin(), capture.samples.begin() + static_cast<std::ptrdiff_t>(lost));
            capture.firstFrame += lost;
        }
        return capture;
    }

    [[nodiscard]] std::size_t capacityFrames() const noexcept { return capacity; }

private:
    std::unique_ptr<std::atomic<float>[]> ring;
    std::size_t capacity = 0;
    std::atomic<std::uint64_t> announced{0};
    std::atomic<std::uint64_t> written{0};
};

} // namespace pacini
