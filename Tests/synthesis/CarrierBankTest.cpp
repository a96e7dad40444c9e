#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/Random.h>
#include <pacini/synthesis/CarrierBank.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

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

TEST_CASE("Carriers that begin at whole quarters of a turn have exact zeros and ones there", "[synthesis]")
{
    for (const double start : {0.0, 0.25, 0.5, 0.75, 1.0, -0.25, 1e6 + 0.5})
    {
        Carrier carrier;
        carrier.phase = start;
        carrier.amplitude = {{0.0, 1.0}};
        carrier.frequency = {{0.0, 0.1}};
        CarrierBank bank({carrier});
        const auto y = play(bank, 1, 1);
        const double quarter = start - std::floor(start);
        REQUIRE(y[0] == (quarter == 0.25 ? 1.0 : quarter == 0.75 ? -1.0 : 0.0));
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

namespace
{
/// Both parts of the sum by its definition, frame by frame in long double; `pieces` in order of their frames.
std::vector<std::complex<long double>> carriersByDefinition(const std::vector<Carrier>& carriers,
                                                            const std::vector<ClockPiece>& pieces, std::size_t frames)
{
    std::vector<std::complex<long double>> y(frames);
    for (const Carrier& carrier : carriers)
    {
        auto phase = static_cast<long double>(carrier.phase);
        for (std::size_t n = 0; n < frames; ++n)
        {
            ClockPiece piece;
            for (const ClockPiece& next : pieces)
                if (next.from <= static_cast<double>(n))
                    piece = next;
            const double t = piece.clip + (static_cast<double>(n) - piece.from) * piece.rate;
            y[n] += std::polar(static_cast<long double>(valueAt(carrier.amplitude, t)),
                               2.0L * std::numbers::pi_v<long double> * (phase - std::floor(phase)));
            phase += static_cast<long double>(std::min(0.45, valueAt(carrier.frequency, t) * piece.pitch));
        }
    }
    return y;
}

/// The bank's frames from `from` to `to`, added to `re` and `im`.
void addCarriers(CarrierBank& bank, std::vector<double>& re, std::vector<double>& im, std::size_t from, std::size_t to,
                 std::size_t block = 64)
{
    for (std::size_t i = from; i < to; i += block)
    {
        const std::size_t n = std::min(block, to - i);
        bank.process(std::span(re).subspan(i, n), std::span(im).subspan(i, n));
    }
}
} // namespace

TEST_CASE("Carriers follow pieces of the clock in both parts of the signal, and end at 0.45 of the rate", "[synthesis]")
{
    const std::vector<Carrier> carriers = {
        {{{0.0, 0.1}, {300.0, 0.9}, {300.0, 0.4}, {900.25, 0.2}}, {{0.0, 0.02}, {500.0, 0.02}, {500.0, 0.05}}, 0.3},
        {{{50.5, 0.5}}, {{0.0, 0.3}}, 0.0},
        {{}, {{0.0, 0.1}}, 0.0},
        {{{0.0, 0.0}, {2000.0, 0.0}}, {{0.0, 0.1}}, 0.0},
        {{{0.0, 0.0}, {700.0, 0.0}, {800.0, 1.0}}, {{0.0, 0.11}}, 0.7}};
    const std::vector<ClockPiece> pieces = {
        {0.0, 0.0, 1.0, 1.0}, {100.0, 100.0, 0.5, 1.5}, {400.0, 250.0, 2.0, 0.5}, {700.0, 850.0, 1.0, 3.0}};
    const auto wanted = carriersByDefinition(carriers, pieces, 1000);
    for (const std::size_t block : {std::size_t(64), std::size_t(1), std::size_t(5), std::size_t(300)})
    {
        CAPTURE(block);
        CarrierBank bank(carriers);
        std::vector<double> re(1000, 0.25), im(1000, -0.5);
        for (std::size_t k = 0; k < pieces.size(); ++k)
        {
            bank.follow(pieces[k]);
            addCarriers(bank, re, im, static_cast<std::size_t>(pieces[k].from),
                        k + 1 < pieces.size() ? static_cast<std::size_t>(pieces[k + 1].from) : 1000, block);
        }
        for (std::size_t n = 0; n < 1000; ++n)
        {
            CAPTURE(n);
            REQUIRE(re[n] - 0.25 == Approx(static_cast<double>(wanted[n].real())).margin(1e-10));
            REQUIRE(im[n] + 0.5 == Approx(static_cast<double>(wanted[n].imag())).margin(1e-10));
        }
        // From the start the clock is its own again.
        bank.reset();
        std::vector<double> again(90, 0.0), imaginary(90, 0.0);
        addCarriers(bank, again, imaginary, 0, 90, block);
        const auto start = carriersByDefinition(carriers, {}, 90);
        for (std::size_t n = 0; n < 90; ++n)
            REQUIRE(again[n] == Approx(static_cast<double>(start[n].real())).margin(1e-10));
    }
    CHECK(Carrier{}.phase == 0.0);
}

TEST_CASE("A pitch that glides beyond 0.45 of the rate stays where the clock pushed it", "[synthesis]")
{
    // From 0.1 to 0.2 cycles a frame, three times as high: 0.45 is reached halfway.
    const Carrier carrier{{{0.0, 1.0}}, {{0.0, 0.1}, {1000.0, 0.2}, {1500.0, 0.05}}, 0.0};
    for (const double pitch : {1.0, 2.25, 2.3, 3.0, 6.0})
    {
        CarrierBank bank({carrier});
        bank.follow({0.0, 0.0, 1.0, pitch});
        std::vector<double> re(2000, 0.0), im(2000, 0.0);
        addCarriers(bank, re, im, 0, 2000);
        checkPinned("synthesis/carrier pushed up by " + std::to_string(std::lround(100.0 * pitch)) + " %", im, 1e-7);
        for (std::size_t n = 0; n < 2000; ++n)
            REQUIRE(re[n] * re[n] + im[n] * im[n] == Approx(1.0).epsilon(1e-9));
    }
}

TEST_CASE("What is skipped is as if it had been played", "[synthesis]")
{
    const std::vector<Carrier> carriers = {
        {{{0.0, 0.1}, {300.0, 0.9}, {900.25, 0.2}}, {{0.0, 0.02}, {500.0, 0.04}, {500.0, 0.05}, {700.0, 0.3}}, 0.3},
        {{{50.5, 0.5}}, {{0.0, 0.3}}, 0.6}};
    CarrierBank played(carriers);
    std::vector<double> re(1200, 0.0), im(1200, 0.0);
    addCarriers(played, re, im, 0, 1200);
    for (const std::size_t from : {std::size_t(1), std::size_t(255), std::size_t(450), std::size_t(1000)})
        for (const std::size_t before : {std::size_t(0), std::size_t(1)})
        {
            CAPTURE(from, before);
            CarrierBank skipped(carriers);
            std::vector<double> x(1200, 0.0), y(1200, 0.0);
            addCarriers(skipped, x, y, 0, before);
            skipped.skip(static_cast<std::int64_t>(from - before));
            addCarriers(skipped, x, y, from, 1200);
            for (std::size_t n = from; n < 1200; ++n)
            {
                REQUIRE(x[n] == Approx(re[n]).margin(1e-9));
                REQUIRE(y[n] == Approx(im[n]).margin(1e-9));
            }
        }
}

TEST_CASE("A frequency of its own may be above 0.45 of the rate, and an amplitude may rise by 1 a frame", "[synthesis]")
{
    CarrierBank bank({{{{0.0, 0.0}, {8.0, 8.0}}, {{0.0, 0.48}}, 0.1}});
    std::vector<double> re(12, 0.0), im(12, 0.0);
    addCarriers(bank, re, im, 0, 12);
    for (std::size_t n = 0; n < 12; ++n)
        CHECK(im[n] == Approx(static_cast<double>(std::min<std::size_t>(n, 8)) *
                              std::sin(2.0 * std::numbers::pi * (0.1 + 0.48 * static_cast<double>(n))))
                           .margin(1e-10));
}
