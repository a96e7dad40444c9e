// Any text is refused with a proper error or describes a sweep, and comes back from its own text.

#include "FuzzText.h"
#include "io/SweepFile.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return fuzzReader(
        data, size, [](std::string_view given) { return readSweepJson(given); },
        [](const auto& sweep, std::string_view)
        {
            FUZZ_CHECK(validate(sweep.sweep).ok());
            const auto again = readSweepJson(sweepJson(sweep));
            FUZZ_CHECK(again.ok() && *again == sweep);
        });
}
