// Any text is refused with a proper error or describes a sweep, and comes back from its own text.

#include "FuzzText.h"
#include "io/SweepFile.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzzedText(data, size);
    if (!isReadOrRefused(text, [](std::string_view given) { return readSweepJson(given); }))
        return 0;
    const auto sweep = readSweepJson(text);
    FUZZ_CHECK(validate(sweep->sweep).ok());
    const auto again = readSweepJson(sweepJson(*sweep));
    FUZZ_CHECK(again.ok() && *again == *sweep);
    return 0;
}
