// Any bytes are read as chapters of an ID3 tag or of comments, with times from 0 and names in UTF-8.

#include "FuzzText.h"
#include "io/CommentChapters.h"
#include "io/Id3Chapters.h"
#include "io/TextMark.h"

#include <cmath>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes = fuzzedText(data, size);
    for (const FoundMarkers& found : {id3Chapters(bytes), commentChapters(bytes)})
    {
        for (const Marker& marker : found.markers)
            FUZZ_CHECK(std::isfinite(marker.time) && marker.time >= 0.0 && isUtf8(marker.name));
        for (const std::string& warning : found.warnings)
            FUZZ_CHECK(isUtf8(warning) && warning.size() < 300 && warning.find('\n') == std::string::npos);
    }
    return 0;
}
