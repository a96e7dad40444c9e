// Any bytes are refused or are a .tact file, which comes back when it is written.

#include "FuzzShortForeign.h"
#include "io/formats/tact/TactFormat.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    pacini::fuzzShortForeign(pacini::tactFormat(), {reinterpret_cast<const char*>(data), size}, 0.021);
    return 0;
}
