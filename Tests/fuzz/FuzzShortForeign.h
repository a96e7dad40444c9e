#pragma once

// What holds for every reader and writer of a foreign format, whatever the bytes.

#include "FuzzText.h"
#include "io/formats/ClipFormat.h"

#include <cmath>
#include <string>
#include <string_view>

namespace pacini
{

/// Bytes are refused with a proper error on one line or make a valid clip; what is written of that is read again, and
/// lasts as long to within `lengthMargin` s. Long clips are not written: their samples would take minutes.
inline void fuzzShortForeign(std::string_view name, std::string_view bytes, double lengthMargin)
{
    const ClipFormat& format = *clipFormatNamed(name);
    const auto read = format.read(bytes);
    if (format.recognises != nullptr)
        (void)format.recognises(bytes);
    if (!read)
    {
        refused(read.error());
        return;
    }
    FUZZ_CHECK(validate(read->clip).ok());
    for (const std::string& warning : read->warnings)
        FUZZ_CHECK(!warning.empty() && warning.find('\n') == std::string::npos);
    constexpr double longest = 2.0; // s
    if (read->clip.duration > longest || !format.isWritten())
        return;
    const auto written = format.write(read->clip, {});
    FUZZ_CHECK(written.ok());
    const auto again = format.read(written->files.at(0).bytes);
    FUZZ_CHECK(again.ok());
    FUZZ_CHECK(std::abs(again->clip.duration - read->clip.duration) <= lengthMargin);
}

} // namespace pacini
