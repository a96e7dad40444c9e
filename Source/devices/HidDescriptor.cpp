#include "devices/HidDescriptor.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace pacini::devices
{

namespace
{
constexpr std::size_t mostNested = 16;              // collections, and saved states
constexpr std::size_t mostFields = 256;             // haptic devices have some tens
constexpr std::uint64_t mostReportBits = 8 * 16384; // Linux, HID_MAX_BUFFER_SIZE

/// One short item: a prefix and up to four bytes.
struct HidItem
{
    enum Type
    {
        mainType = 0,
        globalType = 1,
        localType = 2,
    };
    int type = 0;
    int tag = 0;
    int size = 0; ///< bytes of data
    std::uint32_t number = 0;

    [[nodiscard]] std::int64_t signedNumber() const noexcept
    {
        const std::int64_t number64 = number;
        if (size == 0 || (number >> (8 * size - 1) & 1u) == 0)
            return number64;
        return number64 - (std::int64_t{1} << (8 * size));
    }
};

/// What holds until it is changed.
struct GlobalState
{
    std::uint16_t page = 0;
    std::uint8_t report = 0;
    std::uint32_t size = 0; ///< bits
    std::uint32_t count = 0;
    std::int64_t logicalMinimum = 0, logicalMaximum = 0, physicalMinimum = 0, physicalMaximum = 0;
};

/// Usages that follow each other.
struct UsageRange
{
    std::uint32_t first = 0, last = 0;
    bool withPage = false; ///< otherwise the page is the one in force at the main item
};

/// What holds until the next main item.
struct LocalState
{
    std::vector<UsageRange> usages;
    std::optional<UsageRange> minimum;
    bool delimited = false;
    bool delimitedHas = false; ///< the set of usages that mean the same has its first
};

class DescriptorReader
{
public:
    DescriptorReader(std::span<const std::byte> descriptor, HidUsage within) : bytes(descriptor), wanted(within) {}

    Result<HidReports> read()
    {
        while (at < bytes.size())
        {
            const auto item = next();
            if (!item)
                return item.error();
            if (!*item)
                continue; // a long item, of which HID defines none
            if (const auto done = take(**item); !done)
                return done.error();
        }
        if (!collections.empty())
            return failure(ErrorCode::truncated, "a collection has no end");
        return std::move(reports);
    }

private:
    [[nodiscard]] Error failure(ErrorCode code, std::string message) const
    {
        return {code, "byte " + std::to_string(start), std::move(message)};
    }

    Result<std::optional<HidItem>> next()
    {
        start = at;
        const auto prefix = std::to_integer<unsigned>(bytes[at++]);
        if (prefix == 0xFE)
        {
            const std::size_t data = at < bytes.size() ? 2 + std::to_integer<std::size_t>(bytes[at]) : 2;
            if (bytes.size() - at < data)
                return failure(ErrorCode::truncated, "a long item ends too early");
            at += data;
            return std::optional<HidItem>();
        }
        HidItem item;
        item.size = (prefix & 3u) == 3u ? 4 : static_cast<int>(prefix & 3u);
        item.type = static_cast<int>(prefix >> 2 & 3u);
        item.tag = static_cast<int>(prefix >> 4);
        if (bytes.size() - at < static_cast<std::size_t>(item.size))
            return failure(ErrorCode::truncated, "an item ends too early");
        for (int i = 0; i < item.size; ++i)
            item.number |= std::to_integer<std::uint32_t>(bytes[at++]) << (8 * i);
        return std::optional(item);
    }

    Result<void> take(const HidItem& item)
    {
        switch (item.type)
        {
        case HidItem::mainType:
            return takeMain(item);
        case HidItem::globalType:
            return takeGlobal(item);
        case HidItem::localType:
            return takeLocal(item);
        default:
            return {}; // reserved
        }
    }

    Result<void> takeMain(const HidItem& item)
    {
        Result<void> done;
        switch (item.tag)
        {
        case 0x8:
            done = addFields(HidReportType::input, item.number);
            break;
        case 0x9:
            done = addFields(HidReportType::output, item.number);
            break;
        case 0xB:
            done = addFields(HidReportType::feature, item.number);
            break;
        case 0xA:
            if (collections.size() >= mostNested)
                return failure(ErrorCode::tooLarge, "collections are too deep");
            collections.push_back(usageAt(0).value_or(0));
            break;
        case 0xC:
            if (collections.empty())
                return failure(ErrorCode::invalidData, "ends a collection that has not begun");
            collections.pop_back();
            break;
        default:
            break; // reserved
        }
        local = {};
        return done;
    }

    Result<void> takeGlobal(const HidItem& item)
    {
        const auto maximum = [&](std::int64_t minimum) -> std::int64_t
        {
            return minimum < 0 ? item.signedNumber() : std::int64_t{item.number};
        };
        switch (item.tag)
        {
        case 0x0:
            if (item.number > 0xFFFF)
                return failure(ErrorCode::invalidData, "there is no such usage page");
            global.page = static_cast<std::uint16_t>(item.number);
            break;
        case 0x1:
            global.logicalMinimum = item.signedNumber();
            break;
        case 0x2:
            global.logicalMaximum = maximum(global.logicalMinimum);
            break;
        case 0x3:
            global.physicalMinimum = item.signedNumber();
            break;
        case 0x4:
            global.physicalMaximum = maximum(global.physicalMinimum);
            break;
        case 0x5: // unit exponent
        case 0x6: // unit
            break;
        case 0x7:
            global.size = item.number;
            break;
        case 0x8:
            if (item.number < 1 || item.number > 255)
                return failure(ErrorCode::invalidData, "there is no such report number");
            global.report = static_cast<std::uint8_t>(item.number);
            break;
        case 0x9:
            global.count = item.number;
            break;
        case 0xA:
            if (saved.size() >= mostNested)
                return failure(ErrorCode::tooLarge, "pushes too often");
            saved.push_back(global);
            break;
        case 0xB:
            if (saved.empty())
                return failure(ErrorCode::invalidData, "pops what was not pushed");
            global = saved.back();
            saved.pop_back();
            break;
        default:
            return failure(ErrorCode::invalidData, "a global item of an unknown kind");
        }
        return {};
    }

    Result<void> takeLocal(const HidItem& item)
    {
        const UsageRange one{item.number, item.number, item.size == 4};
        switch (item.tag)
        {
        case 0x0:
            addUsages(one);
            break;
        case 0x1:
            local.minimum = one;
            break;
        case 0x2:
            if (!local.minimum || local.minimum->first > item.number)
                return failure(ErrorCode::invalidData, "a usage maximum without a minimum below it");
            addUsages({local.minimum->first, item.number, one.withPage || local.minimum->withPage});
            local.minimum.reset();
            break;
        case 0xA:
            local.delimited = item.number == 1;
            local.delimitedHas = false;
            break;
        default:
            break; // strings and designators
        }
        return {};
    }

    void addUsages(const UsageRange& range)
    {
        if (local.delimited && std::exchange(local.delimitedHas, true))
            return;
        local.usages.push_back(range);
    }

    /// The usage of one of the values of a main item: the last holds for all that follow.
    [[nodiscard]] std::optional<HidUsage> usageAt(std::uint32_t index) const
    {
        if (local.usages.empty())
            return std::nullopt;
        std::uint64_t rest = index;
        std::uint32_t found = local.usages.back().last;
        bool withPage = local.usages.back().withPage;
        for (const UsageRange& range : local.usages)
        {
            const std::uint64_t count = std::uint64_t{range.last} - range.first + 1;
            if (rest < count)
            {
                found = static_cast<std::uint32_t>(range.first + rest);
                withPage = range.withPage;
                break;
            }
            rest -= count;
        }
        return withPage ? found : hidUsage(global.page, static_cast<std::uint16_t>(found));
    }

    Result<void> addFields(HidReportType type, std::uint32_t flags)
    {
        std::uint32_t& used = reports.bits[static_cast<std::size_t>(type)][global.report];
        const std::uint64_t added = std::uint64_t{global.size} * global.count;
        if (added > mostReportBits - used)
            return failure(ErrorCode::tooLarge, "the report is too long");
        const bool isVariable = (flags & 2u) != 0;
        const bool isWanted = std::find(collections.begin(), collections.end(), wanted) != collections.end();
        if (isWanted && isVariable && global.size >= 1 && global.size <= 32 && !local.usages.empty())
        {
            if (global.count > mostFields - reports.fields.size())
                return failure(ErrorCode::tooLarge, "holds too many values");
            for (std::uint32_t i = 0; i < global.count; ++i)
                reports.fields.push_back({type, global.report, used + i * global.size,
                                          static_cast<std::uint8_t>(global.size), *usageAt(i), collections.back(),
                                          global.logicalMinimum, global.logicalMaximum, global.physicalMinimum,
                                          global.physicalMaximum});
        }
        used += static_cast<std::uint32_t>(added);
        return {};
    }

    std::span<const std::byte> bytes;
    HidUsage wanted;
    std::size_t at = 0;
    std::size_t start = 0; ///< of the item that is read
    HidReports reports;
    GlobalState global;
    LocalState local;
    std::vector<GlobalState> saved;
    std::vector<HidUsage> collections; ///< from the outermost on
};
} // namespace

Result<HidReports> parseHidDescriptor(std::span<const std::byte> descriptor, HidUsage within)
{
    return DescriptorReader(descriptor, within).read();
}

} // namespace pacini::devices
