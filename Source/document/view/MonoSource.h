#pragma once

// One channel that a view looks at, wherever its samples are.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Reads sections of a channel. The source must outlive it. [any]
class MonoSource
{
public:
    /// Fills `out` from frame `first` on, with 0 before and after the sound.
    using Read = std::function<void(std::int64_t first, std::span<float> out)>;

    MonoSource(std::size_t frames, Read function) : count(frames), reader(std::move(function)) {}

    /// Samples in memory.
    MonoSource(std::span<const float> samples)
        : MonoSource(samples.size(),
                     [samples](std::int64_t first, std::span<float> out)
                     {
                         const auto end = static_cast<std::int64_t>(samples.size());
                         const auto from = std::clamp<std::int64_t>(first, 0, end);
                         const auto to =
                             std::clamp<std::int64_t>(first + static_cast<std::int64_t>(out.size()), 0, end);
                         std::fill(out.begin(), out.end(), 0.0f);
                         if (from < to)
                             std::copy(samples.begin() + from, samples.begin() + to, out.begin() + (from - first));
                     })
    {
    }

    MonoSource(const std::vector<float>& samples) : MonoSource(std::span<const float>(samples)) {}
    MonoSource(std::vector<float>&&) = delete;

    [[nodiscard]] std::size_t frames() const noexcept { return count; }
    void read(std::int64_t first, std::span<float> out) const { reader(first, out); }

private:
    std::size_t count;
    Read reader;
};

} // namespace pacini
