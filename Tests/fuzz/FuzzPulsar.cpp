// Any bytes are refused with a proper error or are a valid clip.

#include "FuzzText.h"
#include "io/formats/pulsar/PulsarFormat.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes = fuzzedText(data, size);
    if (isReadOrRefused(bytes, readPulsar))
        FUZZ_CHECK(validate(readPulsar(bytes)->clip).ok());
    return 0;
}
