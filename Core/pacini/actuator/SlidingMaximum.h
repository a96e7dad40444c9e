#pragma once

// Sliding-window maximum: the largest of the newest values.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pacini
{

/// The maximum over a window that slides with time (D. Lemire, "Streaming maximum-minimum filter using no more than
/// three comparisons per element", Nordic Journal of Computing 13, 2006): of the values in the window only those are
/// kept that no later one reaches. A frame costs a constant on average; one frame alone can cost as many steps as the
/// window is long, but only after as many cheap ones.
class SlidingMaximum
{
public:
    /// Allocates room for windows of up to `maxFrames`, 1 at least.
    void prepare(std::size_t maxFrames)
    {
        kept.assign(std::max<std::size_t>(maxFrames, 1), {});
        setLength(length);
        reset();
    }

    /// The newest `frames` values count, 1 at least and at most what there is room for.
    void setLength(std::size_t frames) noexcept
    {
        length = std::clamp<std::size_t>(frames, 1, kept.size());
        dropOld();
    }

    void reset() noexcept { count = 0; }

    /// Whether no value is in the window.
    [[nodiscard]] bool empty() const noexcept { return count == 0; }

    /// The largest value in the window, which must not be empty.
    [[nodiscard]] double largest() const noexcept { return kept[first].value; }

    /// The next frame, with a value.
    void push(double value) noexcept
    {
        skip();
        while (count > 0 && kept[at(count - 1)].value <= value)
            --count;
        kept[at(count)] = {value, now};
        ++count;
    }

    /// The next frame, which has no value.
    void skip() noexcept
    {
        ++now;
        dropOld();
    }

private:
    struct Kept
    {
        double value = 0.0;
        std::uint64_t frame = 0;
    };

    [[nodiscard]] std::size_t at(std::size_t i) const noexcept
    {
        const std::size_t index = first + i;
        return index < kept.size() ? index : index - kept.size();
    }

    void dropOld() noexcept
    {
        while (count > 0 && now - kept[first].frame >= length)
        {
            first = at(1);
            --count;
        }
    }

    std::vector<Kept> kept = std::vector<Kept>(1); ///< a ring, oldest and largest first
    std::size_t first = 0;
    std::size_t count = 0;
    std::size_t length = 1;
    std::uint64_t now = 0;
};

} // namespace pacini
