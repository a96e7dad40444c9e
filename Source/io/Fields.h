#pragma once

// What the entries of a JSON document are: words that readers and writers share.

#include <array>
#include <cstddef>
#include <string_view>

namespace pacini
{

/// A name in the file for one value of an enumeration.
template <typename E>
struct Choice
{
    std::string_view name;
    E value;
};

/// The name of `value` in a file.
template <typename E, std::size_t Count>
[[nodiscard]] constexpr std::string_view nameOf(E value, const std::array<Choice<E>, Count>& choices) noexcept
{
    for (const auto& choice : choices)
        if (choice.value == value)
            return choice.name;
    return {};
}

/// Whether an entry must be in the file; others keep the default of their struct when they are missing.
enum class Need
{
    required,
    usual,   ///< may be missing, but is always written
    optional ///< an object that is not written when it equals its default
};

} // namespace pacini
