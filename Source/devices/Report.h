#pragma once

// HID report for a controller.

#include <array>
#include <cstddef>
#include <span>

namespace pacini::devices
{

/// Direction of a report.
enum class ReportWay
{
    output,
    feature, ///< the first byte is its number, 0 where reports have none
};

/// A report of any of the devices here. Owns no memory: signal handlers can send it.
class Report
{
public:
    static constexpr std::size_t largest = 398; // 0x36 of a DualSense

    Report() = default;

    template <std::size_t size>
    requires(size <= largest) Report(const std::array<std::byte, size>& content)
    noexcept : Report(std::span<const std::byte>(content)) {}

    /// At most `largest` bytes.
    explicit Report(std::span<const std::byte> content, ReportWay goes = ReportWay::output) noexcept;

    [[nodiscard]] std::span<const std::byte> content() const noexcept { return std::span(bytes).first(used); }

    [[nodiscard]] bool isFeature() const noexcept { return way == ReportWay::feature; }

    bool operator==(const Report&) const = default;

private:
    std::array<std::byte, largest> bytes{};
    std::size_t used = 0;
    ReportWay way = ReportWay::output;
};

} // namespace pacini::devices
