// Any text is refused with a proper error or is a table of categories of words.

#include "FuzzText.h"
#include "study/Words.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return fuzzReader(
        data, size, [](std::string_view given) { return study::WordCategories::ofCsv(given); },
        [](const auto& categories, std::string_view text)
        {
            for (const std::string& word : study::wordsOf(text))
                (void)categories.categoryOf(word);
        });
}
