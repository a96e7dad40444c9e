#include "devices/ControllerReports.h"
#include "devices/Crc32.h"
#include "devices/OpenController.h"
#include "devices/SonyReports.h"
#include "devices/SwitchReports.h"
#include "devices/XboxReport.h"
#include "support/Catch.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
std::vector<int> numbersOf(std::span<const std::byte> report)
{
    std::vector<int> numbers;
    for (const std::byte byte : report)
        numbers.push_back(std::to_integer<int>(byte));
    return numbers;
}

// A report of zeros but for the places named.
std::vector<int> reportWith(std::size_t size, std::initializer_list<std::pair<std::size_t, int>> places)
{
    std::vector<int> report(size, 0);
    for (const auto& [place, value] : places)
        report.at(place) = value;
    return report;
}

// The sum that zlib gives for 0xA2 and the report, put at its end, lowest byte first.
std::vector<int> signedBy(std::uint32_t sum, std::vector<int> report)
{
    for (std::size_t i = 0; i < 4; ++i)
        report.at(report.size() - 4 + i) = static_cast<int>(sum >> (8 * i) & 0xFF);
    return report;
}

std::uint32_t crcOfText(std::string_view text)
{
    return crc32(std::as_bytes(std::span<const char>(text)));
}

constexpr MotorLevels uneven{0.75, 0.25}; // 191 and 64 of 255
} // namespace

TEST_CASE("CRC-32 has the standard's check value and goes on from part to part", "[devices]")
{
    CHECK(crcOfText("123456789") == 0xCBF43926u);
    CHECK(crcOfText("") == 0u);
    const std::string_view rest = "56789";
    CHECK(crc32(std::as_bytes(std::span<const char>(rest)), crcOfText("1234")) == 0xCBF43926u);
}

TEST_CASE("A DualShock 4 gets weak before strong, in the report of its cable or of its radio", "[devices]")
{
    CHECK(numbersOf(dualShock4UsbReport(uneven)) == reportWith(32, {{0, 0x05}, {1, 0x01}, {4, 64}, {5, 191}}));
    CHECK(numbersOf(dualShock4BluetoothReport(uneven)) ==
          signedBy(0xD6F89CD4u, reportWith(78, {{0, 0x11}, {1, 0xC4}, {3, 0x01}, {6, 64}, {7, 191}})));
    CHECK(numbersOf(dualShock4BluetoothReport({}, 1000))[1] == 0xFF);
    CHECK(numbersOf(dualShock4BluetoothReport({}, -1))[1] == 0xC0);
}

TEST_CASE("A DualSense gets the flags of its firmware", "[devices]")
{
    CHECK(numbersOf(dualSenseUsbReport(uneven, DualSenseMode::rumble)) ==
          reportWith(48, {{0, 0x02}, {1, 0x03}, {3, 64}, {4, 191}}));
    CHECK(numbersOf(dualSenseUsbReport(uneven, DualSenseMode::improvedRumble)) ==
          reportWith(48, {{0, 0x02}, {1, 0x02}, {3, 64}, {4, 191}, {39, 0x04}}));
    CHECK(numbersOf(dualSenseBluetoothReport(uneven, DualSenseMode::rumble, 0x1B)) ==
          signedBy(0x7C32652Au, reportWith(78, {{0, 0x31}, {1, 0xB0}, {2, 0x10}, {3, 0x03}, {5, 64}, {6, 191}})));
    CHECK(numbersOf(dualSenseBluetoothReport(uneven, DualSenseMode::improvedRumble, 11)) ==
          signedBy(0x7DC1F80Eu,
                   reportWith(78, {{0, 0x31}, {1, 0xB0}, {2, 0x10}, {3, 0x02}, {5, 64}, {6, 191}, {41, 4}})));
}

