// Any bytes are refused or are a .tact file, which comes back when it is written.

#include "FuzzShortForeign.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    pacini::fuzzShortForeign("tact", {reinterpret_cast<const char*>(data), size}, 0.021);
    return 0;
}
