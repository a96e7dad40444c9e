#include "support/Catch.h"

#include <pacini/analysis/EvenTrains.h>

using namespace pacini;

namespace
{
std::vector<Onset> at(std::initializer_list<double> times)
{
    std::vector<Onset> onsets;
    for (const double time : times)
        onsets.push_back({time, 1.0, 1.0, 0.0, 2.0});
    return onsets;
}
} // namespace

TEST_CASE("Five like events in even steps are a train, four are none", "[analysis]")
{
    CHECK(evenTrains({}, 0.045).empty());
    CHECK(evenTrains(at({0.10}), 0.045).empty());
    CHECK(evenTrains(at({0.10, 0.12, 0.14, 0.16}), 0.045).empty());
    CHECK(evenTrains(at({0.10, 0.12, 0.14, 0.16, 0.18}), 0.045) == std::vector<TrainSpan>{{0.10, 0.18}});
    // Steps may vary by a quarter, but not by a half, and not beyond the reach.
    CHECK(evenTrains(at({0.10, 0.12, 0.145, 0.165, 0.19}), 0.045).size() == 1);
    CHECK(evenTrains(at({0.10, 0.12, 0.15, 0.17, 0.20}), 0.045).empty());
    CHECK(evenTrains(at({0.10, 0.15, 0.20, 0.25, 0.30}), 0.045).empty());
}

TEST_CASE("A train ends where its events change", "[analysis]")
{
    auto onsets = at({0.10, 0.12, 0.14, 0.16, 0.18, 0.20, 0.22, 0.24, 0.26, 0.28});
    onsets[5].amplitude = 0.75;
    CHECK(evenTrains(onsets, 0.045) == std::vector<TrainSpan>{{0.10, 0.28}});
    for (std::size_t i = 5; i < onsets.size(); ++i)
        onsets[i].amplitude = 0.6;
    CHECK(evenTrains(onsets, 0.045) == std::vector<TrainSpan>{{0.10, 0.18}, {0.20, 0.28}});
    // From one pace to another the event between ends one and begins the next.
    CHECK(evenTrains(at({0.10, 0.12, 0.14, 0.16, 0.18, 0.22, 0.26, 0.30, 0.34}), 0.045) ==
          std::vector<TrainSpan>{{0.10, 0.18}, {0.18, 0.34}});
    // One beat alone, and then a train.
    CHECK(evenTrains(at({0.05, 0.30, 0.32, 0.34, 0.36, 0.38}), 0.045) == std::vector<TrainSpan>{{0.30, 0.38}});
}
