// Any text is refused with a proper error or is settings whose translation comes back from its own text.

#include "FuzzKeys.h"
#include "FuzzText.h"
#include "io/Settings.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzzedText(data, size);
    ReadWarnings warnings, strict(true);
    const bool read = isReadOrRefused(text, [](std::string_view given) { return readSettings(given); });
    FUZZ_CHECK(readSettings(text, &warnings).ok() == read);
    checkWarnings(warnings, read, readSettings(text, &strict).ok());
    if (!read)
        return 0;
    const auto translation = translationOf(*readSettings(text));
    if (!translation)
        return 0;
    FUZZ_CHECK(validate(*translation).ok());
    const auto again = readSettings(settingsJson(*translation, translation->choices).dump());
    FUZZ_CHECK(again.ok());
    FUZZ_CHECK(*translationOf(*again) == *translation);
    return 0;
}
