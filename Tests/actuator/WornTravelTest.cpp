#include "actuator/SimulatedActuator.h"
#include "actuator/Witness.h"
#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Paths.h"

#include <pacini/actuator/OutputFilter.h>
#include <pacini/actuator/Protection.h>
#include <pacini/actuator/WornGuard.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{

using TravellingProfile = std::pair<std::string, Profile>;

/// All that are shipped with a travel limit and a body, without their limits of heat, which would hide the other.
std::vector<TravellingProfile> shippedWithTravel()
{
    std::vector<TravellingProfile> result;
    for (const ShippedProfile& shipped : shippedProfiles(sourceFolder()))
    {
        auto profile = readProfile(shipped.path);
        REQUIRE(profile.ok());
        profile->drive.maxPower.reset();
        if (profile->drive.maxExcursion && profile->body)
            result.push_back({shipped.name, *profile});
    }
    REQUIRE(result.size() >= 8);
    return result;
}

using Swinging = test::Witness<test::SwingingMass>;

Protection guarded(const Profile& profile, double fs, double lookAhead)
{
    Protection protection;
    protection.setParams(protectionParams(profile, Seconds(lookAhead)));
    protection.prepare({fs, 512});
    return protection;
}

/// The worst of signals on and around f Hz, at full scale and 20 dB over it.
test::Strain worstOfSignals(const Profile& profile, double f, double fs)
{
    const double w = 2.0 * std::numbers::pi;
    Random random(7);
    const std::vector<std::function<double(double)>> signals{
        [=](double t) { return std::sin(w * f * t); },
        [=](double t) { return std::sin(w * f * t) < 0.0 ? -1.0 : 1.0; },
        [=](double t) { return std::sin(w * f * (0.4 * t + 1.2 * t * t)); }, // from 0.4 f to 1.6 f in half a second
        [=](double t) { return std::fmod(t, 0.1) < 0.05 ? std::sin(w * f * t) : 0.0; },
        [=](double t) { return std::sin(w * f * t) + std::sin(w * 1.07 * f * t); },
        [&](double) { return random.uniform(-1.0, 1.0); },
        [](double t) { return t < 0.1 ? 1.0 : -1.0; },
    };
    test::Strain worst;
    for (const auto& signal : signals)
        for (const double gain : {1.0, 10.0})
            for (const double lookAhead : {0.0, 0.001})
            {
                auto protection = guarded(profile, fs, lookAhead);
                std::vector<float> x(static_cast<std::size_t>(0.5 * fs));
                for (std::size_t n = 0; n < x.size(); ++n)
                    x[n] = static_cast<float>(gain * signal(static_cast<double>(n) / fs));
                Swinging witness(profile, fs);
                witness.hold(test::runInBlocks(protection, x, 512));
                worst.add(witness.strain());
            }
    return worst;
}

/// The strain by an adversary who sees the mass as it is worn: he pushes with its velocity, which is the worst that a
/// drive within +-1 can do to a swing, and against it for a while to gather way for a turn.
test::Strain worstOfAdversary(const Profile& profile, double fs)
{
    auto protection = guarded(profile, fs, 0.0);
    Swinging witness(profile, fs);
    for (int n = 0; n < static_cast<int>(fs); ++n)
    {
        const auto& mass = *witness.movingAsWorn();
        float u = (n % 4000 < 3000 ? mass.velocity() : mass.displacement()) < 0.0 ? -1.0f : 1.0f;
        protection.process(std::span(&u, 1), std::span(&u, 1));
        witness.hold(u);
    }
    return witness.strain();
}

} // namespace

TEST_CASE("No signal takes a shipped actuator beyond its travel, held still or worn", "[actuator][protection][slow]")
{
    int reached = 0;
    for (auto& [name, profile] : shippedWithTravel())
        for (const double overdrive : {profile.drive.overdrive, 5.0})
            for (const double fs : {8000.0, 48000.0})
            {
                profile.drive.overdrive = overdrive;
                const double worn = loadedResonance(*profile.body, profile.resonance).frequency;
                auto strain = worstOfAdversary(profile, fs);
                for (const double f : {worn, profile.resonance.frequency})
                    strain.add(worstOfSignals(profile, f, fs));
                CAPTURE(name, fs, overdrive, strain.travel, strain.worn);
                CHECK(strain.travel <= Swinging::tolerance);
                CHECK(strain.worn <= Swinging::tolerance);
                reached += strain.worn > 0.98 ? 1 : 0;
            }
    CHECK(reached >= 20); // the travel is really used
}

