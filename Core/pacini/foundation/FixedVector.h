#pragma once

// Vector of fixed capacity with inline storage, for code that must not allocate.

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <initializer_list>

namespace pacini
{

/// Up to `Capacity` elements of a default-constructible T. An element beyond the capacity is the caller's error
/// (asserted) and is dropped.
template <typename T, std::size_t Capacity>
class FixedVector
{
public:
    constexpr FixedVector() = default;
    constexpr FixedVector(std::initializer_list<T> values) noexcept
    {
        for (const T& value : values)
            pushBack(value);
    }

    constexpr void pushBack(const T& value) noexcept
    {
        assert(count < Capacity);
        if (count < Capacity)
            elements[count++] = value;
    }
    constexpr void clear() noexcept { count = 0; }

    /// Removes the first element and moves the others up.
    constexpr void popFront() noexcept
    {
        assert(count > 0);
        std::move(begin() + 1, end(), begin());
        --count;
    }

    [[nodiscard]] static constexpr std::size_t capacity() noexcept { return Capacity; }
    [[nodiscard]] constexpr std::size_t size() const noexcept { return count; }
    [[nodiscard]] constexpr bool empty() const noexcept { return count == 0; }

    [[nodiscard]] constexpr T& operator[](std::size_t i) noexcept
    {
        assert(i < count);
        return elements[i];
    }
    [[nodiscard]] constexpr const T& operator[](std::size_t i) const noexcept
    {
        assert(i < count);
        return elements[i];
    }
    [[nodiscard]] constexpr const T& front() const noexcept { return (*this)[0]; }
    [[nodiscard]] constexpr const T& back() const noexcept { return (*this)[count - 1]; }

    [[nodiscard]] constexpr T* begin() noexcept { return elements.data(); }
    [[nodiscard]] constexpr T* end() noexcept { return elements.data() + count; }
    [[nodiscard]] constexpr const T* begin() const noexcept { return elements.data(); }
    [[nodiscard]] constexpr const T* end() const noexcept { return elements.data() + count; }

    constexpr bool operator==(const FixedVector& other) const noexcept
    {
        return std::equal(begin(), end(), other.begin(), other.end());
    }

private:
    std::array<T, Capacity> elements{};
    std::size_t count = 0;
};

} // namespace pacini
