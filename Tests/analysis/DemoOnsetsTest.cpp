#include "io/AudioReader.h"
#include "support/Catch.h"
#include "support/Paths.h"

#include <pacini/analysis/OnsetDetector.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

/// Pairs of one annotated and one found onset at most 25 ms apart, in order, each used once.
std::size_t hits(const std::vector<double>& annotated, const std::vector<Onset>& found)
{
    std::size_t count = 0;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < annotated.size() && j < found.size())
    {
        const double distance = found[j].time - annotated[i];
        if (std::abs(distance) <= 0.025)
        {
            ++count;
            ++i;
            ++j;
        }
        else
            ++(distance < 0.0 ? j : i);
    }
    return count;
}

} // namespace

TEST_CASE("The annotated onsets of the demo sounds are found", "[analysis][onsets]")
{
    std::ifstream file(testFolder() / "analysis/demo_onsets.json");
    REQUIRE(file);
    const auto annotations = nlohmann::json::parse(file);
    std::size_t matched = 0;
    std::size_t wanted = 0;
    std::size_t detected = 0;
    for (const auto& [name, times] : annotations["onsets"].items())
    {
        const auto sound = readAudio(sourceFolder() / "Resources/demo" / name);
        REQUIRE(sound);
        const auto found = detectOnsets(sound->samples, static_cast<std::size_t>(sound->channels), sound->sampleRate);
        const auto annotated = times.get<std::vector<double>>();
        const std::size_t correct = hits(annotated, found);
        CAPTURE(name, correct, annotated.size(), found.size());
        CHECK(2.0 * static_cast<double>(correct) >= 0.7 * static_cast<double>(annotated.size() + found.size()));
        matched += correct;
        wanted += annotated.size();
        detected += found.size();
    }
    REQUIRE(wanted > 30);
    CAPTURE(matched, wanted, detected);
    CHECK(2.0 * static_cast<double>(matched) >= 0.9 * static_cast<double>(wanted + detected));
}
