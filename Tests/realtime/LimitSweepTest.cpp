#include "realtime/LimitSweep.h"

#include "support/ActuatorOf.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <cstdint>

using namespace pacini;

namespace
{
/// Holds the same noise in both, whose places then agree within `margin`.
template <typename Swinging, typename Integrated>
void checkSwingsAs(Swinging& swinging, Integrated& integrated, double margin)
{
    for (const float u : test::noise(4000, 3))
    {
        swinging.hold(static_cast<double>(u));
        integrated.hold(static_cast<double>(u));
    }
    CHECK(swinging.displacement() == Approx(integrated.displacement()).epsilon(margin));
    CHECK(swinging.velocity() == Approx(integrated.velocity()).epsilon(margin));
    CHECK(swinging.peak() == Approx(integrated.peak()).epsilon(1e-3));
}
} // namespace

TEST_CASE("No drive takes one of a thousand random actuators beyond its limits", "[realtime][protection]")
{
    // Not by the steps of the guard nor by those of the long sweep, but by an integration of its own.
    using Mass = test::SimulatedResonator;
    std::array<int, 3> pushed{};
    int pushedAsWorn = 0;
    for (std::uint64_t seed = 1; seed <= 1000; ++seed)
    {
        const auto [limitCase, strain] = test::runLimitCase<Mass>(seed);
        CAPTURE(seed, limitCase.way, limitCase.fs, limitCase.profile.drive.overdrive);
        CHECK(strain.travel <= test::Witness<Mass>::tolerance);
        CHECK(strain.worn <= test::Witness<Mass>::tolerance);
        CHECK(strain.heat <= test::Witness<Mass>::tolerance);
        CHECK(strain.level <= 1.0);
        pushed[static_cast<std::size_t>(limitCase.way)] += strain.worst() > 0.9 ? 1 : 0;
        pushedAsWorn += strain.worn > 0.9 && strain.worn > strain.travel ? 1 : 0;
    }
    // The limits are really reached, on every way.
    CHECK(pushed[0] > 300);
    CHECK(pushed[1] > 100);
    CHECK(pushed[2] > 50);
    CHECK(pushedAsWorn > 50);
}

TEST_CASE("The mass of the long sweep swings as the integrated one", "[realtime][protection]")
{
    for (const double q : {0.1, 0.4, 0.6, 5.0, 1000.0})
        for (const double fs : {8000.0, 192000.0})
        {
            CAPTURE(q, fs);
            test::SwingingMass swinging(400.0, q, 1e-3, fs);
            test::SimulatedResonator integrated(400.0, q, 1e-3, fs);
            checkSwingsAs(swinging, integrated, 1e-5);
        }
}

TEST_CASE("The worn mass of the long sweep swings as the integrated one", "[realtime][protection]")
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        Random random(seed);
        Profile profile;
        profile.resonance = {random.uniform(20.0, 400.0), random.uniform(0.3, 50.0)};
        profile.drive.excursion = 1e-3;
        test::wear(profile, random);
        const double fs = seed % 2 == 0 ? 8000.0 : 192000.0;
        CAPTURE(seed, fs);
        const test::WornChain chain(*profile.body, profile.resonance,
                                    static_cast<double>(test::WornChain::forceOf(profile)));
        test::SwingingBody swinging(chain, fs);
        test::SimulatedBody integrated(chain, fs);
        checkSwingsAs(swinging, integrated, 1e-4);
    }
}

TEST_CASE("A new set-up does not forget that the actuator moves and is warm", "[realtime][protection]")
{
    const double fs = 8000.0;
    TranslatorSetup setup;
    Profile& profile = setup.profile.emplace(test::actuatorOf(Technology::lra, {175.0, 50.0}, {100.0, 400.0, 60.0}));
    profile.drive = {8.0, 2.0, 0.2, 1.0, 1e-3, 1e-4}; // ohm, V, W, s, m, m
    setup.maxBoost = 0_dB;
    Translator translator;
    translator.setSetup(setup);
    translator.prepare({fs, 100});
    TranslatorParams params;
    params.intensity = 24.0;
    translator.setParams(params);
    test::Witness<test::SimulatedResonator> witness(profile, fs);
    auto x = test::sine(32000, 175.0, fs);
    for (std::size_t i = 0; i < x.size(); i += 100)
    {
        if (i % 400 == 0)
        {
            setup.bands.bands = 1 + (i / 400) % 6;
            translator.setSetup(setup);
        }
        const auto block = std::span(x).subspan(i, 100);
        translator.process(block, block);
        witness.hold(block);
    }
    CHECK(witness.strain().travel > 0.9);
    CHECK(witness.strain().travel <= 1.001);
    CHECK(witness.strain().heat <= 1.001);
}
