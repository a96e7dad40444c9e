// See fuzzForeign().

#include "FuzzForeign.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return pacini::fuzzForeign("ahap", data, size);
}
