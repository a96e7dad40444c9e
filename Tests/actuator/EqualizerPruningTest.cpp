#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/actuator/EqualizerPruning.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

using namespace pacini;

namespace
{

constexpr double pruningRate = 8000.0;

/// The largest difference in dB of two equalisers between low and high, measured on their impulse responses.
double measuredError(const EqualizerSections& a, const EqualizerSections& b, double low, double high)
{
    constexpr std::size_t frames = 16384;
    const auto response = [](const EqualizerSections& sections)
    {
        Equalizer filter;
        filter.setParams(sections);
        filter.prepare({pruningRate, frames});
        auto x = test::impulse(frames);
        filter.process(x, x);
        std::vector<std::complex<double>> bins(frames / 2 + 1);
        RealFft<double>(frames).forward(std::vector<double>(x.begin(), x.end()), bins);
        return bins;
    };
    const auto ha = response(a);
    const auto hb = response(b);
    double largest = 0.0;
    for (std::size_t k = 0; k < ha.size(); ++k)
        if (const double f = static_cast<double>(k) * pruningRate / frames; f >= low && f <= high)
            largest = std::max(largest, std::abs(20.0 * std::log10(std::abs(ha[k]) / std::abs(hb[k]))));
    return largest;
}

} // namespace

TEST_CASE("Sections that do nothing in the range are left out, with the error that this costs", "[actuator]")
{
    const EqualizerSections equalizer{
        {EqualizerType::peak, 68.0, -10.0, 1.6, 2},   {EqualizerType::peak, 200.0, 0.05, 1.0, 2},
        {EqualizerType::highpass, 2.0, 0.0, 1.0, 2},  {EqualizerType::peak, 3000.0, 6.0, 30.0, 2},
        {EqualizerType::lowShelf, 40.0, 1.0, 0.7, 2}, {EqualizerType::peak, 3950.0, 12.0, 1.0, 2},
    };
    const auto pruned = pruneEqualizer(equalizer, {}, pruningRate);
    REQUIRE(pruned.dropped.size() == 4);
    CHECK(pruned.dropped[0].index == 1);
    CHECK(pruned.dropped[0].deviation == Approx(0.05));
    CHECK(pruned.dropped[1].index == 2);
    CHECK(pruned.dropped[2].index == 3);
    CHECK(pruned.dropped[3] == DroppedSection{5, 0.0}); // too near to half the sample rate to be there at all
    REQUIRE(pruned.kept.size() == 2);
    CHECK(pruned.kept[0] == equalizer[0]);
    CHECK(pruned.kept[1] == equalizer[4]);
    CHECK(pruned.predictedError == Approx(measuredError(equalizer, pruned.kept, 20.0, 1000.0)).margin(2e-3));
    CHECK(pruned.predictedError > 0.01);
}

TEST_CASE("An equaliser that does something everywhere stays as it is", "[actuator]")
{
    const EqualizerSections table{{EqualizerType::peak, 68.0, -10.0, 1.6, 2},
                                  {EqualizerType::peak, 1200.0, -3.0, 1.5, 2},
                                  {EqualizerType::highpass, 20.0, 0.0, 1.0, 5}};
    auto pruned = pruneEqualizer(table, {}, 48000.0);
    CHECK(pruned.kept == table);
    CHECK(pruned.dropped.empty());
    CHECK(pruned.predictedError == 0.0);
    // of a narrow actuator only the first matters
    pruned = pruneEqualizer(table, {100.0_Hz, 250.0_Hz, 0.1_dB}, 48000.0);
    CHECK(pruned.kept == EqualizerSections{table[0]});
    CHECK(pruneEqualizer({}, {}, 48000.0).kept.empty());
}

TEST_CASE("A peak too narrow for any grid is seen", "[actuator]")
{
    for (const double f : {21.0, 67.123, 456.789, 999.0})
    {
        const EqualizerSections narrow{{EqualizerType::peak, f, 3.0, 100.0, 2}};
        CHECK(pruneEqualizer(narrow, {}, 48000.0).kept == narrow);
        const EqualizerSections low{{EqualizerType::peak, f, 0.099, 100.0, 2}};
        CHECK(pruneEqualizer(low, {}, 48000.0).predictedError == Approx(0.099).epsilon(1e-3));
    }
}

TEST_CASE("The predicted error of pruning bounds the measured one", "[actuator]")
{
    Random random(8);
    int dropped = 0;
    for (int i = 0; i < 60; ++i)
    {
        CAPTURE(i);
        EqualizerSections equalizer;
        for (std::uint64_t n = 1 + random.next() % 6; n > 0; --n)
        {
            const auto type = static_cast<EqualizerType>(random.next() % 4);
            equalizer.pushBack(
                {type,
                 type == EqualizerType::highpass ? random.uniform(5.0, 50.0) : 5.0 * std::pow(700.0, random.uniform()),
                 random.uniform(-1.0, 1.0), random.uniform(0.3, 4.0), 1 + static_cast<int>(random.next() % 4)});
        }
        const double tolerance = random.uniform(0.02, 1.0);
        const auto pruned = pruneEqualizer(equalizer, {60.0_Hz, 800.0_Hz, Decibels(tolerance)}, pruningRate);
        REQUIRE(pruned.kept.size() + pruned.dropped.size() == equalizer.size());
        for (const auto& section : pruned.dropped)
            CHECK(section.deviation <= tolerance);
        const double measured = measuredError(equalizer, pruned.kept, 60.0, 800.0);
        CHECK(measured <= pruned.predictedError + 2e-3);
        CHECK(measured >= 0.9 * pruned.predictedError - 2e-3);
        dropped += static_cast<int>(pruned.dropped.size());
    }
    CHECK(dropped > 40);
}
