// Any bytes are either refused with a proper error or are a valid profile, read the same twice and from its own text.

#include "FuzzKeys.h"
#include "FuzzText.h"
#include "io/ProfileFile.h"

#include <string_view>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzzedText(data, size);
    ReadWarnings warnings, strict(true);
    const auto profile = readProfileJson(text, &warnings);
    checkWarnings(warnings, profile.ok(), readProfileJson(text, &strict).ok());
    if (!profile)
        return refused(profile.error());
    FUZZ_CHECK(validate(*profile).ok());
    FUZZ_CHECK(*readProfileJson(text) == *profile);
    const auto back = readProfileJson(profileJson(*profile));
    FUZZ_CHECK(back.ok());
    FUZZ_CHECK(*back == *profile);
    return 0;
}
