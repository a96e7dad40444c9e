// Any bytes are either refused with a proper error or are a descriptor whose values lie within its reports; what is a
// haptic device gets reports of its length, whatever it answers. The first byte says how long the descriptor is, in
// 16 bytes; the rest is the device's answer to every question.

#include "FuzzText.h"
#include "devices/WaveformDevice.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
void checkDevice(const WaveformDevice& device, std::span<const std::byte> rest)
{
    const auto answer = [&](std::uint8_t report, std::size_t bytes) -> Result<std::vector<std::byte>>
    {
        std::vector<std::byte> content(rest.begin(),
                                       rest.begin() + static_cast<std::ptrdiff_t>(std::min(rest.size(), bytes)));
        if (!content.empty())
            content[0] = static_cast<std::byte>(report);
        return content;
    };
    const auto trigger = chosenWaveforms(device, answer);
    if (!trigger)
    {
        FUZZ_CHECK(!trigger.error().message.empty());
        return;
    }
    FUZZ_CHECK(trigger->event != 0 || trigger->lasts());
    FUZZ_CHECK(trigger->eventTime.value <= 1.0 && trigger->buzzTime.value >= 0.0);
    const Report stop = waveformReport(*trigger, {});
    FUZZ_CHECK(stop.content().size() == trigger->bytes && trigger->bytes > 1);
    for (const Waveform waveform : {Waveform::event, Waveform::buzz, Waveform::rumble})
        FUZZ_CHECK(waveformReport(*trigger, {waveform, 1.0}).content().size() == trigger->bytes);
    FUZZ_CHECK(waveformReport(*trigger, {trigger->event != 0 ? Waveform::event : Waveform::buzz, 1.0}) != stop);
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0)
        return 0;
    const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
    const auto descriptor = bytes.first(std::min(bytes.size(), std::size_t{16} * data[0]));
    const auto reports = parseHidDescriptor(descriptor, hidUsage(0x0E, 0x01));
    const auto device = waveformDevice(descriptor);
    FUZZ_CHECK(reports.ok() == device.ok());
    if (!reports)
        return refused(reports.error());
    for (const HidField& field : reports->fields)
        FUZZ_CHECK((8 + field.bit + field.bits + 7) / 8 <= reports->bytesOf(field.type, field.report));
    if (*device)
        checkDevice(**device, bytes.subspan(descriptor.size()));
    return 0;
}
