#pragma once

// HID output report, as it goes to a controller.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace pacini::devices
{

/// A report of any of the devices here. Owns no memory: signal handlers can send it.
class Report
{
public:
    static constexpr std::size_t largest = 78;

    Report() = default;

    template <std::size_t size>
    requires(size <= largest) Report(const std::array<std::byte, size>& content)
    noexcept : used(size) { std::copy(content.begin(), content.end(), bytes.begin()); }

    /// At most `largest` bytes.
    explicit Report(std::span<const std::byte> content) noexcept : used(content.size())
    {
        std::copy(content.begin(), content.end(), bytes.begin());
    }

    [[nodiscard]] std::span<const std::byte> content() const noexcept { return std::span(bytes).first(used); }

    bool operator==(const Report&) const = default;

private:
    std::array<std::byte, largest> bytes{};
    std::size_t used = 0;
};

} // namespace pacini::devices
