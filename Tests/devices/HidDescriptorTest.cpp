#include "devices/HidDescriptor.h"

#include "devices/HidDescriptors.h"
#include "support/Catch.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
constexpr HidUsage hapticController = hidUsage(0x0E, 0x01);
constexpr HidUsage gamepad = hidUsage(0x01, 0x05);

HidReports reportsOf(std::string_view hex, HidUsage within = hapticController)
{
    auto reports = parseHidDescriptor(bytesOfHex(hex), within);
    INFO((reports ? std::string() : reports.error().text()));
    REQUIRE(reports);
    return std::move(reports).value();
}

/// A gamepad around some items.
std::string padAround(const std::string& items)
{
    return "05 01 09 05 A1 01 " + items + " C0";
}

/// The places of values, as (report, bit, bits).
std::vector<std::array<int, 3>> placesOf(const HidReports& reports, HidReportType type)
{
    std::vector<std::array<int, 3>> places;
    for (const HidField& field : reports.fields)
        if (field.type == type)
            places.push_back({field.report, static_cast<int>(field.bit), field.bits});
    return places;
}

std::vector<HidUsage> usagesOf(const HidReports& reports)
{
    std::vector<HidUsage> usages;
    for (const HidField& field : reports.fields)
        usages.push_back(field.usage);
    return usages;
}

void checkBounds(const HidReports& reports)
{
    REQUIRE(reports.fields.size() <= 256);
    for (const HidField& field : reports.fields)
    {
        REQUIRE(field.bits >= 1);
        REQUIRE(field.bits <= 32);
        REQUIRE((8 + field.bit + field.bits + 7) / 8 <= reports.bytesOf(field.type, field.report));
    }
}
} // namespace

TEST_CASE("Values of a touchpad's haptic collections stand where its descriptor puts them", "[devices]")
{
    const HidReports reports = reportsOf(touchpadDescriptor);
    using Places = std::vector<std::array<int, 3>>;
    CHECK(placesOf(reports, HidReportType::input).empty());
    CHECK(placesOf(reports, HidReportType::output) ==
          Places{{6, 0, 8}, {6, 8, 8}, {6, 16, 8}, {6, 24, 16}, {6, 40, 16}});
    CHECK(placesOf(reports, HidReportType::feature) ==
          Places{{5, 0, 16}, {5, 16, 16}, {5, 32, 16}, {5, 48, 8}, {5, 56, 8}, {5, 64, 8}});
    CHECK(reports.bytesOf(HidReportType::input, 1) == 6);
    CHECK(reports.bytesOf(HidReportType::feature, 5) == 10);
    CHECK(reports.bytesOf(HidReportType::output, 6) == 8);
    CHECK(reports.bytesOf(HidReportType::output, 7) == 1);
    const HidField& first = reports.fields[0];
    CHECK(first.usage == hidUsage(0x0A, 3));
    CHECK(first.collection == hidUsage(0x0E, 0x10));
    CHECK(first.logicalMinimum == 0x1001);
    CHECK(first.logicalMaximum == 0x2FFF);
}

TEST_CASE("Arrays and constants take their bits, states are pushed and popped, long items are passed over", "[devices]")
{
    const HidReports reports = reportsOf(mouseDescriptor);
    using Places = std::vector<std::array<int, 3>>;
    CHECK(reports.bytesOf(HidReportType::input, 0) == 4);  // 2 x 3, 2 of nothing, 2 x 8
    CHECK(reports.bytesOf(HidReportType::output, 0) == 3); // 4, 7, 5 of nothing
    CHECK(placesOf(reports, HidReportType::output) == Places{{0, 0, 4}, {0, 4, 7}});
    CHECK(placesOf(reports, HidReportType::feature) == Places{{0, 0, 16}, {0, 16, 16}, {0, 32, 16}, {0, 48, 16}});
    CHECK(reports.fields[2].logicalMaximum == 65535);
    CHECK(reports.fields[2].collection == hidUsage(0x0E, 0x10));

    const HidReports moves = reportsOf(mouseDescriptor, hidUsage(0x01, 0x02));
    REQUIRE(moves.fields.size() == 2);
    CHECK(moves.fields[0].usage == hidUsage(0x01, 0x30));
    CHECK(moves.fields[1].bit == 16);
    CHECK(moves.fields[1].logicalMinimum == -127);
    CHECK(moves.fields[1].logicalMaximum == 127);
}

TEST_CASE("A usage has the page that is in force at the main item, unless it brings its own", "[devices]")
{
    const auto usages = usagesOf(reportsOf(padAround("75 08 95 03 09 30 0B 21 00 0E 00 05 0D 09 22 81 02"), gamepad));
    CHECK(usages == std::vector<HidUsage>{hidUsage(0x0D, 0x30), hidUsage(0x0E, 0x21), hidUsage(0x0D, 0x22)});
}

TEST_CASE("The last usage holds for all values that follow; of a delimited set the first counts", "[devices]")
{
    const auto repeated = usagesOf(reportsOf(padAround("75 04 95 04 19 30 29 31 09 40 81 02"), gamepad));
    CHECK(repeated == std::vector<HidUsage>{0x10030, 0x10031, 0x10040, 0x10040});
    const auto delimited =
        usagesOf(reportsOf(padAround("75 08 95 02 A9 01 09 30 09 31 09 32 A9 00 09 33 81 02"), gamepad));
    CHECK(delimited == std::vector<HidUsage>{0x10030, 0x10033});
    CHECK(usagesOf(reportsOf(padAround("75 08 95 02 81 02"), gamepad)).empty());
}

