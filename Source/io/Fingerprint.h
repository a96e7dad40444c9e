#pragma once

// Fast non-cryptographic hash of bytes, for detecting changes.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace pacini
{

/// FNV-1a of 64 bits (G. Fowler, L. C. Noll, K.-P. Vo, 1991): several times as fast as sha256(), for large files that
/// are checked for edits, not for forgeries.
class Fingerprint
{
public:
    void add(std::span<const std::byte> bytes) noexcept
    {
        for (const std::byte b : bytes)
            state = (state ^ static_cast<std::uint64_t>(b)) * 0x100000001B3ull;
    }
    void add(std::string_view text) noexcept { add(std::as_bytes(std::span<const char>(text))); }

    [[nodiscard]] std::uint64_t value() const noexcept { return state; }

    /// 16 hexadecimal digits.
    [[nodiscard]] std::string text() const
    {
        std::string digits(16, '0');
        for (std::size_t i = 0; i < digits.size(); ++i)
            digits[i] = "0123456789abcdef"[(state >> (60 - 4 * i)) & 15u];
        return digits;
    }

private:
    std::uint64_t state = 0xCBF29CE484222325ull;
};

} // namespace pacini
