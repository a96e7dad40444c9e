// Any bytes are refused with a proper error or are a valid clip.

#include "FuzzText.h"
#include "io/formats/android/VibrationXml.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzzedText(data, size);
    if (isReadOrRefused(text, readVibrationXml))
        FUZZ_CHECK(validate(readVibrationXml(text)->clip).ok());
    return 0;
}
