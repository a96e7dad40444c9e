#include "devices/WaveformDevice.h"

#include "devices/HidDescriptors.h"
#include "support/Catch.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
WaveformDevice deviceOf(std::string_view hex)
{
    const auto device = waveformDevice(bytesOfHex(hex));
    REQUIRE(device);
    REQUIRE(*device);
    return **device;
}

/// Answers every question with the same report; counts them.
struct Answer
{
    FeatureReader reader()
    {
        return [this](std::uint8_t report, std::size_t bytes) -> Result<std::vector<std::byte>>
        {
            ++asked;
            lastReport = report;
            lastBytes = bytes;
            if (hex.empty())
                return Error{ErrorCode::io, "", "does not answer"};
            return bytesOfHex(hex);
        };
    }

    std::string hex;
    int asked = 0;
    int lastReport = -1;
    std::size_t lastBytes = 0;
};

std::string hexOf(const Report& report)
{
    std::string text;
    for (const std::byte byte : report.content())
        for (const int shift : {4, 0})
            text += "0123456789ABCDEF"[std::to_integer<unsigned>(byte) >> shift & 0xFu];
    return text;
}
} // namespace

TEST_CASE("A haptic device is one that can be triggered, tells waveforms and can be stopped", "[devices]")
{
    CHECK(deviceOf(touchpadDescriptor).listed.size() == 3);
    CHECK(deviceOf(mouseDescriptor).listed.size() == 2);
    CHECK(deviceOf(dialDescriptor).listed.size() == 3);
    const auto isOne = [](std::string hex)
    {
        const auto device = waveformDevice(bytesOfHex(hex));
        return device && *device;
    };
    CHECK_FALSE(isOne(std::string(gamepadDescriptor)));
    CHECK_FALSE(isOne("")); // what the system did not tell
    // A touchpad that only lets its own clicks be made stronger.
    CHECK_FALSE(isOne("05 0D 09 05 A1 01 05 0E 09 01 A1 02 85 37 09 23 15 00 25 64 75 08 95 01 B1 02 C0 C0"));
    const std::string dial(dialDescriptor);
    const auto changed = [&](std::string_view from, std::string_view to)
    {
        std::string other = dial;
        return other.replace(other.find(from), from.size(), to);
    };
    CHECK(isOne(dial));
    CHECK_FALSE(isOne(changed("15 01 25 07 09 21", "15 01 25 01 09 21")));       // no ordinal for stop
    CHECK_FALSE(isOne(changed("15 01 25 07 09 21", "15 01 25 02 09 21")));       // nor one for a waveform
    CHECK_FALSE(isOne(changed("25 07 09 21", "25 07 75 01 09 21")));             // too few bits for stop
    CHECK_FALSE(isOne(changed("75 08 95 01 09 24", "75 08 95 60 09 24")));       // longer than any report here
    CHECK_FALSE(isOne(changed("05 0E 09 01 A1 02 15", "05 0E 09 02 A1 02 15"))); // another collection
}

TEST_CASE("Waveforms are chosen from those that the device tells", "[devices]")
{
    const WaveformDevice touchpad = deviceOf(touchpadDescriptor);
    const auto chosen = [&](std::string hex)
    {
        Answer answer{std::move(hex)};
        const auto trigger = chosenWaveforms(touchpad, answer.reader());
        CHECK(answer.asked == 1); // both lists are in one report
        CHECK(answer.lastReport == 5);
        CHECK(answer.lastBytes == 10);
        REQUIRE(trigger);
        return *trigger;
    };
    // Hover, click and rumble, of 12, 25 and 0 ms.
    const WaveformTrigger usual = chosen("05 0810 0310 0510 0C 19 00");
    CHECK(usual.event == 4);
    CHECK(usual.eventTime.value == Approx(0.025));
    CHECK(usual.buzz == 5);
    CHECK(usual.rumble == 5);
    CHECK(usual.lasts());
    // Release, hover and press.
    CHECK(chosen("05 0710 0810 0610 0A 0B 0C").event == 5);
    // None, ink that goes on, and one that this knows nothing of but that ends.
    const WaveformTrigger unknown = chosen("05 0110 0B10 1410 00 00 FF");
    CHECK(unknown.event == 5);
    CHECK(unknown.eventTime.value == Approx(0.200)); // no longer
    CHECK_FALSE(unknown.lasts());
    // Only a buzz, which is to be triggered again after 50 ms.
    const WaveformTrigger buzzing = chosen("05 0410 0110 0110 32 00 00");
    CHECK(buzzing.event == 0);
    CHECK(buzzing.buzz == 3);
    CHECK(buzzing.rumble == 3);
    CHECK(buzzing.buzzTime.value == Approx(0.050));
    CHECK(buzzing.rumbleTime.value == Approx(0.050));
}

