// Any bytes are refused or are a .vij file, whose clip is valid.

#include "FuzzShortForeign.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    pacini::fuzzShortForeign("vij", {reinterpret_cast<const char*>(data), size}, 0.001);
    return 0;
}
