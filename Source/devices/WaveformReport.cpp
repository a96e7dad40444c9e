#include "devices/WaveformReport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace pacini::devices
{

namespace
{
std::uint16_t ordinalOf(const WaveformTrigger& trigger, Waveform waveform) noexcept
{
    switch (waveform)
    {
    case Waveform::event:
        return trigger.event;
    case Waveform::buzz:
        return trigger.buzz;
    case Waveform::rumble:
        return trigger.rumble;
    case Waveform::stop:
        break;
    }
    return ordinalStop;
}

/// Lowest bit first, as HID has it, within the field's range.
void putNumber(std::span<std::byte> report, const ReportField& field, std::int32_t number) noexcept
{
    const auto value = static_cast<std::uint32_t>(std::clamp(number, field.least, field.most));
    for (std::uint32_t i = 0; i < field.bits; ++i)
        if ((value >> i & 1u) != 0)
        {
            const std::size_t bit = 8u + field.bit + i;
            report[bit / 8] |= static_cast<std::byte>(1u << bit % 8);
        }
}
} // namespace

Report waveformReport(const WaveformTrigger& trigger, const WaveformState& state) noexcept
{
    const std::int32_t most = trigger.intensity.bits > 0 ? trigger.intensity.most : 1;
    const double wanted = state.intensity > 0.0 ? std::fmin(state.intensity, 1.0) : 0.0;
    auto level = static_cast<std::int32_t>(std::lround(wanted * most));
    if (state.waveform == Waveform::event && wanted > 0.0)
        level = std::max(level, 1);
    std::uint16_t ordinal = ordinalOf(trigger, state.waveform);
    if (level == 0 || ordinal == 0)
        ordinal = ordinalStop;
    if (ordinal == ordinalStop)
        level = 0;

    std::array<std::byte, Report::largest> bytes{};
    bytes[0] = static_cast<std::byte>(trigger.report);
    putNumber(bytes, trigger.waveform, ordinal);
    putNumber(bytes, trigger.intensity, level);
    putNumber(bytes, trigger.repeats, 0);
    putNumber(bytes, trigger.period, 0);
    putNumber(bytes, trigger.cutoff, trigger.cutoff.most);
    return Report(std::span<const std::byte>(bytes).first(trigger.bytes));
}

} // namespace pacini::devices
