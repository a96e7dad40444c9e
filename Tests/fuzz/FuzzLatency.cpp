// Any text is refused with a proper error or lists measured delays.

#include "FuzzText.h"
#include "study/LatencyFile.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    isReadOrRefused(fuzzedText(data, size), [](std::string_view text) { return study::latenciesOfText(text); });
    return 0;
}
