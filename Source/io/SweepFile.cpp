#include "io/SweepFile.h"

#include "io/AtomicFile.h"
#include "io/FieldsDocument.h"
#include "io/FieldsWriter.h"
#include "io/InputFile.h"

#include <cmath>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t maxLevels = 32;
constexpr double largestSweepGain = 200.0; // dB

/// Shows `visitor` (FieldsReader or FieldsWriter) all entries in the order of the file.
template <typename AnySweep, typename Visitor>
void visitFields(AnySweep& file, Visitor& visitor)
{
    using enum Need;
    auto& sweep = file.sweep;
    visitNumbers(visitor, required, "lowFrequency", sweep.lowFrequency, "highFrequency", sweep.highFrequency,
                 "duration", sweep.duration, "fadeIn", sweep.fadeIn, "fadeOut", sweep.fadeOut);
    visitor.integer("repeats", sweep.repeats, "must be a whole number, 1 to 100");
    visitor.number("pause", sweep.pause, required);
    visitor.numbers("levels", sweep.levels, maxLevels);
    visitor.number("markerDuration", sweep.markerDuration, required);
    visitor.number("sampleRate", sweep.sampleRate, required);
    visitor.optionalText("equalizedFor", file.equalizedFor);
    visitor.number("gain", file.gain, usual);
}
} // namespace

Result<SweepFile> readSweepJson(std::string_view text)
{
    auto file = readDocument<SweepFile>(
        text, {"the description of a sweep", sweepFormatName, sweepFormatVersion, largestSweepText}, nullptr,
        [](auto& read, auto& reader) { visitFields(read, reader); });
    if (!file)
        return file;
    if (auto valid = validate(file->sweep); !valid)
        return valid.error();
    if (!(std::abs(file->gain) <= largestSweepGain))
        return Error{ErrorCode::invalidData, "gain", "must be -200 to 200 dB"};
    return file;
}

std::string sweepJson(const SweepFile& sweep)
{
    FieldsWriter writer(FieldsWriter::Layout::spaced);
    writer.format({sweepFormatName, sweepFormatVersion});
    visitFields(sweep, writer);
    return std::move(writer).document();
}

Result<SweepFile> readSweepFile(const std::filesystem::path& path)
{
    const auto text = readWholeFile(path, largestSweepText);
    return text ? readSweepJson(*text) : text.error();
}

Result<std::size_t> writeSweepFile(const std::filesystem::path& path, const SweepFile& sweep)
{
    if (auto valid = validate(sweep.sweep); !valid)
        return valid.error();
    return writeFileAtomically(path, sweepJson(sweep));
}

} // namespace pacini
