#pragma once

// Usages (local items) in front of a main item of a HID report descriptor.

#include "devices/HidItem.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace pacini::devices
{

/// Collects usages from local items. Source: HID 1.11, 6.2.2.8.
class HidUsages
{
public:
    /// False for a maximum without a minimum below it. Strings and designators are passed over. [any]
    [[nodiscard]] bool take(const HidItem& item)
    {
        const Range one{item.number, item.number, item.size == 4};
        switch (item.tag)
        {
        case 0x0:
            add(one);
            break;
        case 0x1:
            minimum = one;
            break;
        case 0x2:
            if (!minimum || minimum->first > item.number)
                return false;
            add({minimum->first, item.number, one.withPage || minimum->withPage});
            minimum.reset();
            break;
        case 0xA:
            delimited = item.number == 1;
            delimitedHas = false;
            break;
        default:
            break;
        }
        return true;
    }

    [[nodiscard]] bool empty() const noexcept { return ranges.empty(); }

    /// The usage of a value of the main item, with its page in the upper half; not when empty. The last holds for all
    /// that follow. One that came without a page has the one that is in force at the main item, `page`. [any]
    [[nodiscard]] std::uint32_t at(std::uint32_t value, std::uint16_t page) const
    {
        std::uint64_t rest = value;
        for (const Range& range : ranges)
        {
            const std::uint64_t count = std::uint64_t{range.last} - range.first + 1;
            if (rest < count)
                return withPage(static_cast<std::uint32_t>(range.first + rest), range, page);
            rest -= count;
        }
        return withPage(ranges.back().last, ranges.back(), page);
    }

private:
    /// Usages that follow each other.
    struct Range
    {
        std::uint32_t first = 0;
        std::uint32_t last = 0;
        bool withPage = false;
    };

    void add(const Range& range)
    {
        if (!delimited || !std::exchange(delimitedHas, true))
            ranges.push_back(range);
    }

    static std::uint32_t withPage(std::uint32_t usage, const Range& range, std::uint16_t page) noexcept
    {
        return range.withPage ? usage : std::uint32_t{page} << 16 | (usage & 0xFFFFu);
    }

    std::vector<Range> ranges;
    std::optional<Range> minimum;
    bool delimited = false;
    bool delimitedHas = false; ///< the set of usages that mean the same has its first
};

} // namespace pacini::devices
