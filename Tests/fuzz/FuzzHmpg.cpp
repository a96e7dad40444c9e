// Any bytes are refused or are a .hmpg file, which comes back when it is written.

#include "FuzzShortForeign.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    pacini::fuzzShortForeign("hmpg", {reinterpret_cast<const char*>(data), size}, 0.01);
    return 0;
}