TEST_CASE("A DualSense is sent the rumble of its firmware, that of old at half", "[devices]")
{
    ControllerModel model{ControllerHaptics::dualSense, Transport::usb};
    CHECK(reportOf(model, uneven, 0) == Report(dualSenseUsbReport(uneven, DualSenseMode::improvedRumble)));
    model.oldRumble = true;
    CHECK(reportOf(model, uneven, 0) ==
          Report(dualSenseUsbReport({0.5 * uneven.strong, 0.5 * uneven.weak}, DualSenseMode::rumble)));

    // It is asked for, as it is opened.
    struct Pad : OpenController
    {
        void prepare(const StopReports&) override {}
        Result<void> send(const Report&) override { return {}; }
        Result<std::vector<std::byte>> feature(std::uint8_t report, std::size_t) override
        {
            asked = report;
            if (version < 0)
                return Error{ErrorCode::io, "", "does not answer"};
            std::vector<std::byte> bytes(64);
            bytes[44] = static_cast<std::byte>(version & 0xFF);
            bytes[45] = static_cast<std::byte>(version >> 8);
            return bytes;
        }
        int version = 0;
        int asked = 0;
    };
    Controller controller;
    controller.haptics = ControllerHaptics::dualSense;
    for (const auto& [product, version, old] : {std::tuple{0x0CE6, 0x0223, true},
                                                {0x0CE6, 0x0224, false},
                                                {0x0CE6, 0x0630, false},
                                                {0x0CE6, 0, false},
                                                {0x0CE6, -1, false},
                                                {0x0DF2, 0x0100, false}})
    {
        CAPTURE(product, version);
        Pad pad;
        pad.version = version;
        controller.product = static_cast<std::uint16_t>(product);
        CHECK(modelOf(controller, pad).value().oldRumble == old);
        CHECK(pad.asked == 0x20);
    }
}

TEST_CASE("A DualSense is given back to its audio by a report without flags", "[devices]")
{
    CHECK(numbersOf(dualSenseUsbReport(uneven, DualSenseMode::audioHaptics)) == reportWith(48, {{0, 0x02}}));
    CHECK(numbersOf(dualSenseBluetoothReport(uneven, DualSenseMode::audioHaptics, 0)) ==
          signedBy(0x231501B5u, reportWith(78, {{0, 0x31}, {2, 0x10}})));
}

TEST_CASE("An Xbox controller gets triggers, strong and weak as hundredths", "[devices]")
{
    CHECK(numbersOf(xboxBluetoothReport({0.5, 1.0}, {0.1, 0.25})) ==
          std::vector<int>{0x03, 0x0F, 10, 25, 50, 100, 0xFF, 0x00, 0xEB});
    CHECK(numbersOf(xboxBluetoothReport({})) == std::vector<int>{0x03, 0x0F, 0, 0, 0, 0, 0xFF, 0x00, 0xEB});
}

TEST_CASE("Motor levels outside their range are brought into it", "[devices]")
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const auto& [level, byte] : std::vector<std::pair<double, int>>{
             {-1.0, 0}, {std::nan(""), 0}, {0.0, 0}, {1.0, 255}, {1.5, 255}, {infinity, 255}, {-infinity, 0}})
    {
        CAPTURE(level);
        CHECK(numbersOf(dualShock4UsbReport({level, 0.0}))[5] == byte);
    }
}

TEST_CASE("A Switch report has a counter of four bits, then left, then right", "[devices]")
{
    const SidesRumble rumble{encodeRumble({{320_Hz, 1.0}, {160_Hz, 0.0}}), neutralRumble};
    CHECK(numbersOf(switchRumbleReport(0x2F, rumble)) ==
          std::vector<int>{0x10, 0x0F, 0x00, 0xC9, 0x40, 0x40, 0x00, 0x01, 0x40, 0x40});
    CHECK(numbersOf(switchRumbleReport(16, {})) ==
          std::vector<int>{0x10, 0x00, 0x00, 0x01, 0x40, 0x40, 0x00, 0x01, 0x40, 0x40});
    CHECK(numbersOf(switchEnableRumbleReport(3, true)) ==
          std::vector<int>{0x01, 0x03, 0x00, 0x01, 0x40, 0x40, 0x00, 0x01, 0x40, 0x40, 0x48, 0x01});
    CHECK(numbersOf(switchEnableRumbleReport(4, false, rumble)) ==
          std::vector<int>{0x01, 0x04, 0x00, 0xC9, 0x40, 0x40, 0x00, 0x01, 0x40, 0x40, 0x48, 0x00});
}
