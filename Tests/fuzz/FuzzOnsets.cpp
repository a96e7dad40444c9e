// Any text is refused with a proper error or lists onsets, which ascend from 0.

#include "FuzzText.h"
#include "io/OnsetFile.h"
#include "io/TextMark.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return fuzzReader(
        data, size, [](std::string_view given) { return readOnsetText(given); },
        [](const auto& onsets, std::string_view text)
        {
            if (const auto labels = readLabelText(text))
                for (const Marker& marker : labels->markers)
                    FUZZ_CHECK(std::isfinite(marker.time) && marker.time >= 0.0 && isUtf8(marker.name));
            const auto check = [](const std::vector<double>& times)
            {
                FUZZ_CHECK(std::is_sorted(times.begin(), times.end()));
                for (const double time : times)
                    FUZZ_CHECK(std::isfinite(time) && time >= 0.0);
            };
            check(onsets.ofAny);
            for (const auto& [name, times] : onsets.byFile)
                check(times);
        });
}
