// Any bytes are refused or are a .csv file, which comes back when it is written.

#include "FuzzShortForeign.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    pacini::fuzzShortForeign("csv", {reinterpret_cast<const char*>(data), size}, 1e-9);
    return 0;
}
