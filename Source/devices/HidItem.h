#pragma once

// One item of a HID report descriptor.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace pacini::devices
{

/// A prefix and up to four bytes. Source: HID 1.11, 6.2.2.2.
struct HidItem
{
    enum Type
    {
        mainType = 0,
        globalType = 1,
        localType = 2,
        reservedType = 3,
    };
    int type = 0;
    int tag = 0;
    int size = 0; ///< bytes of data
    std::uint32_t number = 0;

    [[nodiscard]] std::int64_t signedNumber() const noexcept
    {
        const std::int64_t positive = number;
        if (size == 0 || (number >> (8 * size - 1) & 1u) == 0)
            return positive;
        return positive - (std::int64_t{1} << (8 * size));
    }
};

/// The item that starts at `at`, which is within the descriptor and is moved behind it; nothing when it ends too early.
/// HID defines no long items (6.2.2.3); they come out as reserved ones. [any]
[[nodiscard]] inline std::optional<HidItem> nextHidItem(std::span<const std::byte> descriptor, std::size_t& at) noexcept
{
    const auto prefix = std::to_integer<unsigned>(descriptor[at++]);
    const std::size_t left = descriptor.size() - at;
    HidItem item;
    if (prefix == 0xFE)
    {
        const std::size_t length = left > 0 ? 2 + std::to_integer<std::size_t>(descriptor[at]) : 2;
        if (left < length)
            return std::nullopt;
        at += length;
        item.type = HidItem::reservedType;
        return item;
    }
    item.size = (prefix & 3u) == 3u ? 4 : static_cast<int>(prefix & 3u);
    item.type = static_cast<int>(prefix >> 2 & 3u);
    item.tag = static_cast<int>(prefix >> 4);
    if (left < static_cast<std::size_t>(item.size))
        return std::nullopt;
    for (int i = 0; i < item.size; ++i)
        item.number |= std::to_integer<std::uint32_t>(descriptor[at++]) << (8 * i);
    return item;
}

} // namespace pacini::devices
