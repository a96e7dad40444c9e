#pragma once

// Queue of a drive signal between the thread that makes it and one that plays it.

#include <pacini/foundation/Ring.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pacini::live
{

/// One thread pushes, one takes; neither waits. While nobody listens, what is pushed is forgotten: after a controller
/// comes back it plays what sounds now, not what sounded meanwhile.
class LiveDrive
{
public:
    /// Room for `frames`. Allocates.
    explicit LiveDrive(std::size_t frames) : ring(frames) {}

    /// What has no room is lost and counted. [audio]
    void push(std::span<const float> drive) noexcept
    {
        if (!listening.load(std::memory_order_acquire))
            return;
        const std::size_t fitting = std::min(drive.size(), ring.room());
        for (const float sample : drive.first(fitting))
            static_cast<void>(ring.push(sample));
        pushed.store(pushed.load(std::memory_order_relaxed) + fitting, std::memory_order_release);
        lostFrames.store(lostFrames.load(std::memory_order_relaxed) + (drive.size() - fitting),
                         std::memory_order_relaxed);
    }

    /// How many frames fit in now. [audio]
    [[nodiscard]] std::size_t room() const noexcept { return ring.room(); }

    /// Nothing follows. [audio]
    void end() noexcept { ended.store(true, std::memory_order_release); }

    /// Takes the oldest frames; how many there were. [worker]
    [[nodiscard]] std::size_t take(std::span<float> frames) noexcept
    {
        std::size_t got = 0;
        while (got < frames.size() && ring.pop(frames[got]))
            ++got;
        taken.store(taken.load(std::memory_order_relaxed) + got, std::memory_order_release);
        return got;
    }

    /// Frames that are there to be taken. [any]
    [[nodiscard]] std::size_t waiting() const noexcept
    {
        const std::uint64_t all = pushed.load(std::memory_order_acquire);
        const std::uint64_t gone = taken.load(std::memory_order_relaxed);
        return all > gone ? static_cast<std::size_t>(all - gone) : 0;
    }

    [[nodiscard]] bool hasEnded() const noexcept { return ended.load(std::memory_order_acquire); }

    /// Whether all is taken and nothing follows. [any]
    [[nodiscard]] bool isOver() const noexcept { return hasEnded() && waiting() == 0; }

    /// Begins to keep what is pushed, or ceases to. What is left from before is dropped. [worker]
    void listen(bool wanted) noexcept
    {
        listening.store(wanted, std::memory_order_release);
        float dropped[64];
        while (take(dropped) > 0)
        {
        }
    }

    /// Frames that found no room. [any]
    [[nodiscard]] std::uint64_t lost() const noexcept { return lostFrames.load(std::memory_order_relaxed); }

private:
    Ring<float> ring;
    std::atomic<std::uint64_t> pushed{0};
    std::atomic<std::uint64_t> taken{0};
    std::atomic<std::uint64_t> lostFrames{0};
    std::atomic<bool> listening{true};
    std::atomic<bool> ended{false};
};

} // namespace pacini::live
