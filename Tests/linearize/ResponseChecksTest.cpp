#include "support/Catch.h"

#include <pacini/linearize/ResponseChecks.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
SweepParams checkedSweep()
{
    SweepParams params;
    params.lowFrequency = 20.0;
    params.highFrequency = 1000.0;
    return params;
}

/// Powers from 10 to 1200 Hz with a slope of `slope` dB over the range that counts, `snr` times the noise of 1.
NoisyPower checkedPower(double snr, double slope)
{
    NoisyPower out;
    for (int k = 2; k <= 240; ++k)
    {
        const double f = 5.0 * k;
        const double part = std::log(f / 24.0) / std::log(1000.0 / 1.2 / 24.0);
        out.frequency.push_back(f);
        out.power.push_back(snr * std::pow(10.0, 0.1 * slope * (part - 0.5)));
        out.noise.push_back(1.0);
    }
    return out;
}

std::vector<MeasurementWarning> warningsOf(const std::vector<NoisyPower>& channels, bool equalized = false)
{
    std::vector<MeasurementWarning> warnings;
    warnOfResponses(channels, checkedSweep(), equalized, warnings);
    return warnings;
}

std::vector<MeasurementWarning> snrWarnings(const std::vector<double>& level, double wanted)
{
    FrequencyResponse snr;
    for (std::size_t i = 0; i < level.size(); ++i)
        snr.frequency.push_back(20.04 + 30.0 * static_cast<double>(i));
    snr.level = level;
    std::vector<MeasurementWarning> warnings;
    warnOfSnr(snr, wanted, warnings);
    return warnings;
}
} // namespace

TEST_CASE("Frequencies are written with one decimal below 100 Hz", "[linearize]")
{
    CHECK(hertzText(23.46) == "23.5 Hz");
    CHECK(hertzText(5.04) == "5.0 Hz");
    CHECK(hertzText(99.9) == "99.9 Hz");
    CHECK(hertzText(100.0) == "100 Hz");
    CHECK(hertzText(440.4) == "440 Hz");
}

TEST_CASE("A channel of noise has less than twice its power, one of the drive is flat within a decibel", "[linearize]")
{
    CHECK(warningsOf({checkedPower(2.05, 0.0)}).empty());
    const auto noise = warningsOf({checkedPower(50.0, 20.0), checkedPower(1.95, 0.0)});
    REQUIRE(noise.size() == 1);
    CHECK(noise[0] ==
          MeasurementWarning{
              MeasurementDefect::noiseChannel, "channels[1]",
              "has noise but no response; turn its axis along the movement, or connect the sensor to this input"});
    const auto looped = warningsOf({checkedPower(1000.0, 0.9), checkedPower(1000.0, 1.2)});
    REQUIRE(looped.size() == 1);
    CHECK(looped[0] == MeasurementWarning{MeasurementDefect::loopback, "channels[0]",
                                          "is flat within 1 dB: it contains the drive, not a movement"});
    CHECK(warningsOf({checkedPower(1000.0, 0.9)}, true).empty());
    CHECK(warningsOf({checkedPower(98.0, 0.0)}).empty());
    CHECK(warningsOf({checkedPower(102.0, 0.0)}).size() == 1);
    CHECK(warningsOf({checkedPower(1.95, 0.0)}, true).size() == 1);
    // what lies outside of 1.2 times the ends does not count
    auto ends = checkedPower(1000.0, 0.0);
    for (std::size_t k = 0; k < ends.power.size(); ++k)
        if (ends.frequency[k] < 22.0 || ends.frequency[k] > 900.0)
            ends.power[k] = 0.1;
    CHECK(warningsOf({ends}).size() == 1);
    auto inside = checkedPower(1000.0, 0.0);
    for (std::size_t k = 0; k < inside.power.size(); ++k)
        if (inside.frequency[k] < 30.0)
            inside.power[k] = 0.1;
    CHECK(warningsOf({inside}).empty());
    // digital silence
    auto silent = checkedPower(1.0, 0.0);
    silent.noise.assign(silent.noise.size(), 0.0);
    CHECK(warningsOf({silent}).size() == 1);
    CHECK(warningsOf({silent})[0].code == MeasurementDefect::loopback);
}

TEST_CASE("A channel that is known to be silent is not named again", "[linearize]")
{
    std::vector<MeasurementWarning> warnings{{MeasurementDefect::silentChannel, "channels[0]", ""},
                                             {MeasurementDefect::clipping, "channels[1]", ""}};
    warnOfResponses(std::vector<NoisyPower>{checkedPower(1.0, 0.0), checkedPower(1.0, 0.0)}, checkedSweep(), false,
                    warnings);
    REQUIRE(warnings.size() == 3);
    CHECK(warnings[2].where == "channels[1]");
    CHECK(warnings[2].code == MeasurementDefect::noiseChannel);
}

TEST_CASE("Each range of too little signal is named with its ends and its least", "[linearize]")
{
    CHECK(snrWarnings({10.0, 30.0, 10.0}, 10.0).empty());
    CHECK(snrWarnings({}, 10.0).empty());
    const auto all = snrWarnings({3.0, 9.9, -4.6}, 10.0);
    REQUIRE(all.size() == 1);
    CHECK(all[0] == MeasurementWarning{MeasurementDefect::lowSnr, "at every frequency",
                                       "the signal is down to -5 dB over the noise; drive harder, or play longer or "
                                       "more sweeps"});
    const auto below = snrWarnings({3.0, 7.0, 20.0, 20.0}, 10.0);
    REQUIRE(below.size() == 1);
    CHECK(below[0].where == "below 80.0 Hz");
    CHECK(below[0].message.substr(0, 27) == "the signal is down to 3 dB ");
    CHECK(snrWarnings({3.0, 10.0, 20.0}, 10.0).at(0).where == "below 50.0 Hz"); // enough is enough
    const auto above = snrWarnings({20.0, 20.0, 7.0, 8.0}, 10.0);
    REQUIRE(above.size() == 1);
    CHECK(above[0].where == "above 50.0 Hz");
    CHECK(above[0].message.substr(0, 27) == "the signal is down to 7 dB ");
    const auto several = snrWarnings({5.0, 20.0, 4.0, 3.0, 6.0, 20.0, 2.0, 20.0, 1.0}, 10.0);
    REQUIRE(several.size() == 4);
    CHECK(several[0].where == "below 50.0 Hz");
    CHECK(several[1].where == "from 80.0 Hz to 140 Hz");
    CHECK(several[1].message.substr(0, 27) == "the signal is down to 3 dB ");
    CHECK(several[2].where == "from 200 Hz to 200 Hz");
    CHECK(several[3].where == "above 230 Hz");
}
