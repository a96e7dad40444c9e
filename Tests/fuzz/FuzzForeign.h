#pragma once

// What holds for the reader and the writer of any foreign format that is text.

#include "FuzzText.h"
#include "io/formats/ClipFormat.h"

#include <string_view>

namespace pacini
{

/// Any bytes are either refused with a proper error or are a valid clip, which the format writes so that it reads it
/// again without a warning and with as many events.
inline int fuzzForeign(std::string_view name, const std::uint8_t* data, std::size_t size)
{
    const ClipFormat& format = *clipFormatNamed(name);
    const std::string_view text = fuzzedText(data, size);
    const auto read = format.read(text);
    if (!read)
        return refused(read.error());
    FUZZ_CHECK(validate(read->clip).ok());
    const auto written = format.write(read->clip, {});
    FUZZ_CHECK(written.ok());
    const auto again = format.read(written->files.front().bytes);
    FUZZ_CHECK(again.ok());
    FUZZ_CHECK(again->warnings.empty());
    FUZZ_CHECK(again->clip.transients.size() == read->clip.transients.size());
    return 0;
}

} // namespace pacini
