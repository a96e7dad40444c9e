// Any text is refused with a proper error or is a table of finite ratings, and comes back from its own text.

#include "FuzzText.h"
#include "study/Ratings.h"

#include <cmath>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return fuzzReader(
        data, size, [](std::string_view given) { return study::ratingsOfCsv(given); },
        [](const auto& ratings, std::string_view)
        {
            FUZZ_CHECK(!ratings.empty());
            for (const study::Rating& rating : ratings)
                FUZZ_CHECK(std::isfinite(rating.value));
            const std::string written = study::ratingsCsv(ratings);
            const auto again = study::ratingsOfCsv(written);
            FUZZ_CHECK(again.ok() && again->size() == ratings.size());
            FUZZ_CHECK(study::ratingsCsv(*again) == written);
        });
}
