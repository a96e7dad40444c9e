// See fuzzForeign().

#include "FuzzForeign.h"
#include "io/formats/haptic/HapticFormat.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return pacini::fuzzForeign(pacini::hapticFormat(), data, size);
}
