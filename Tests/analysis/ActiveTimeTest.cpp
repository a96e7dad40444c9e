#include "support/Catch.h"

#include <pacini/analysis/methods/MethodSound.h>

#include <vector>

using namespace pacini;

TEST_CASE("Active time counts whole blocks above the threshold, the last one as long as it is", "[analysis]")
{
    const double fs = 1000.0; // blocks of 10 samples
    std::vector<float> x(95, 0.0f);
    CHECK(activeTime({}, fs).value == 0.0);
    CHECK(activeTime(x, fs).value == 0.0);
    x[0] = 1.0f;   // block 0
    x[19] = -1.0f; // block 1
    CHECK(activeTime(x, fs).value == Approx(0.020));
    x[90] = 0.001f; // the last 5 samples
    CHECK(activeTime(x, fs).value == Approx(0.025));
    x[90] = 0.0001f; // -80 dB
    CHECK(activeTime(x, fs).value == Approx(0.020));
}
