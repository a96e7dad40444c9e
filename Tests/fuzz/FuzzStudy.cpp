// Any text is refused with a proper error or is a study that can be run, and comes back from its own text.

#include "FuzzKeys.h"
#include "FuzzText.h"
#include "study/StudyFile.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzzedText(data, size);
    ReadWarnings warnings, strict(true);
    const bool read = isReadOrRefused(text, [&](std::string_view given) { return study::readStudyJson(given); });
    FUZZ_CHECK(study::readStudyJson(text, &warnings).ok() == read);
    checkWarnings(warnings, read, study::readStudyJson(text, &strict).ok());
    if (!read)
        return 0;
    const auto study = study::readStudyJson(text);
    FUZZ_CHECK(study::validate(*study).ok());
    const std::string written = study::studyJson(*study);
    const auto again = study::readStudyJson(written);
    FUZZ_CHECK(again.ok());
    FUZZ_CHECK(study::studyJson(*again) == written);
    return 0;
}
