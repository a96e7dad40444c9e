#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Pinned.h"

#include <pacini/linearize/EqualizedSweep.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
SweepParams shortSweep(std::vector<double> levels)
{
    return {.highFrequency = 1000.0, .duration = 1.0, .levels = std::move(levels), .sampleRate = 8000.0};
}

EqualizerSections raising(double gain, double frequency)
{
    EqualizerSections sections;
    sections.pushBack({EqualizerType::peak, frequency, gain, 1.0, 2});
    return sections;
}

} // namespace

TEST_CASE("A sweep through an equaliser is lowered by as few whole decibels as make it fit", "[linearize]")
{
    for (const double level : {0.0, -0.5, -6.0, -10.0, -17.25})
        for (const double gain : {-12.0, 3.0, 9.5, 12.0, 24.0})
            for (const double frequency : {20.0, 150.0, 800.0})
            {
                CAPTURE(level, gain, frequency);
                const auto params = shortSweep({level});
                const auto made = makeEqualizedSweep(params, raising(gain, frequency));
                REQUIRE(made.ok());
                CHECK(test::peakOf(made->signal) <= 1.0);
                CHECK(made->peak == Approx(test::peakOf(made->signal)).epsilon(1e-6));
                CHECK(made->lowered == std::floor(made->lowered));
                CHECK(made->sweep.levels.front() == level - made->lowered);
                if (made->lowered > 0.0)
                    CHECK(made->peak * std::pow(10.0, 1.0 / 20.0) > 1.0); // one dB less would not have done
                else
                    CHECK(made->sweep == params);
            }
}

TEST_CASE("A lowered sweep is what is made at the lower level from the start", "[linearize]")
{
    const auto lowered = makeEqualizedSweep(shortSweep({-24.0, -3.0}), raising(12.0, 100.0)).value();
    REQUIRE(lowered.lowered > 0.0);
    // The distance of the levels, which shows from where on an actuator distorts, stays.
    CHECK(lowered.sweep.levels[1] - lowered.sweep.levels[0] == Approx(21.0));
    const auto again = makeEqualizedSweep(lowered.sweep, raising(12.0, 100.0)).value();
    CHECK(again.lowered == 0.0);
    REQUIRE(again.signal.size() == lowered.signal.size());
    double worst = 0.0;
    for (std::size_t n = 0; n < again.signal.size(); ++n)
        worst =
            std::max(worst, std::abs(static_cast<double>(again.signal[n]) - static_cast<double>(lowered.signal[n])));
    CHECK(worst < 1e-6);
}

TEST_CASE("A sweep that an equaliser leaves soft is raised to the level asked for, by a gain that is told",
          "[linearize]")
{
    EqualizerSections sections;
    sections.pushBack({EqualizerType::highShelf, 5.0, -40.0, 0.7, 2});
    const auto soft = makeEqualizedSweep(shortSweep({-20.0, -6.0}), sections).value();
    const auto raised = makeEqualizedSweep(shortSweep({-20.0, -6.0}), sections, true).value();
    CHECK(soft.gain == 0.0);
    CHECK(test::peakOf(raised.signal) == Approx(std::pow(10.0, -6.0 / 20.0)).epsilon(1e-5));
    CHECK(raised.gain > 20.0);
    CHECK(raised.sweep == soft.sweep);
    CHECK(20.0 * std::log10(test::peakOf(raised.signal) / test::peakOf(soft.signal)) ==
          Approx(raised.gain).margin(1e-4));
    CHECK(makeEqualizedSweep(shortSweep({-6.0}), {}, true)->gain == 0.0);
    CHECK(provingLowFrequency(10.0, 1500.0, 100.0) == Approx(80.0));
    CHECK(provingLowFrequency(10.0, 1500.0, 11.0) == 10.0);
    CHECK(provingLowFrequency(10.0, 100.0, 90.0) == 25.0);
}

TEST_CASE("A sweep that cannot be lowered far enough is refused at its levels", "[linearize]")
{
    const auto made = makeEqualizedSweep(shortSweep({-79.0, -1.0}), raising(12.0, 100.0));
    REQUIRE_FALSE(made.ok());
    CHECK(made.error().code == ErrorCode::invalidArgument);
    CHECK(made.error().where == "levels");
    CHECK(makeEqualizedSweep(shortSweep({3.0}), {}).error().where == "levels[0]");
}

TEST_CASE("Sweeps through equalisers are what they were", "[linearize]")
{
    for (const bool raised : {false, true})
        for (const double gain : {-20.0, 2.0, 14.0})
        {
            CAPTURE(raised, gain);
            const auto made = makeEqualizedSweep(shortSweep({-9.0, -12.0}), raising(gain, 60.0), raised).value();
            const std::string name = "linearize/equalised sweep, " + std::to_string(static_cast<int>(gain)) + " dB" +
                                     (raised ? ", raised" : "");
            checkPinned(name, std::vector<double>(made.signal.begin(), made.signal.end()), 1e-5);
            checkPinned(name + ", gains", {made.lowered, made.gain, made.peak, made.sweep.levels[0]}, 1e-5);
        }
    // as it is without any section, and silence stays so
    const auto plain = makeEqualizedSweep(shortSweep({-9.0}), {}).value();
    CHECK(plain.signal == makeSweepSignal(shortSweep({-9.0})).value());
    CHECK(plain.lowered == 0.0);
    CHECK(plain.peak == Approx(test::peakOf(plain.signal)));
    CHECK(EqualizedSweep{}.lowered == 0.0);
    CHECK(EqualizedSweep{}.gain == 0.0);
    CHECK(EqualizedSweep{}.peak == 0.0);
    const auto refused = makeEqualizedSweep(shortSweep({-79.0, -1.0}), raising(12.0, 100.0)).error();
    CHECK(refused.message.find("cannot be lowered by the 12 dB by which the equaliser raises the sweep beyond full "
                               "scale: the lowest would be below -80 dB") == 0);
    CHECK(makeEqualizedSweep(shortSweep({-60.0, -1.0}), raising(12.0, 100.0))->sweep.levels[0] == -72.0);
}
