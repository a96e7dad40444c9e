#include "devices/WaveformDevice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace pacini::devices
{

namespace
{
constexpr std::uint16_t hapticPage = 0x0E;
constexpr std::uint16_t ordinalPage = 0x0A;
constexpr HidUsage controllerUsage = hidUsage(hapticPage, 0x01);
constexpr HidUsage waveformListUsage = hidUsage(hapticPage, 0x10);
constexpr HidUsage durationListUsage = hidUsage(hapticPage, 0x11);
constexpr HidUsage manualTriggerUsage = hidUsage(hapticPage, 0x21);
constexpr HidUsage intensityUsage = hidUsage(hapticPage, 0x23);
constexpr HidUsage repeatCountUsage = hidUsage(hapticPage, 0x24);
constexpr HidUsage retriggerPeriodUsage = hidUsage(hapticPage, 0x25);
constexpr HidUsage cutoffTimeUsage = hidUsage(hapticPage, 0x28);

// Waveforms, numbers of the haptic page. Those of makers begin at 0x2000.
constexpr std::int64_t clickWaveform = 0x1003;
constexpr std::int64_t buzzWaveform = 0x1004;
constexpr std::int64_t rumbleWaveform = 0x1005;
constexpr std::int64_t pressWaveform = 0x1006;
constexpr std::int64_t hoverWaveform = 0x1008;
constexpr std::int64_t firstOfMakers = 0x2000;

/// No event keeps others waiting for longer.
constexpr double longestEvent = 0.200; // s

ReportField placeOf(const HidReports& reports, const HidField& trigger, HidUsage usage)
{
    for (const HidField& field : reports.fields)
        if (field.type == HidReportType::output && field.report == trigger.report && field.usage == usage)
        {
            const auto within = [](std::int64_t number)
            {
                return static_cast<std::int32_t>(
                    std::clamp<std::int64_t>(number, 0, std::numeric_limits<std::int32_t>::max()));
            };
            const std::int32_t least = within(field.logicalMinimum);
            const std::int64_t fits = (std::int64_t{1} << field.bits) - 1;
            const std::int32_t most = within(std::min(field.logicalMaximum, fits));
            if (field.bit > std::numeric_limits<std::uint16_t>::max() || most < 1 || most < least)
                return {};
            return {static_cast<std::uint16_t>(field.bit), field.bits, least, most};
        }
    return {};
}

const HidField* fieldOf(const HidReports& reports, HidReportType type, HidUsage collection, HidUsage usage)
{
    for (const HidField& field : reports.fields)
        if (field.type == type && field.usage == usage && (collection == 0 || field.collection == collection))
            return &field;
    return nullptr;
}

ToldNumber toldNumber(const HidReports& reports, const HidField& field)
{
    return {field, reports.bytesOf(field.type, field.report)};
}

/// The number that a field stands for: its physical value. Nothing when it is outside of its range.
std::optional<std::int64_t> physicalValue(const HidField& field, std::int64_t logical)
{
    if (logical < field.logicalMinimum || logical > field.logicalMaximum)
        return std::nullopt;
    if (field.physicalMinimum == 0 && field.physicalMaximum == 0)
        return logical;
    const auto width = static_cast<double>(field.logicalMaximum - field.logicalMinimum);
    const auto physicalWidth = static_cast<double>(field.physicalMaximum - field.physicalMinimum);
    const double share = width > 0.0 ? static_cast<double>(logical - field.logicalMinimum) / width : 0.0;
    return field.physicalMinimum + static_cast<std::int64_t>(std::llround(share * physicalWidth));
}

/// Asks for each report once.
class Answers
{
public:
    explicit Answers(const FeatureReader& toRead) : read(toRead) {}

    /// Nothing when the device does not tell it.
    std::optional<std::int64_t> valueOf(const ToldNumber& told)
    {
        const HidField& field = told.field;
        if (field.logicalMinimum == field.logicalMaximum)
            return physicalValue(field, field.logicalMinimum); // the descriptor says it all
        auto known = answers.find(field.report);
        if (known == answers.end())
            known = answers.emplace(field.report, read(field.report, told.bytes)).first;
        if (!known->second)
        {
            failure = known->second.error();
            return std::nullopt;
        }
        return numberIn(*known->second, field);
    }

    std::optional<Error> failure;

private:
    static std::optional<std::int64_t> numberIn(const std::vector<std::byte>& bytes, const HidField& field)
    {
        std::int64_t number = 0;
        for (std::size_t i = 0; i < field.bits; ++i)
        {
            const std::size_t bit = 8 + field.bit + i;
            if (bit / 8 >= bytes.size())
                return std::nullopt;
            number |= std::int64_t{std::to_integer<int>(bytes[bit / 8]) >> (bit % 8) & 1} << i;
        }
        if (field.logicalMinimum < 0 && (number >> (field.bits - 1) & 1) != 0)
            number -= std::int64_t{1} << field.bits;
        return physicalValue(field, number);
    }

    const FeatureReader& read;
    std::map<std::uint8_t, Result<std::vector<std::byte>>> answers;
};

struct KnownWaveform
{
    std::uint16_t ordinal = 0;
    std::int64_t usage = 0;
    Seconds duration;
};

/// The one with a usage; ordinal 0 when there is none.
KnownWaveform waveformOf(const std::vector<KnownWaveform>& known, std::int64_t usage)
{
    const auto found = std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.usage == usage; });
    return found != known.end() ? *found : KnownWaveform();
}

