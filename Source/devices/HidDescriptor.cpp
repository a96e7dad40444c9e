#include "devices/HidDescriptor.h"

#include "devices/HidItem.h"
#include "devices/HidUsages.h"

#include <algorithm>
#include <string>
#include <utility>

namespace pacini::devices
{

namespace
{
constexpr std::size_t maxNested = 16;              // collections, and saved states
constexpr std::size_t maxFields = 256;             // haptic devices have some tens
constexpr std::uint64_t maxReportBits = 8 * 16384; // Linux, HID_MAX_BUFFER_SIZE

/// Global items of the descriptor, valid until changed.
struct GlobalState
{
    std::uint16_t page = 0;
    std::uint8_t report = 0;
    std::uint32_t size = 0; ///< bits
    std::uint32_t count = 0;
    std::int64_t logicalMinimum = 0, logicalMaximum = 0, physicalMinimum = 0, physicalMaximum = 0;
};

class DescriptorReader
{
public:
    DescriptorReader(std::span<const std::byte> descriptor, HidUsage within) : bytes(descriptor), wanted(within) {}

    Result<HidReports> read()
    {
        while (at < bytes.size())
        {
            start = at;
            const auto item = nextHidItem(bytes, at);
            if (!item)
                return failure(ErrorCode::truncated, "an item ends too early");
            if (const auto done = take(*item); !done)
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

    Result<void> take(const HidItem& item)
    {
        switch (item.type)
        {
        case HidItem::mainType:
            return takeMain(item);
        case HidItem::globalType:
            return takeGlobal(item);
        case HidItem::localType:
            if (!usages.take(item))
                return failure(ErrorCode::invalidData, "a usage maximum without a minimum below it");
            return {};
        default:
            return {};
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
            if (collections.size() >= maxNested)
                return failure(ErrorCode::tooLarge, "collections are too deep");
            collections.push_back(usages.empty() ? 0 : usages.at(0, global.page));
            break;
        case 0xC:
            if (collections.empty())
                return failure(ErrorCode::invalidData, "ends a collection that has not begun");
            collections.pop_back();
            break;
        default:
            break; // reserved
        }
        usages = {};
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
            if (saved.size() >= maxNested)
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

    Result<void> addFields(HidReportType type, std::uint32_t flags)
    {
        std::uint32_t& used = reports.bits[static_cast<std::size_t>(type)][global.report];
        const std::uint64_t added = std::uint64_t{global.size} * global.count;
        if (added > maxReportBits - used)
            return failure(ErrorCode::tooLarge, "the report is too long");
        const bool isVariable = (flags & 2u) != 0;
        const bool isWanted = std::find(collections.begin(), collections.end(), wanted) != collections.end();
        if (isWanted && isVariable && global.size >= 1 && global.size <= 32 && !usages.empty())
        {
            if (global.count > maxFields - reports.fields.size())
                return failure(ErrorCode::tooLarge, "holds too many values");
            for (std::uint32_t i = 0; i < global.count; ++i)
                reports.fields.push_back({type, global.report, used + i * global.size,
                                          static_cast<std::uint8_t>(global.size), usages.at(i, global.page),
                                          collections.back(), global.logicalMinimum, global.logicalMaximum,
                                          global.physicalMinimum, global.physicalMaximum});
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
    HidUsages usages; ///< since the last main item
    std::vector<GlobalState> saved;
    std::vector<HidUsage> collections; ///< from the outermost on
};
} // namespace

Result<HidReports> parseHidDescriptor(std::span<const std::byte> descriptor, HidUsage within)
{
    return DescriptorReader(descriptor, within).read();
}

} // namespace pacini::devices
