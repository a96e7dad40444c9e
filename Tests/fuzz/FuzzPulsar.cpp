// Any bytes are refused with a proper error or are a valid clip.

#include "FuzzText.h"
#include "io/formats/pulsar/PulsarFormat.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return fuzzReader(data, size, readPulsar,
                      [](const auto& read, std::string_view) { FUZZ_CHECK(validate(read.clip).ok()); });
}
