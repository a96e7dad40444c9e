#include "devices/ControllerReports.h"
#include "devices/Crc32.h"
#include "devices/DecodeReport.h"
#include "devices/OpenController.h"
#include "devices/SonyReports.h"
#include "devices/SwitchReports.h"
#include "devices/XboxReport.h"
#include "support/Catch.h"
#include "support/ReportList.h"

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

TEST_CASE("A motor's curve is passed both ways, silence is off, and full drive is all", "[devices]")
{
    for (const auto haptics : {ControllerHaptics::dualShock4, ControllerHaptics::dualSense, ControllerHaptics::xbox,
                               ControllerHaptics::steamDeck})
        for (const bool old : {false, true})
        {
            const ControllerModel model{haptics, Transport::usb, {}, old};
            CAPTURE(static_cast<int>(haptics), old);
            for (const auto& curve : {motorCurves(model).strong, motorCurves(model).weak})
            {
                for (const double level : {0.005, 0.01, 0.1, 0.5, 0.9, 1.0})
                {
                    CHECK(curve.command(level) > curve.start);
                    CHECK(curve.level(curve.command(level)) == Approx(level).epsilon(1e-9));
                    CHECK(curve.command(level) < curve.command(1.01 * level) + (level == 1.0 ? 1.0 : 0.0));
                }
                for (const double level : {0.0, -1.0, MotorCurve::least, std::nan("")})
                    CHECK(curve.command(level) == 0.0);
                CHECK(curve.command(5.0) == curve.full);
                CHECK(curve.level(curve.start) == 0.0);
                CHECK(curve.level(0.0) == 0.0);
            }
            // The quietest level that is no silence moves both motors, the loudest is all that they have.
            const double quietest = 1.001 * MotorCurve::least;
            const MotorLevels told = test::toldNumbers(model, reportOf(model, MotorLevels{quietest, quietest}, 0));
            CHECK(told.strong > motorCurves(model).strong.start);
            CHECK(told.weak > motorCurves(model).weak.start);
            CHECK(test::toldNumbers(model, reportOf(model, MotorLevels{0.003, 0.003}, 0)) == MotorLevels{});
            const double most = old && haptics == ControllerHaptics::dualSense ? 128.0 / 255.0 : 1.0;
            CHECK(test::toldNumbers(model, reportOf(model, MotorLevels{1.0, 2.0}, 0)) == MotorLevels{most, most});
        }
}

TEST_CASE("A DualSense is sent the rumble of its firmware, that of old at half", "[devices]")
{
    ControllerModel model{ControllerHaptics::dualSense, Transport::usb};
    const auto [strong, weak] = motorCurves(model);
    CHECK(reportOf(model, uneven, 0) ==
          Report(dualSenseUsbReport({strong.command(uneven.strong), weak.command(uneven.weak)},
                                    DualSenseMode::improvedRumble)));
    model.oldRumble = true;
    CHECK(reportOf(model, uneven, 0) ==
          Report(dualSenseUsbReport({0.5 * uneven.strong, 0.5 * uneven.weak}, DualSenseMode::rumble)));

    // It is asked for, as it is opened.
    struct Pad : OpenController
    {
        void prepare(const StopReports&) override {}
        Result<void> send(const Report& report) override
        {
            sent.push_back(report);
            return refuses ? Result<void>(Error{ErrorCode::io, "", "refuses"}) : Result<void>();
        }
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
        bool refuses = false;
        std::vector<Report> sent;
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
        CHECK(pad.sent.empty());
    }
    // On Bluetooth it is tried with a silent block of samples.
    controller.transport = Transport::bluetooth;
    for (const bool refuses : {false, true})
    {
        Pad pad;
        pad.refuses = refuses;
        const auto found = modelOf(controller, pad).value();
        CHECK(found.samples == (refuses ? DualSenseSamples::none : DualSenseSamples::report32));
        REQUIRE(pad.sent.size() == 1);
        CHECK(pad.sent[0] == dualSenseSamplesReport({}, DualSenseSamples::report32, 0));
    }
}

