#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"

#include <pacini/filters/FilterBank.h>

using namespace pacini;
using namespace pacini::test;

namespace
{

std::vector<std::vector<float>> split(const BandLayoutParams& params, double fs, std::span<const float> x)
{
    FilterBank bank;
    bank.setParams(params);
    bank.prepare({fs, x.size()});
    std::vector<std::vector<float>> bands(bank.bands(), std::vector<float>(x.size()));
    const std::vector<std::span<float>> views(bands.begin(), bands.end());
    bank.process(x, views);
    return bands;
}

BandLayoutParams withBands(std::size_t n)
{
    BandLayoutParams params;
    params.bands = n;
    return params;
}

} // namespace

TEST_CASE("The causal bank has the reference's magnitudes", "[filters][golden]")
{
    const auto data = golden("filterbank");
    int compared = 0;
    for (const auto& entry : data["cases"])
    {
        if (entry["design"] != "lr4")
            continue;
        const double fs = entry["fs"];
        const auto bank = designFilterBank(withBands(entry["n"]), fs);
        for (std::size_t k = 0; k < bank.bands(); ++k)
            for (std::size_t i = 0; i < data["freqs"].size(); ++i)
            {
                const double f = data["freqs"][i];
                const double expected = entry["mag"][k][i];
                CAPTURE(fs, k, f);
                CHECK(std::abs(bank.response(k, Hertz(f), fs)) ==
                      Approx(expected).epsilon(data["tol_rel"].get<double>()));
            }
        ++compared;
    }
    CHECK(compared == 9);
}

TEST_CASE("The causal bank has the reference's impulse responses", "[filters][golden]")
{
    const auto data = golden("filterbank")["impulse"];
    const auto bands = split(withBands(data["n"]), data["fs"], impulse(400));
    for (std::size_t k = 0; k < bands.size(); ++k)
        for (std::size_t i = 0; i < 400; ++i)
            CHECK(std::abs(static_cast<double>(bands[k][i]) - data["first_400"][k][i].get<double>()) <=
                  data["tol"].get<double>());
}

TEST_CASE("The causal bank's measured responses equal response() and sum to a flat spectrum", "[filters]")
{
    for (const std::size_t n : {1u, 2u, 5u, 6u, 24u, 32u})
        for (const auto spacing : {BandSpacing::logarithmic, BandSpacing::linear})
        {
            const double fs = 4000.0;
            BandLayoutParams params{n, 30_Hz, 1000_Hz, spacing, BandLayoutKind::tiled};
            const auto h = split(params, fs, impulse(16384));
            const auto bank = designFilterBank(params, fs);
            for (const double f : {20.0, 43.0, 100.0, 317.0, 800.0, 1900.0})
            {
                std::complex<double> sum = 0.0;
                for (std::size_t k = 0; k < n; ++k)
                {
                    const auto measured = spectrumAt<float>(h[k], f, fs);
                    CAPTURE(n, k, f);
                    CHECK(std::abs(measured - bank.response(k, Hertz(f), fs)) < 2e-6);
                    sum += measured;
                }
                CHECK(std::abs(sum) == Approx(1.0).epsilon(1e-5));
            }
        }
}

TEST_CASE("Neighbouring bands cross at -6 dB and in phase", "[filters]")
{
    const double fs = 48000.0;
    const auto bank = designFilterBank(withBands(6), fs);
    const auto layout = designBandLayout(withBands(6));
    // The other crossovers take a little off both sides alike.
    for (std::size_t k = 0; k + 1 < 6; ++k)
    {
        const auto below = bank.response(k, layout.crossovers[k], fs);
        const auto above = bank.response(k + 1, layout.crossovers[k], fs);
        CHECK(std::abs(below - above) < 0.06);
        CHECK(Decibels::fromGain(std::abs(below)).value == Approx(-6.02).margin(0.6));
    }
}

TEST_CASE("The causal bank works on up to 32 bands at 8 to 768 kHz", "[filters][contract]")
{
    for (const std::size_t n : {1u, 2u, 6u, 32u})
        for (const std::size_t output : {std::size_t(0), n / 2, n - 1})
            checkBlockContract<OutputOf<FilterBank>>(
                {withBands(n), output}, {.bound = 4.0,
                                         .frames = 4500,
                                         .delay = n < 32 ? MeasuredDelay::firstFrame : MeasuredDelay::notMeasured});
    checkSilenceIsCheap<OutputOf<FilterBank>>({withBands(6), 0});
    checkSilenceIsCheap<OutputOf<FilterBank>>({withBands(6), 3});
    checkSilenceIsCheap<OutputOf<FilterBank>>({withBands(6), 0}, 480000);
}

TEST_CASE("The causal bank stays bounded while its layout jumps", "[filters][contract]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<OutputOf<FilterBank>::Params> layouts;
    for (const double high : {100.0, 1000.0, 3900.0, 1e9, nan})
        layouts.push_back({{6, 30_Hz, Hertz(high)}, 3});
    checkModulation<OutputOf<FilterBank>>(layouts, 1000.0);
}

TEST_CASE("Bands that the causal bank loses and regains start from silence", "[filters]")
{
    const auto x = noise(1000, 4);
    FilterBank bank;
    bank.setParams(withBands(4));
    bank.prepare({8000.0, 1000});
    std::vector<std::vector<float>> found(4, std::vector<float>(1000));
    std::vector<std::span<float>> views(found.begin(), found.end());
    bank.process(x, views);
    bank.setParams(withBands(1));
    bank.setParams(withBands(4));
    bank.process(x, views);
    CHECK(found == split(withBands(4), 8000.0, x));
}
