#include "devices/RumbleMapper.h"

#include "devices/DecodeRumble.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
using Tones = std::vector<RumbleTone>;

double ratioOf(Hertz a, Hertz b)
{
    return std::max(a.value / b.value, b.value / a.value);
}

Tones randomBands(std::mt19937& random)
{
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Tones bands(8);
    for (RumbleTone& band : bands)
        band = {Hertz(40.0 * std::pow(20.0, unit(random))), unit(random) < 0.3 ? 0.0 : unit(random)};
    return bands;
}
} // namespace

TEST_CASE("Each band goes to the carrier that it is nearest to", "[devices]")
{
    const Tones bands{{100_Hz, 0.3}, {400_Hz, 0.6}};
    const RumbleTones carriers = carriersOf(bands);
    CHECK(carriers.low.frequency.value == Approx(100.0));
    CHECK(carriers.low.amplitude == Approx(0.3));
    CHECK(carriers.high.frequency.value == Approx(400.0));
    CHECK(carriers.high.amplitude == Approx(0.6));
    CHECK(carriersOf(Tones{{226_Hz, 0.5}}).low.amplitude == 0.5);
    CHECK(carriersOf(Tones{{227_Hz, 0.5}}).high.amplitude == 0.5);
}

TEST_CASE("A tone that sounds in two bands has the pitch that their energies say", "[devices]")
{
    // Equal energies: the geometric mean; energies 4 to 1: a fifth of the way.
    const RumbleTones equal = carriersOf(Tones{{90_Hz, 0.3}, {160_Hz, 0.3}});
    CHECK(equal.low.frequency.value == Approx(120.0));
    CHECK(equal.low.amplitude == Approx(0.3 * std::sqrt(2.0)));
    CHECK(carriersOf(Tones{{100_Hz, 0.4}, {200_Hz, 0.2}}).low.frequency.value == Approx(100.0 * std::pow(2.0, 0.2)));
}

TEST_CASE("Only the two strongest bands make a carrier's pitch, in whatever order they come", "[devices]")
{
    Tones bands{{100_Hz, 0.5}, {110_Hz, 0.4}, {50_Hz, 0.1}, {190_Hz, 0.3}, {300_Hz, 0.2}};
    const RumbleTones expected = carriersOf(Tones{bands[0], bands[1], bands[4]});
    std::mt19937 random(11);
    for (int i = 0; i < 20; ++i)
    {
        std::shuffle(bands.begin(), bands.end(), random);
        const RumbleTones carriers = carriersOf(bands);
        CHECK(carriers.low.frequency.value == Approx(expected.low.frequency.value));
        CHECK(carriers.low.amplitude == Approx(expected.low.amplitude));
        CHECK(carriers.high == expected.high);
    }
}

TEST_CASE("Bands that are silent or not finite change nothing", "[devices]")
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::nan("");
    CHECK(carriersOf({}) == RumbleTones{});
    CHECK(carriersOf(Tones{{60_Hz, 0.0},
                           {70_Hz, nan},
                           {80_Hz, infinity},
                           {90_Hz, -1.0},
                           {Hertz(nan), 1.0},
                           {Hertz(infinity), 1.0},
                           {0_Hz, 1.0}}) == RumbleTones{});
    CHECK(carriersOf(Tones{{100_Hz, 1e300}}).low.amplitude == 1.0);
}

TEST_CASE("Bands outside the range of HD rumble play at its ends", "[devices]")
{
    CHECK(carriersOf(Tones{{Hertz(1e-308), 0.5}, {Hertz(200.0), 1e-200}}).low.frequency.value == Approx(40.875885));
    CHECK(carriersOf(Tones{{Hertz(1e308), 0.5}}).high.frequency.value == Approx(1252.572266));
}

