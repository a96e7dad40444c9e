#include "support/Catch.h"

#include <pacini/actuator/VoiceChoice.h>

#include <limits>
#include <vector>

using namespace pacini;

TEST_CASE("An actuator of few voices plays the most important bands", "[actuator]")
{
    using Indices = std::vector<std::size_t>;
    const std::vector<int> priorities{3, 0, 2, 0, 1};
    const std::vector<double> energies{9.0, 1.0, 5.0, 2.0, 0.5};
    CHECK(chooseVoices(priorities, energies, 0).empty());
    CHECK(chooseVoices(priorities, energies, 1) == Indices{3}); // priority before energy, energy among equals
    CHECK(chooseVoices(priorities, energies, 2) == Indices{1, 3});
    CHECK(chooseVoices(priorities, energies, 3) == Indices{1, 3, 4});
    CHECK(chooseVoices(priorities, energies, 64) == Indices{0, 1, 2, 3, 4});

    const std::vector<int> equal(5, 0);
    CHECK(chooseVoices(equal, std::vector<double>(5, 1.0), 2) == Indices{0, 1});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(chooseVoices(equal, std::vector<double>{0.0, nan, -1.0, 1e-300, 2.0}, 4) == Indices{3, 4});
    CHECK(chooseVoices({}, {}, 4).empty());
}
