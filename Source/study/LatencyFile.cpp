#include "study/LatencyFile.h"

#include "io/AtomicFile.h"
#include "io/FieldsDocument.h"
#include "io/FieldsWriter.h"
#include "io/InputFile.h"

#include <system_error>
#include <utility>

namespace pacini::study
{

namespace
{
constexpr std::size_t mostMeasurements = 10'000;
constexpr std::size_t largestLatencyFile = 10'000'000; // bytes

template <typename AnyMeasurement, typename Visitor>
void visitMeasurement(AnyMeasurement& measured, Visitor& visitor)
{
    using enum Need;
    visitor.text("time", measured.time);
    visitor.optionalText("device", measured.device);
    visitor.optionalText("recording", measured.recording);
    visitor.number("sampleRate", measured.sampleRate, usual);
    auto& latency = measured.latency;
    visitor.number("delay", latency.delay, required);
    visitNumbers(visitor, usual, "deviation", latency.deviation, "largest", latency.largest, "drift", latency.drift,
                 "soundLevel", latency.soundLevel, "touchLevel", latency.touchLevel);
    visitor.integer("bursts", latency.bursts, "must be a whole number");
    visitor.integer("missed", latency.missed, "must be a whole number");
}

template <typename AnyList, typename Visitor>
void visitList(AnyList& list, Visitor& visitor)
{
    visitor.list("measurements", list, mostMeasurements, "measurements",
                 [&](auto& measured) { visitMeasurement(measured, visitor); });
}
} // namespace

Result<std::vector<MeasuredLatency>> readLatencies(const std::filesystem::path& folder)
{
    std::error_code unknown;
    if (!std::filesystem::exists(folder / latencyFileName, unknown))
        return std::vector<MeasuredLatency>{};
    const auto text = readWholeFile(folder / latencyFileName, largestLatencyFile);
    return text ? latenciesOfText(*text) : text.error();
}

Result<std::vector<MeasuredLatency>> latenciesOfText(std::string_view text)
{
    return readDocument<std::vector<MeasuredLatency>>(
        text, {"a list of measured delays", latencyFormatName, latencyFormatVersion, largestLatencyFile}, nullptr,
        [](auto& list, auto& reader) { visitList(list, reader); });
}

Result<void> keepLatency(const std::filesystem::path& folder, const MeasuredLatency& measured)
{
    auto list = readLatencies(folder);
    if (!list)
        return list.error();
    list->push_back(measured);
    if (list->size() > mostMeasurements)
        list->erase(list->begin());
    FieldsWriter writer(FieldsWriter::Layout::spaced);
    writer.format({latencyFormatName, latencyFormatVersion});
    visitList(*list, writer);
    const auto written = writeFileAtomically(folder / latencyFileName, std::move(writer).document());
    if (!written)
        return written.error();
    return {};
}

} // namespace pacini::study