TEST_CASE("From packet to packet nothing goes beyond its target or jumps", "[devices]")
{
    const RumbleMapperParams params;
    const double share = 1.0 - std::exp(-1.5);
    const double pitchShare = 1.0 - std::exp(-0.75);
    std::mt19937 random(5);
    RumbleMapper handover(params);
    for (int i = 0; i < 2000; ++i)
    {
        const Tones bands = randomBands(random);
        const RumbleTones target = carriersOf(bands);
        const RumbleTones before = handover.played();
        const RumbleBytes bytes = handover.next(bands);
        const RumbleTones after = handover.played();
        CAPTURE(i);
        REQUIRE(decodeRumble(bytes).has_value());
        for (const auto& [was, is, aim] :
             {std::tuple{before.high, after.high, target.high}, std::tuple{before.low, after.low, target.low}})
        {
            REQUIRE(std::abs(is.amplitude - was.amplitude) <=
                    share * std::abs(aim.amplitude - was.amplitude) + rumbleAmplitude(1));
            if (was.amplitude > 0.0 && aim.amplitude > 0.0)
            {
                const double asked = std::log(ratioOf(was.frequency, aim.frequency));
                REQUIRE(std::log(ratioOf(was.frequency, is.frequency)) == Approx(pitchShare * asked).margin(1e-9));
                REQUIRE(std::log(ratioOf(is.frequency, aim.frequency)) <= asked + 1e-9);
            }
            else if (was.amplitude > 0.0)
                REQUIRE(is.frequency == was.frequency);
            else
                REQUIRE(is.frequency == aim.frequency);
        }
    }
}

TEST_CASE("A steady tone is reached and stays", "[devices]")
{
    RumbleMapper handover;
    const Tones bands{{123_Hz, 0.4}, {380_Hz, 0.5}};
    RumbleBytes last{};
    for (int i = 0; i < 30; ++i)
        last = handover.next(bands);
    CHECK(last == encodeRumble({bands[1], bands[0]}));
    CHECK(handover.next(bands) == last);
}

TEST_CASE("Two packets of half the interval end where one of the whole does", "[devices]")
{
    RumbleMapper whole({30_ms, 10_ms, 20_ms});
    RumbleMapper halves({15_ms, 10_ms, 20_ms});
    const std::vector<Tones> scenes{{{100_Hz, 0.8}}, {{180_Hz, 0.3}, {500_Hz, 0.2}}, {{90_Hz, 0.5}, {300_Hz, 0.4}}};
    for (const Tones& bands : scenes)
    {
        (void)whole.next(bands);
        (void)halves.next(bands);
        (void)halves.next(bands);
        CHECK(halves.played().low.amplitude == Approx(whole.played().low.amplitude));
        CHECK(halves.played().low.frequency.value == Approx(whole.played().low.frequency.value));
        CHECK(halves.played().high.amplitude == Approx(whole.played().high.amplitude));
    }
}

TEST_CASE("Silence ends in the packet that stops the actuator", "[devices]")
{
    RumbleMapper handover;
    CHECK(handover.next({}) == neutralRumble);
    const Tones loud{{100_Hz, 1.0}, {300_Hz, 1.0}};
    CHECK(handover.next(loud) != neutralRumble);
    CHECK(handover.next({}) != neutralRumble); // it fades
    int packets = 1;
    while (handover.next({}) != neutralRumble && packets < 100)
        ++packets;
    CHECK(packets * 15 <= 100);
    CHECK(handover.played().low.amplitude == 0.0);
    CHECK(handover.next(loud) != neutralRumble);
    handover.reset();
    CHECK(handover.next({}) == neutralRumble);
}

TEST_CASE("Times of zero follow at once", "[devices]")
{
    RumbleMapper handover({15_ms, 0_ms, 0_ms});
    const Tones first{{100_Hz, 0.5}};
    const Tones second{{60_Hz, 0.2}};
    CHECK(handover.next(first) == encodeRumble(carriersOf(first)));
    CHECK(handover.next(second) == encodeRumble(carriersOf(second)));
    CHECK(handover.next({}) == neutralRumble);
}
