#pragma once

// Measurement of the time from an impulse in the sound to the report that plays it.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace pacini::live
{

/// Plays impulses in place of the sound. An impulse begins with its block, and so its time is that at which the block
/// began: a block before it arrived. The time ends with the first report that is not silent, when the system has taken
/// it. What a sound card, a radio link and a motor add is not in it.
class LatencyProbe
{
public:
    LatencyProbe() { results.reserve(most); }

    /// [audio]
    void begin(std::size_t frames, double fs) noexcept
    {
        const auto now = clock();
        if (next == 0)
            next = now + 1'000'000'000; // a controller is opened meanwhile
        if (frames == 0 || now < next)
            return;
        next = now + 437'000'000; // no multiple of any interval between packets
        at = 0;
        begun.store(now - static_cast<std::int64_t>(1e9 * static_cast<double>(frames) / fs), std::memory_order_release);
    }

    /// [audio]
    void replace(std::span<float> sound, double fs) noexcept
    {
        const auto length = static_cast<std::size_t>(0.005 * fs);
        for (float& sample : sound)
        {
            sample = at < length ? static_cast<float>(0.9 * std::sin(2.0 * std::numbers::pi * static_cast<double>(at) /
                                                                     static_cast<double>(length)))
                                 : 0.0f;
            at = std::min(at + 1, length);
        }
    }

    /// A report that is not silent was sent. [worker]
    void sent()
    {
        const std::int64_t since = begun.exchange(0, std::memory_order_acquire);
        if (since != 0 && results.size() < most)
            results.push_back(1e-9 * static_cast<double>(clock() - since));
    }

    /// Seconds, in order of their size; the worker has ended. [message]
    [[nodiscard]] std::vector<double> measured() const
    {
        auto sorted = results;
        std::sort(sorted.begin(), sorted.end());
        return sorted;
    }

private:
    static constexpr std::size_t most = 10000;

    [[nodiscard]] static std::int64_t clock() noexcept
    {
        return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
            .count();
    }

    std::int64_t next = 0; ///< ns, as the others
    std::size_t at = static_cast<std::size_t>(-1);
    std::atomic<std::int64_t> begun{0};
    std::vector<double> results;
};

} // namespace pacini::live
