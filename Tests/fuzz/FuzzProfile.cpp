// Any bytes are either refused with a proper error or are a valid profile, read the same twice and from its own text.

#include "FuzzCheck.h"
#include "FuzzKeys.h"
#include "io/ProfileFile.h"

#include <string_view>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    ReadWarnings warnings, strict(true);
    const auto profile = readProfileJson(text, &warnings);
    checkWarnings(warnings, profile.ok(), readProfileJson(text, &strict).ok());
    if (!profile)
    {
        FUZZ_CHECK(!profile.error().message.empty());
        FUZZ_CHECK(profile.error().text().find('\n') == std::string::npos);
        return 0;
    }
    FUZZ_CHECK(validate(*profile).ok());
    FUZZ_CHECK(*readProfileJson(text) == *profile);
    const auto back = readProfileJson(profileJson(*profile));
    FUZZ_CHECK(back.ok());
    FUZZ_CHECK(*back == *profile);
    return 0;
}
