#pragma once

// Secrets of a session: a code for one-time pairing, and a token for the paired phone.

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>

namespace pacini::phone
{

/// `length` characters of 5 bits each, of the system's own random numbers; without letters that look alike.
[[nodiscard]] inline std::string randomWord(std::size_t length)
{
    constexpr std::string_view letters = "23456789abcdefghjkmnpqrstuvwxyz_";
    static_assert(letters.size() == 32);
    std::random_device source;
    std::string word;
    for (std::size_t i = 0; i < length; ++i)
        word += letters[source() % letters.size()];
    return word;
}

/// Whether two secrets are the same, in a time that says nothing of where they differ.
[[nodiscard]] inline bool isSameSecret(std::string_view a, std::string_view b) noexcept
{
    if (a.size() != b.size())
        return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
    return difference == 0;
}

} // namespace pacini::phone
