#include "support/Catch.h"

#include <pacini/foundation/Random.h>
#include <pacini/synthesis/CarrierBank.h>

#include <cmath>
#include <numbers>

using namespace pacini;

namespace
{
/// The definition, frame by frame in long double.
std::vector<long double> reference(const Carrier& carrier, std::size_t frames)
{
    std::vector<long double> y(frames);
    long double phase = static_cast<long double>(carrier.phase);
    for (std::size_t n = 0; n < frames; ++n)
    {
        const auto t = static_cast<double>(n);
        y[n] = static_cast<long double>(valueAt(carrier.amplitude, t)) *
               std::sin(2.0L * std::numbers::pi_v<long double> * phase);
        phase += static_cast<long double>(valueAt(carrier.frequency, t));
    }
    return y;
}

std::vector<double> play(CarrierBank& bank, std::size_t frames, std::size_t block)
{
    std::vector<double> re(frames, 0.0), im(frames, 0.0);
    for (std::size_t i = 0; i < frames; i += block)
    {
        const auto n = std::min(block, frames - i);
        bank.process(std::span(re).subspan(i, n), std::span(im).subspan(i, n));
    }
    return im;
}
} // namespace

TEST_CASE("Carriers follow their curves as the definition in long double says", "[synthesis]")
{
    Random random(4);
    for (int run = 0; run < 30; ++run)
    {
        Carrier carrier;
        carrier.phase = random.uniform();
        for (double t = random.uniform(0.0, 50.0); t < 3000.0;
             t += std::floor(random.uniform(1.0, 300.0)) + (run % 3 == 0 ? 0.37 : 0.0))
            carrier.amplitude.push_back({t, random.uniform()});
        for (double t = 0.0; t < 3000.0; t += std::floor(random.uniform(50.0, 900.0)))
            carrier.frequency.push_back({t, random.uniform(0.001, 0.45)});
        const auto expected = reference(carrier, 3000);
        CarrierBank bank({carrier});
        const auto y = play(bank, 3000, 64);
        for (std::size_t n = 0; n < y.size(); ++n)
            REQUIRE(std::abs(static_cast<double>(expected[n]) - y[n]) < 1e-10);
    }
}

TEST_CASE("Carriers do not depend on the block size and start over after reset", "[synthesis]")
{
    Carrier carrier{
        {{0.0, 0.0}, {700.5, 1.0}, {701.0, 0.2}, {1500.0, 0.6}}, {{0.0, 0.01}, {900.0, 0.06}, {1000.0, 0.02}}, 0.3};
    CarrierBank bank({carrier, {{{0.0, 0.5}}, {{0.0, 0.1}}, 0.0}});
    const auto whole = play(bank, 2000, 2000);
    for (std::size_t block : {std::size_t(1), std::size_t(7), std::size_t(64), std::size_t(511)})
    {
        bank.reset();
        const auto cut = play(bank, 2000, block);
        for (std::size_t n = 0; n < whole.size(); ++n)
            REQUIRE(std::abs(cut[n] - whole[n]) < 1e-11);
    }
}

TEST_CASE("The phase is still exact after 24 hours", "[synthesis]")
{
    const double f = 0.0437; // cycles per frame
    CarrierBank bank({{{{0.0, 1.0}}, {{0.0, f}}, 0.0}});
    std::vector<double> re(65536, 0.0), im(65536, 0.0);
    const std::size_t hops = 24ull * 3600ull * 4000ull / 65536ull;
    bank.skip(static_cast<std::int64_t>(hops) * 65536);
    bank.process(re, im);
    long double phase = static_cast<long double>(f) * static_cast<long double>(hops * 65536);
    phase -= std::floor(phase);
    CHECK(std::abs(im[0] - static_cast<double>(std::sin(2.0L * std::numbers::pi_v<long double> * phase))) < 1e-6);
}
