#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"

#include <pacini/filters/BiquadCascade.h>
#include <pacini/filters/Butterworth.h>

#include <limits>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

BiquadCascadeParams tablePeaks()
{
    return {{BiquadType::peak, 30_Hz, 1.5, 16_dB},
            {BiquadType::peak, 68_Hz, 1.6, Decibels(-10.0)},
            {BiquadType::peak, 1200_Hz, 1.5, Decibels(-3.0)}};
}

} // namespace

TEST_CASE("The thesis's equalizer has the reference's response", "[filters][golden]")
{
    const auto data = golden("eq_table_3_2");
    for (const auto& entry : data["cases"])
    {
        const double fs = entry["fs"];
        BiquadCascadeCoefficients cascade;
        for (const int filter : entry["filters"])
        {
            if (filter < 4)
                cascade.sections.pushBack(designStateVariable(tablePeaks()[static_cast<std::size_t>(filter - 1)], fs));
            else
                for (const auto& section : designButterworth({ButterworthType::highpass, 5, 20_Hz, 0_Hz}, fs).sections)
                    cascade.sections.pushBack(section);
        }
        for (std::size_t i = 0; i < data["freqs"].size(); ++i)
        {
            const double f = data["freqs"][i];
            const double expected = entry["db"][i];
            CAPTURE(fs, f);
            const auto level = Decibels::fromGain(std::abs(cascade.response(Hertz(f), fs)));
            CHECK(std::abs(level.value - expected) <= data["tol_db"].get<double>());
        }
    }
}

TEST_CASE("A cascade's output is that of its sections one after the other", "[filters]")
{
    const auto x = noise(3000, 1);
    BiquadCascade cascade;
    cascade.setParams(tablePeaks());
    cascade.prepare({48000.0, 3000});
    std::vector<float> found(x.size());
    cascade.process(x, found);

    std::vector<double> expected(x.begin(), x.end());
    for (const BiquadParams& params : tablePeaks())
    {
        const auto c = designBiquad(params, 48000.0);
        BiquadState state;
        for (double& v : expected)
            v = state.tick(c, v);
    }
    for (std::size_t i = 0; i < x.size(); ++i)
        CHECK(std::abs(static_cast<double>(found[i]) - expected[i]) < 1e-6);
}

TEST_CASE("A cascade without sections passes everything unchanged", "[filters]")
{
    const auto x = noise(500, 2);
    BiquadCascade cascade;
    cascade.prepare({48000.0, 500});
    CHECK(runInBlocks(cascade, x, 100) == x);
    CHECK(cascade.coefficients().response(100_Hz, 48000.0) == std::complex<double>(1.0));
    const std::vector<float> awkward{0.5f, std::numeric_limits<float>::infinity(),
                                     std::numeric_limits<float>::quiet_NaN(), 1e-38f};
    CHECK(runInBlocks(cascade, awkward, 4) == std::vector<float>{0.5f, 0.0f, 0.0f, 0.0f});
}

TEST_CASE("Sections that a cascade loses and regains start from silence", "[filters]")
{
    BiquadCascade cascade;
    cascade.setParams({{BiquadType::lowpass, 100_Hz, 0.7}});
    cascade.prepare({48000.0, 512});
    const auto x = noise(512, 2);
    runInBlocks(cascade, x, 512);
    cascade.setParams({});
    cascade.setParams({{BiquadType::lowpass, 100_Hz, 0.7}});
    BiquadCascade fresh;
    fresh.setParams({{BiquadType::lowpass, 100_Hz, 0.7}});
    fresh.prepare({48000.0, 512});
    CHECK(runInBlocks(cascade, x, 512) == runInBlocks(fresh, x, 512));
}

TEST_CASE("BiquadCascade keeps the contract of blocks", "[filters][contract]")
{
    checkBlockContract<BiquadCascade>(tablePeaks(), {.delay = MeasuredDelay::firstFrame});
    BiquadCascadeParams full;
    for (std::size_t i = 0; i < full.capacity(); ++i)
        full.pushBack({BiquadType::peak, Hertz(20.0 * static_cast<double>(i + 1)), 3.0, 40_dB});
    checkBlockContract<BiquadCascade>(full, {.bound = 3.5e38});
    checkSilenceIsCheap<BiquadCascade>(tablePeaks());
    checkSilenceIsCheap<BiquadCascade>({{BiquadType::peak, 30_Hz, 1.5, 16_dB}}, 480000);
}
