#pragma once

// Ring: a queue of small values between two threads that never wait.

#include <atomic>
#include <bit>
#include <cstddef>
#include <vector>

namespace pacini
{

/// Bounded queue, one thread that pushes and one that pops; neither waits nor allocates after construction (L. Lamport,
/// "Specifying concurrent program modules", ACM TOPLAS 5(2), 1983). T is copied.
template <typename T>
class Ring
{
public:
    /// Room for `capacity` values at least. Allocates.
    explicit Ring(std::size_t capacity) : values(std::bit_ceil(capacity + 1)) {}
    Ring(const Ring&) = delete;
    Ring& operator=(const Ring&) = delete;

    /// False when it is full. [one thread]
    [[nodiscard]] bool push(const T& value) noexcept
    {
        const std::size_t at = tail.load(std::memory_order_relaxed);
        const std::size_t next = (at + 1) & (values.size() - 1);
        if (next == head.load(std::memory_order_acquire))
            return false;
        values[at] = value;
        tail.store(next, std::memory_order_release);
        return true;
    }

    /// False when it is empty. [the other thread]
    [[nodiscard]] bool pop(T& value) noexcept
    {
        const std::size_t at = head.load(std::memory_order_relaxed);
        if (at == tail.load(std::memory_order_acquire))
            return false;
        value = values[at];
        head.store((at + 1) & (values.size() - 1), std::memory_order_release);
        return true;
    }

    /// Returns the number of values that fit in at least. [the thread that pushes]
    [[nodiscard]] std::size_t room() const noexcept
    {
        const std::size_t used =
            (tail.load(std::memory_order_relaxed) - head.load(std::memory_order_acquire)) & (values.size() - 1);
        return values.size() - 1 - used;
    }

private:
    std::vector<T> values;
    alignas(64) std::atomic<std::size_t> head{0};
    alignas(64) std::atomic<std::size_t> tail{0};
};

} // namespace pacini
