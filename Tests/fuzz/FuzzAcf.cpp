// Any bytes are either refused with a proper error or are JSON5 that becomes strict JSON; an ACF file among them makes
// a valid profile, which makes an ACF file again.

#include "FuzzCheck.h"
#include "io/AcfFile.h"
#include "io/Json5Text.h"
#include "io/JsonTree.h"

#include <string_view>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto json = jsonFromJson5(text, largestAcfText);
    const auto acf = readAcf(text);
    if (!json)
    {
        FUZZ_CHECK(!json.error().message.empty());
        FUZZ_CHECK(json.error().text().find('\n') == std::string::npos);
        FUZZ_CHECK(!acf);
        return 0;
    }
    // What the converter lets through is JSON: a place can only be a path, never a line.
    if (const auto tree = readJsonTree(*json, 6 * largestAcfText); !tree)
        FUZZ_CHECK(tree.error().code == ErrorCode::notFinite || tree.error().message == "is given twice");
    if (!acf)
    {
        FUZZ_CHECK(acf.error().text().find('\n') == std::string::npos);
        return 0;
    }
    const auto profile = profileOfAcf(*acf).profile;
    FUZZ_CHECK(validate(profile).ok());
    FUZZ_CHECK(readAcf(acfText(acfOfProfile(profile).acf)).ok());
    return 0;
}