TEST_CASE("A DualSense gets samples in a report with a session, and in a longer one with its state", "[devices]")
{
    PcmBlock block;
    block.left[0] = 32767;
    block.right[0] = -32767;
    block.left[1] = 16512; // 64
    block.right[31] = -258;
    CHECK(numbersOf(dualSenseSamplesReport(block, DualSenseSamples::report32, 0x1B).content()) ==
          signedBy(0x7A2A5F22u, reportWith(142, {{0, 0x32},
                                                 {1, 0xB0},
                                                 {2, 0x91},
                                                 {3, 7},
                                                 {4, 0xFE},
                                                 {9, 0xFF},
                                                 {10, 0x1B},
                                                 {11, 0x92},
                                                 {12, 0x40},
                                                 {13, 127},
                                                 {14, 129},
                                                 {15, 64},
                                                 {76, 255}})));
    CHECK(numbersOf(dualSenseSamplesReport(block, DualSenseSamples::report36, 0x1B).content()) ==
          signedBy(0xA02494DBu, reportWith(398, {{0, 0x36},
                                                 {1, 0xB0},
                                                 {2, 0x91},
                                                 {3, 7},
                                                 {4, 0xFE},
                                                 {9, 0xFF},
                                                 {10, 0x1B},
                                                 {11, 0x90},
                                                 {12, 0x3F},
                                                 {76, 0x92},
                                                 {77, 0x40},
                                                 {78, 127},
                                                 {79, 129},
                                                 {80, 64},
                                                 {141, 255}})));
}

TEST_CASE("Samples of a DualSense begin without rumble, come every 10.667 ms, end in silence, and rumble stops them",
          "[devices]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands.push_back({90.0, 100.0, 110.0, 0, {{0.0, 0.5}, {1.0, 0.5}}, {}});
    for (const auto form : {DualSenseSamples::report32, DualSenseSamples::report36})
    {
        ControllerModel model = usualModel(ControllerHaptics::dualSense, Transport::bluetooth);
        model.samples = form;
        const test::PlayedReports played(model, clip);
        const auto& sent = played.sink.sent;
        REQUIRE(sent.size() > 100);
        const Report without(dualSenseBluetoothReport({}, DualSenseMode::audioHaptics, 0));
        CHECK(sent.front().report == without);
        CHECK(sent.back().report.content()[0] == std::byte{0x31});
        double sum = 0.0;
        std::size_t silent = 0, count = 0;
        for (std::size_t i = 1; i + 1 < sent.size(); ++i)
        {
            const auto content = sent[i].report.content();
            CHECK(sent[i].time == Approx(sent[1].time + static_cast<double>(i - 1) * 32.0 / 3000.0).margin(1e-9));
            CHECK(std::to_integer<unsigned>(content[1]) == (i % 16) << 4);
            CHECK(std::to_integer<unsigned>(content[10]) == i % 256);
            double here = 0.0;
            const std::size_t first = form == DualSenseSamples::report32 ? 13 : 78;
            for (std::size_t k = first; k < first + 64; ++k)
            {
                const double x = static_cast<std::int8_t>(std::to_integer<int>(content[k])) / 127.0;
                here += x * x;
                CHECK((k % 2 == first % 2 || content[k] == content[k - 1])); // both sides alike
            }
            silent = here > 0.0 ? 0 : silent + 1;
            if (i >= 20 && i < 80)
            {
                sum += here;
                count += 64;
            }
        }
        CHECK(std::sqrt(2.0 * sum / static_cast<double>(count)) == Approx(0.5).epsilon(0.02));
        CHECK(silent >= 6);
        for (const StopReport& stop : stopReports(model))
        {
            CHECK(stop.report.content()[0] == std::byte{0x31});
            CHECK(stop.report.content()[3] == std::byte{0x02}); // rumble instead
            CHECK(stop.also.content().empty());
        }
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
