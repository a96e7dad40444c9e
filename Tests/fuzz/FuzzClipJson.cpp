// Any text is either refused with a proper error or is a clip that survives being written and read again.

#include "FuzzKeys.h"
#include "FuzzText.h"
#include "io/formats/json/ClipJson.h"

#include <string_view>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzzedText(data, size);
    ReadWarnings warnings, strict(true);
    const auto clip = readClipJson(text, largestClipText, &warnings);
    checkWarnings(warnings, clip.ok(), readClipJson(text, largestClipText, &strict).ok());
    if (!clip)
        return refused(clip.error());
    FUZZ_CHECK(validate(*clip).ok());
    const auto written = writeClipJson(*clip);
    const auto again = readClipJson(written);
    FUZZ_CHECK(again.ok());
    FUZZ_CHECK(*again == *clip);
    FUZZ_CHECK(writeClipJson(*again) == written);
    return 0;
}