TEST_CASE("A device that tells no waveform is refused, with its own reason", "[devices]")
{
    const WaveformDevice touchpad = deviceOf(touchpadDescriptor);
    const auto errorOf = [&](std::string hex)
    {
        Answer answer{std::move(hex)};
        const auto trigger = chosenWaveforms(touchpad, answer.reader());
        REQUIRE_FALSE(trigger);
        CHECK(trigger.error().code == ErrorCode::io);
        return trigger.error().message;
    };
    CHECK(errorOf("") == "does not answer");
    CHECK(errorOf("05").find("no waveform") != std::string::npos);                         // nothing but its number
    CHECK(errorOf("05 0000 0000 0000 00 00 00").find("no waveform") != std::string::npos); // out of range
    CHECK(errorOf("05 0120 0B10 0110 0A 00 00").find("no waveform") != std::string::npos); // a maker's, ink, none
    CHECK(errorOf("05 0120 0B10").find("no waveform") != std::string::npos);               // too short
}

TEST_CASE("Waveforms that the descriptor tells are not asked for", "[devices]")
{
    Answer silent;
    const auto trigger = chosenWaveforms(deviceOf(dialDescriptor), silent.reader());
    REQUIRE(trigger);
    CHECK(silent.asked == 0);
    CHECK(trigger->event == 3);
    CHECK(trigger->buzz == 4);
    CHECK(trigger->eventTime.value == 0.0);
    CHECK(trigger->intensity.bits == 0);
}

TEST_CASE("A touchpad's trigger has the ordinal, its steps of intensity, no repeats and the latest cutoff", "[devices]")
{
    Answer answer{"05 0310 0510 0410 0C 00 00"};
    const auto trigger = chosenWaveforms(deviceOf(touchpadDescriptor), answer.reader());
    REQUIRE(trigger);
    const auto hex = [&](devices::Waveform waveform, double intensity)
    {
        return hexOf(waveformReport(*trigger, {waveform, intensity}));
    };
    const std::string rest = "0000008813"; // 5000 ms
    CHECK(hex(devices::Waveform::event, 1.0) == "060304" + rest);
    CHECK(hex(devices::Waveform::event, 0.5) == "060302" + rest);
    CHECK(hex(devices::Waveform::event, 0.01) == "060301" + rest); // not rounded away
    CHECK(hex(devices::Waveform::rumble, 0.7) == "060403" + rest);
    CHECK(hex(devices::Waveform::buzz, 0.2) == "060501" + rest);
    CHECK(hex(devices::Waveform::buzz, 0.12) == "060200" + rest);
    CHECK(hex(devices::Waveform::stop, 1.0) == "060200" + rest);
    for (const double wrong : {0.0, -1.0, std::nan("")})
        CHECK(hex(devices::Waveform::event, wrong) == "060200" + rest);
    CHECK(hex(devices::Waveform::buzz, 2.0) == "060504" + rest);
}

TEST_CASE("Numbers that do not end with bytes have their own bits only", "[devices]")
{
    Answer answer{"00 0310 0410 1400 0000"};
    const auto trigger = chosenWaveforms(deviceOf(mouseDescriptor), answer.reader());
    REQUIRE(trigger);
    CHECK(answer.lastReport == 0);
    CHECK(trigger->eventTime.value == Approx(0.020));
    const auto bits = [&](devices::Waveform waveform, double intensity)
    {
        return hexOf(waveformReport(*trigger, {waveform, intensity}));
    };
    CHECK(bits(devices::Waveform::event, 1.0) == "004306"); // 3 and 100 << 4
    CHECK(bits(devices::Waveform::buzz, 0.5) == "002403");  // 4 and 50 << 4
    CHECK(bits(devices::Waveform::stop, 0.0) == "000200");
}

TEST_CASE("Without an intensity a waveform plays from half strength on, an event always", "[devices]")
{
    Answer silent;
    const auto trigger = chosenWaveforms(deviceOf(dialDescriptor), silent.reader());
    REQUIRE(trigger);
    const auto ordinal = [&](devices::Waveform waveform, double intensity)
    {
        return hexOf(waveformReport(*trigger, {waveform, intensity}));
    };
    CHECK(ordinal(devices::Waveform::buzz, 0.6) == "010004");
    CHECK(ordinal(devices::Waveform::buzz, 0.4) == "010002");
    CHECK(ordinal(devices::Waveform::event, 0.1) == "010003");
}

TEST_CASE("A device without a waveform for a state is stopped", "[devices]")
{
    WaveformTrigger trigger = standardTrigger();
    trigger.event = 0;
    CHECK(hexOf(waveformReport(trigger, {devices::Waveform::event, 1.0})) == "010200000000");
    CHECK(hexOf(waveformReport(standardTrigger(), {devices::Waveform::event, 1.0})) == "010364000000");
}
