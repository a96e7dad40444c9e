#pragma once

// Parser of HID report descriptors: lists the fields in the reports of a device.

#include <pacini/foundation/Result.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pacini::devices
{

/// The meaning of a value or of a collection: its page in the upper half, its number on the page in the lower.
using HidUsage = std::uint32_t;

[[nodiscard]] constexpr HidUsage hidUsage(std::uint16_t page, std::uint16_t number) noexcept
{
    return HidUsage{page} << 16 | number;
}

enum class HidReportType
{
    input,
    output,
    feature,
};

/// One number in a report. The physical range is that of the device's units; 0..0 stands for the logical one.
struct HidField
{
    HidReportType type = HidReportType::input;
    std::uint8_t report = 0; ///< its number; 0 where reports have none
    std::uint32_t bit = 0;   ///< where it starts, from the lowest bit of the byte after the report's number on
    std::uint8_t bits = 0;   ///< 1..32
    HidUsage usage = 0;
    HidUsage collection = 0; ///< the innermost
    std::int64_t logicalMinimum = 0;
    std::int64_t logicalMaximum = 0;
    std::int64_t physicalMinimum = 0;
    std::int64_t physicalMaximum = 0;
};

struct HidReports
{
    std::vector<HidField> fields; ///< in the order of the descriptor

    /// How long a report is, with its number before it, which is 0 where reports have none; 1 for one without content.
    [[nodiscard]] std::size_t bytesOf(HidReportType type, std::uint8_t report) const noexcept
    {
        return 1 + (bits[static_cast<std::size_t>(type)][report] + 7) / 8;
    }

    std::array<std::array<std::uint32_t, 256>, 3> bits{}; ///< of content, by type and number
};

/// Reads a report descriptor and keeps the variables of up to 32 bits within collections of the usage `within`, however
/// deep; of others only the lengths of reports are told. Values of usages that stand in delimiters have the first of
/// them. Source: USB-IF, Device Class Definition for Human Interface Devices 1.11, 5.8 and 6.2.2. As Linux does, it
/// takes maxima as unsigned when the minimum is not negative: many devices call 255 0xFF in one byte.
/// Errors, with the byte at which it went wrong: `truncated`; `tooLarge` for reports above 16384 bytes, more than 256
/// kept values, or more than 16 collections or pushed states within each other; `invalidData` for what else breaks the
/// rules. [any]
[[nodiscard]] Result<HidReports> parseHidDescriptor(std::span<const std::byte> descriptor, HidUsage within);

} // namespace pacini::devices