TEST_CASE("Maxima are unsigned where the minimum is not negative", "[devices]")
{
    const auto fieldOf = [](const std::string& range)
    {
        return reportsOf(padAround(range + " 75 08 95 01 09 30 81 02"), gamepad).fields.at(0);
    };
    CHECK(fieldOf("15 00 25 FF").logicalMaximum == 255);
    CHECK(fieldOf("15 80 25 FF").logicalMaximum == -1);
    CHECK(fieldOf("15 80 25 FF").logicalMinimum == -128);
    CHECK(fieldOf("17 00 00 00 80 27 FF FF FF 7F").logicalMinimum == -2147483648LL);
    CHECK(fieldOf("14 27 FF FF FF FF").logicalMaximum == 4294967295LL);
    CHECK(fieldOf("36 00 80 46 00 80").physicalMaximum == -32768);
}

TEST_CASE("What was pushed comes back", "[devices]")
{
    const HidReports reports =
        reportsOf(padAround("15 81 25 7F 75 04 95 02 A4 05 0D 15 00 75 08 95 01 85 03 B4 09 30 81 02"), gamepad);
    REQUIRE(reports.fields.size() == 2);
    const HidField& last = reports.fields[1];
    CHECK(last.report == 0);
    CHECK(last.bit == 4);
    CHECK(last.bits == 4);
    CHECK(last.usage == hidUsage(0x01, 0x30));
    CHECK(last.logicalMinimum == -127);
}

TEST_CASE("What breaks the rules is refused with its place", "[devices]")
{
    const auto errorOf = [](const std::string& hex)
    {
        const auto reports = parseHidDescriptor(bytesOfHex(hex), gamepad);
        return reports ? Error{ErrorCode::io, "none", ""} : reports.error();
    };
    const std::vector<std::tuple<std::string, ErrorCode, std::string>> cases{
        {"05 01 C0", ErrorCode::invalidData, "byte 2"},
        {"05 01 B4", ErrorCode::invalidData, "byte 2"},
        {"07 00 00 01 00", ErrorCode::invalidData, "byte 0"},
        {"85 00", ErrorCode::invalidData, "byte 0"},
        {"86 00 01", ErrorCode::invalidData, "byte 0"},
        {"C4", ErrorCode::invalidData, "byte 0"},
        {"29 05", ErrorCode::invalidData, "byte 0"},
        {"19 05 29 04", ErrorCode::invalidData, "byte 2"},
        {"75", ErrorCode::truncated, "byte 0"},
        {"05 01 A1 01", ErrorCode::truncated, "byte 2"},
        {"FE 04 00 01 02 03", ErrorCode::truncated, "byte 0"},
        {"77 FF FF FF FF 97 FF FF FF FF 81 02", ErrorCode::tooLarge, "byte 10"},
        {"75 08 96 00 40 81 02 95 01 81 02", ErrorCode::tooLarge, "byte 9"},
        {"05 01 09 05 A1 01 09 30 75 01 96 01 01 81 02 C0", ErrorCode::tooLarge, "byte 13"}};
    for (const auto& [hex, code, where] : cases)
    {
        CAPTURE(hex);
        const Error error = errorOf(hex);
        CHECK(error.code == code);
        CHECK(error.where == where);
    }
    std::string deep, pushed;
    for (int i = 0; i < 17; ++i)
    {
        deep += "A1 00 ";
        pushed += "A4 ";
    }
    CHECK(errorOf(deep).code == ErrorCode::tooLarge);
    CHECK(errorOf(pushed).code == ErrorCode::tooLarge);
}

TEST_CASE("A descriptor that ends too early is refused wherever it ends", "[devices]")
{
    const auto whole = bytesOfHex(touchpadDescriptor);
    const std::size_t collection = 5; // where its only outermost collection has begun
    for (std::size_t length = collection; length < whole.size(); ++length)
    {
        const auto reports = parseHidDescriptor(std::span(whole).first(length), hapticController);
        CAPTURE(length);
        REQUIRE_FALSE(reports);
        CHECK(reports.error().code == ErrorCode::truncated);
    }
}

TEST_CASE("Random and damaged descriptors are refused, or give values within their reports", "[devices]")
{
    std::mt19937 random(20240811);
    const auto byte = [&]
    {
        return static_cast<std::byte>(random() & 0xFFu);
    };
    int understood = 0;
    for (int i = 0; i < 20000; ++i)
    {
        std::vector<std::byte> bytes;
        if (i % 2 == 0)
        {
            bytes.resize(random() % 300);
            std::generate(bytes.begin(), bytes.end(), byte);
        }
        else
        {
            bytes = bytesOfHex(i % 4 == 1 ? touchpadDescriptor : mouseDescriptor);
            for (auto changes = 1 + random() % 3; changes > 0; --changes)
                bytes[random() % bytes.size()] = byte();
        }
        if (const auto reports = parseHidDescriptor(bytes, hapticController))
        {
            checkBounds(*reports);
            understood += reports->fields.empty() ? 0 : 1;
        }
    }
    CHECK(understood > 1000);
}