TEST_CASE("The modes of a worn actuator add up to its travel", "[actuator][protection]")
{
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
    {
        Random random(seed);
        Profile profile;
        profile.technology = Technology::vca;
        profile.resonance = {random.uniform(20.0, 400.0),
                             seed % 3 == 0 ? random.uniform(0.05, 0.6) : random.uniform(0.5, 50.0)};
        profile.drive.excursion = 1e-3;
        test::wear(profile, random);
        const double fs = seed % 2 == 0 ? 8000.0 : 96000.0;
        CAPTURE(seed, fs, profile.resonance.q);
        const BodyChain chain = *wornChain(profile);
        const TravelModeList modes = travelModes(chain);
        test::SimulatedBody mass(
            test::WornChain(*profile.body, profile.resonance, static_cast<double>(test::WornChain::forceOf(profile))),
            fs);
        std::vector<ResonatorState> states(modes.size());
        double furthest = 0.0;
        double apart = 0.0;
        bool grows = false;
        for (int n = 0; n < 3000; ++n)
        {
            const double drive = n < 2000 ? random.uniform(-1.0, 1.0) : 0.0; // and rings on
            mass.hold(drive);
            double sum = 0.0;
            for (std::size_t i = 0; i < modes.size(); ++i)
            {
                const double before = states[i].energy();
                states[i] = modes[i].step(1.0 / fs).next(states[i], drive);
                grows |= drive == 0.0 && states[i].energy() > before * (1.0 + 1e-12);
                sum += states[i].displacement;
            }
            furthest = std::max(furthest, std::abs(sum));
            apart = std::max(apart, std::abs(sum - mass.displacement()));
        }
        CHECK(apart < 1e-6 * furthest);
        CHECK_FALSE(grows);
        // A constant drive ends where the spring of the suspension does.
        double rest = 0.0;
        for (const TravelMode& mode : modes)
            rest += mode.rest().displacement;
        CHECK(rest == Approx(chain.force / chain.suspensionStiffness).epsilon(1e-6));
    }
}

TEST_CASE("The worst of a mode is what the worst drive makes of it, and no less", "[actuator][protection]")
{
    for (const double q : {0.1, 0.5, 0.6, 2.0, 30.0})
        for (const double direct : {0.0, 0.3, -2.0})
        {
            CAPTURE(q, direct);
            TravelMode mode;
            mode.w = 400.0;
            mode.q = q;
            mode.toX = direct * mode.w;
            mode.toV = mode.w;
            // The integral of |impulse response|, by steps without drive.
            const double h = 1e-6;
            const HeldStep step = mode.step(h);
            ResonatorState z{mode.toX, mode.toV};
            double integral = 0.0;
            for (int n = 0; n < 1500000; ++n)
            {
                const double before = z.displacement;
                z = step.free(z);
                integral += 0.5 * h * std::abs(before + z.displacement);
            }
            CHECK(mode.worst() >= integral * (1.0 - 1e-5));
            if (q > 0.5)
                CHECK(mode.worst() == Approx(integral).epsilon(1e-4));
        }
}

TEST_CASE("The guard of the worn mass admits all but a hundredth of what it could", "[actuator][protection]")
{
    double least = 1.0;
    for (auto& [name, profile] : shippedWithTravel())
    {
        profile.drive.overdrive = 5.0;
        const double fs = 48000.0;
        const auto params = *excursionParams(profile);
        WornGuard guard;
        guard.design(*params.worn, params.maxExcursion, fs);
        const auto& c = guard.coefficients();
        std::vector<ResonatorState> modes(c.groups.size());
        Random random(3);
        for (int n = 0; n < 20000; ++n)
        {
            const double wanted = random.uniform(-1.0, 1.0) > 0.98 * std::cos(0.01 * n) ? 1.0 : -1.0;
            const double admitted = guard.admit(wanted);
            const auto sum = [&](double drive)
            {
                double all = 0.0;
                for (std::size_t i = 0; i < modes.size(); ++i)
                    all += std::sqrt(c.steps.back()[i].next(modes[i], drive).energy());
                return all;
            };
            REQUIRE(sum(admitted) <= c.limit * (1.0 + 1e-12));
            // The end of what is admissible, by halving.
            double low = 0.0, high = wanted;
            if (sum(high) <= c.limit)
                low = high;
            for (int i = 0; i < 50; ++i)
                (sum(0.5 * (low + high)) <= c.limit ? low : high) = 0.5 * (low + high);
            if (c.steps.size() == 1 && c.driveLimit == 1.0 && std::abs(low) > 1e-3)
                least = std::min(least, admitted / low);
            guard.advance(admitted);
            for (std::size_t i = 0; i < modes.size(); ++i)
                modes[i] = c.steps.back()[i].next(modes[i], admitted);
        }
    }
    CHECK(least > 0.99);
}

