// Any bytes are refused or are a .hjif file, which comes back when it is written.

#include "FuzzShortForeign.h"
#include "io/formats/hjif/HjifFormat.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    pacini::fuzzShortForeign(pacini::hjifFormat(), {reinterpret_cast<const char*>(data), size}, 0.01);
    return 0;
}
