// Any text is refused with a proper error or is a table of a frequency response.

#include "FuzzText.h"
#include "io/ResponseTable.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzzedText(data, size);
    if (!isReadOrRefused(text, [](std::string_view given) { return readResponseTable(given); }))
        return 0;
    FUZZ_CHECK(validate(*readResponseTable(text)).ok());
    return 0;
}
