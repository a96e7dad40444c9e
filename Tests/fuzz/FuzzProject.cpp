// Any text is either refused with a proper error or is a project that survives being written and read again, and whose
// edits can be applied to its analyses.

#include "FuzzText.h"
#include "document/ProjectJson.h"
#include "document/Reapply.h"

#include <string_view>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzzedText(data, size);
    const auto read = readProjectJson(text);
    if (!read)
        return refused(read.error());
    const auto written = projectJson(read->project);
    const auto again = readProjectJson(written);
    FUZZ_CHECK(again.ok());
    FUZZ_CHECK(again->project == read->project);
    FUZZ_CHECK(projectJson(again->project) == written);
    for (const auto& item : read->project.clips)
    {
        FUZZ_CHECK(validate(*item->clip).ok());
        FUZZ_CHECK(validate(*item->analysis).ok());
        std::vector<Edit> edits;
        for (const auto& edit : item->edits.whole())
            edits.push_back(*edit);
        const Reapplied anew = reapply(*item->analysis, *item->analysis, edits);
        FUZZ_CHECK(validate(anew.clip).ok());
        FUZZ_CHECK(anew.edits.size() == edits.size());
    }
    return 0;
}