TEST_CASE("Of two numbers for the force of a worn actuator the larger counts", "[actuator][protection]")
{
    Profile profile = shippedWithTravel().front().second;
    const double stated = worstTravel(*wornChain(profile));
    profile.body->force *= 3.0;
    CHECK(worstTravel(*wornChain(profile)) == Approx(3.0 * stated).epsilon(0.01));
    profile.body->force /= 100.0;
    CHECK(worstTravel(*wornChain(profile)) == Approx(stated).epsilon(0.01));
    profile.technology = Technology::erm;
    CHECK_FALSE(wornChain(profile).has_value());
    profile.technology = Technology::vca;
    profile.body.reset();
    CHECK_FALSE(excursionParams(profile)->worn.has_value());
}

TEST_CASE("The limit of the worn mass is below its travel by 5 % at most, however strong the force",
          "[actuator][protection]")
{
    int bounded = 0;
    for (auto& [name, profile] : shippedWithTravel())
        for (const double strength : {0.01, 1.0, 10.0, 100.0, 1000.0})
            for (const double fs : {8000.0, 48000.0})
            {
                CAPTURE(name, strength, fs);
                auto chain = *wornChain(profile);
                chain.force *= strength;
                const double travel = *profile.drive.maxExcursion;
                const auto guard = designWornGuard(chain, travel, fs);
                CHECK(guard.limit < travel);
                // 5 % between the points, 0.25 % of the worst for modes that are not followed
                CHECK(guard.limit >= 0.949 * (travel - 0.0025 * worstTravel(chain)));
                CHECK(guard.driveLimit <= 1.0);
                bounded += guard.driveLimit < 1.0 ? 1 : 0;
            }
    CHECK(bounded > 0);
}

TEST_CASE("The worn mass has room between the points for what a chord and its curve may miss", "[actuator][protection]")
{
    for (auto& [name, profile] : shippedWithTravel())
        for (const double strength : {0.01, 1.0, 30.0, 1000.0})
            for (const double fs : {8000.0, 48000.0, 192000.0})
            {
                CAPTURE(name, strength, fs);
                auto chain = *wornChain(profile);
                chain.force *= strength;
                const double travel = *profile.drive.maxExcursion;
                const auto guard = designWornGuard(chain, travel, fs);
                double unfollowed = 0.0, w = 0.0, curve = 0.0, push = 0.0, pushedCurve = 0.0;
                std::size_t followed = 0;
                for (const TravelMode& mode : travelModes(chain))
                {
                    if (unfollowed + mode.worst() <= 0.0025 * worstTravel(chain))
                    {
                        unfollowed += mode.worst();
                        continue;
                    }
                    ++followed;
                    w = std::max(w, mode.w);
                    curve = std::max(curve, mode.single ? mode.w * mode.w : mode.w * mode.w * (1.0 + 1.0 / mode.q));
                    push += mode.push();
                    pushedCurve += mode.w * std::abs(mode.single ? mode.toX : mode.toV);
                }
                REQUIRE(guard.groups.size() == followed);
                const auto points = static_cast<double>(guard.steps.size());
                CHECK((w <= 0.05 * fs * points || points == 32.0));
                CHECK((points == 1.0 || w > 0.05 * fs * (points - 1.0)));
                CHECK(guard.groupReach == Approx(static_cast<double>(groupFrames) * push / fs));

                const double h = 1.0 / (fs * points);
                const double room = std::max(0.0, travel - unfollowed);
                const auto missed = [&](double drive)
                {
                    return std::min(drive * h * push, h * h / 8.0 * (curve * room + drive * pushedCurve));
                };
                CHECK(guard.limit == Approx(room - missed(guard.driveLimit)).epsilon(1e-7));
                if (guard.driveLimit == 1.0)
                    CHECK(missed(1.0) <= 0.05 * room * (1.0 + 1e-12));
                else
                    CHECK(missed(guard.driveLimit) == Approx(0.05 * room));
            }
}