KnownWaveform eventOf(const std::vector<KnownWaveform>& known)
{
    for (const std::int64_t usage : {clickWaveform, pressWaveform, hoverWaveform})
        if (const auto found = waveformOf(known, usage); found.ordinal != 0)
            return found;
    for (const KnownWaveform& one : known)
        if (one.usage >= clickWaveform && one.usage != buzzWaveform && one.usage != rumbleWaveform &&
            one.usage < firstOfMakers && one.duration.value > 0.0)
            return one;
    return {};
}
} // namespace

Result<std::optional<WaveformDevice>> waveformDevice(std::span<const std::byte> descriptor)
{
    const auto reports = parseHidDescriptor(descriptor, controllerUsage);
    if (!reports)
        return reports.error();
    const HidField* trigger = fieldOf(*reports, HidReportType::output, 0, manualTriggerUsage);
    if (trigger == nullptr)
        return std::optional<WaveformDevice>();
    WaveformDevice device;
    const std::size_t bytes = reports->bytesOf(HidReportType::output, trigger->report);
    if (bytes > Report::largest)
        return std::optional<WaveformDevice>();
    device.trigger.report = trigger->report;
    device.trigger.bytes = static_cast<std::uint8_t>(bytes);
    device.trigger.waveform = placeOf(*reports, *trigger, manualTriggerUsage);
    device.trigger.intensity = placeOf(*reports, *trigger, intensityUsage);
    device.trigger.repeats = placeOf(*reports, *trigger, repeatCountUsage);
    device.trigger.period = placeOf(*reports, *trigger, retriggerPeriodUsage);
    device.trigger.cutoff = placeOf(*reports, *trigger, cutoffTimeUsage);
    if (device.trigger.waveform.least > ordinalStop || device.trigger.waveform.most < ordinalStop)
        return std::optional<WaveformDevice>(); // it could not be stopped

    for (const HidField& field : reports->fields)
    {
        const auto ordinal = static_cast<std::uint16_t>(field.usage);
        if (field.type != HidReportType::feature || field.collection != waveformListUsage ||
            field.usage >> 16 != ordinalPage || ordinal <= ordinalStop || ordinal > device.trigger.waveform.most)
            continue;
        ListedWaveform listed{ordinal, toldNumber(*reports, field), std::nullopt};
        if (const auto* duration = fieldOf(*reports, HidReportType::feature, durationListUsage, field.usage))
            listed.duration = toldNumber(*reports, *duration);
        device.listed.push_back(listed);
    }
    if (device.listed.empty())
        return std::optional<WaveformDevice>();
    return std::optional(device);
}

Result<WaveformTrigger> chosenWaveforms(const WaveformDevice& device, const FeatureReader& read)
{
    Answers answers(read);
    std::vector<KnownWaveform> known;
    for (const ListedWaveform& listed : device.listed)
        if (const auto usage = answers.valueOf(listed.usage))
        {
            const auto duration = listed.duration ? answers.valueOf(*listed.duration) : std::nullopt;
            known.push_back({listed.ordinal, *usage, Seconds(1e-3 * static_cast<double>(duration.value_or(0)))});
        }
    const KnownWaveform event = eventOf(known);
    KnownWaveform high = waveformOf(known, buzzWaveform);
    KnownWaveform low = waveformOf(known, rumbleWaveform);
    if (high.ordinal == 0)
        high = low;
    if (low.ordinal == 0)
        low = high;
    if (event.ordinal == 0 && high.ordinal == 0)
        return known.empty() && answers.failure ? *answers.failure
                                                : Error{ErrorCode::io, "", "offers no waveform that Pacini can use"};
    WaveformTrigger trigger = device.trigger;
    trigger.event = event.ordinal;
    trigger.buzz = high.ordinal;
    trigger.rumble = low.ordinal;
    trigger.eventTime = Seconds(std::clamp(event.duration.value, 0.0, longestEvent));
    trigger.buzzTime = Seconds(std::max(high.duration.value, 0.0));
    trigger.rumbleTime = Seconds(std::max(low.duration.value, 0.0));
    return trigger;
}

} // namespace pacini::devices
