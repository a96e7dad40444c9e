#pragma once

// Sliding buffer: the part of an endless sequence that is still needed.

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pacini
{

/// Elements [begin, end) of a sequence that grows at its end and is forgotten at its beginning. Indices count from the
/// start of the sequence and stay the same, in 64 bits on every machine: days of samples come to more than 32 bits
/// count. Memory is bounded by what forget() leaves. Allocates when it grows.
template <typename T>
class SlidingBuffer
{
public:
    /// Holds `history` zeros before index `end`, the index of the first element to come.
    explicit SlidingBuffer(std::ptrdiff_t history, std::int64_t end = 0)
        : elements(static_cast<std::size_t>(history)), first(end - history)
    {
    }

    /// Index after the last element.
    [[nodiscard]] std::int64_t end() const noexcept { return first + std::ssize(elements); }

    /// Number of elements that are missing up to `index`; 0 if none is.
    [[nodiscard]] std::ptrdiff_t missingTo(std::int64_t index) const noexcept
    {
        return static_cast<std::ptrdiff_t>(std::max<std::int64_t>(index - end(), 0));
    }

    /// Pointer to element `index`, which must not be forgotten. Its neighbours precede and follow it in memory.
    [[nodiscard]] const T* at(std::int64_t index) const noexcept
    {
        assert(index >= first && index <= end());
        return elements.data() + (index - first);
    }

    /// Adds `count` zeros and returns where they are.
    T* extend(std::ptrdiff_t count)
    {
        const std::size_t old = elements.size();
        elements.resize(old + static_cast<std::size_t>(count));
        return elements.data() + old;
    }

    /// Declares that nothing before `index` will be read again.
    void forget(std::int64_t index)
    {
        // Moving the rest down costs time, so it waits until more is dropped than kept.
        const std::int64_t unused = index - first;
        if (2 * unused <= std::ssize(elements))
            return;
        elements.erase(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(unused));
        first = index;
    }

private:
    std::vector<T> elements;
    std::int64_t first;
};

} // namespace pacini
