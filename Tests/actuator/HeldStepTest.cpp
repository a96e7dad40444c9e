#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/actuator/HeldStep.h>
#include <pacini/actuator/MovingMass.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace pacini;

TEST_CASE("A held step is the rotation and decay of the textbook, and its drive moves the point of rest",
          "[actuator][protection]")
{
    for (const double q : {0.02, 0.3, 0.6, 4.0, 100.0})
        for (const double duration : {1e-6, 1.0 / 48000.0, 1.0 / 8000.0, 0.0021})
        {
            CAPTURE(q, duration);
            const HeldStep step = designHeldStep(150.0, q, 0.25, duration);
            const long double angle =
                2.0L * std::numbers::pi_v<long double> * 150.0L * static_cast<long double>(duration);
            const long double zeta = 0.5L / static_cast<long double>(q);
            const long double root = std::sqrt(std::abs(1.0L - zeta * zeta));
            const long double decay = std::exp(-zeta * angle);
            const long double c = decay * (zeta < 1.0L ? std::cos(root * angle) : std::cosh(root * angle));
            const long double s = decay * (zeta < 1.0L ? std::sin(root * angle) : std::sinh(root * angle)) / root;
            const double size = 1e-12;
            CHECK(step.xx == Approx(static_cast<double>(c + zeta * s - 1.0L)).margin(size));
            CHECK(step.xv == Approx(static_cast<double>(s)).margin(size));
            CHECK(step.vx == Approx(static_cast<double>(-s)).margin(size));
            CHECK(step.vv == Approx(static_cast<double>(c - zeta * s - 1.0L)).margin(size));
            CHECK(step.driveToX == -0.25 * step.xx);
            CHECK(step.driveToV == -0.25 * step.vx);
        }
}

TEST_CASE("Two held steps in a row are one of twice the time", "[actuator][protection]")
{
    const HeldStep once = designHeldStep(90.0, 0.7, 2.0, 1e-3);
    const HeldStep thrice = designHeldStep(90.0, 0.7, 2.0, 3e-3);
    const HeldStep twice = designHeldStep(90.0, 0.7, 2.0, 2e-3);
    for (const HeldStep& made : {once.then(twice), twice.then(once), once.then(once).then(once)})
    {
        CHECK(made.xx == Approx(thrice.xx).epsilon(1e-12));
        CHECK(made.xv == Approx(thrice.xv).epsilon(1e-12));
        CHECK(made.vx == Approx(thrice.vx).epsilon(1e-12));
        CHECK(made.vv == Approx(thrice.vv).epsilon(1e-12));
        CHECK(made.driveToX == Approx(thrice.driveToX).epsilon(1e-12));
        CHECK(made.driveToV == Approx(thrice.driveToV).epsilon(1e-12));
    }
    const HeldStep a{0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    const HeldStep b{-0.7, 0.8, 0.9, -1.0, 1.1, 1.2};
    const ResonatorState z{2.0, -3.0};
    const ResonatorState there = a.then(b).next(z, 5.0), stepped = b.next(a.next(z, 5.0), 5.0);
    CHECK(there.displacement == Approx(stepped.displacement).epsilon(1e-14));
    CHECK(there.velocity == Approx(stepped.velocity).epsilon(1e-14));
    CHECK(a.free(z).displacement == Approx(2.0 + 0.2 - 0.6).epsilon(1e-14));
    CHECK(a.free(z).velocity == Approx(-3.0 + 0.6 - 1.2).epsilon(1e-14));
    CHECK(a.next(z, 5.0).displacement == Approx(1.6 + 2.5).epsilon(1e-14));
    CHECK(a.next(z, 5.0).velocity == Approx(-3.6 + 3.0).epsilon(1e-14));
    CHECK(z.energy() == 13.0);
    CHECK(ResonatorState{}.energy() == 0.0);
    CHECK(HeldStep{}.next(z, 7.0).displacement == 2.0);
    CHECK(HeldStep{}.next(z, 7.0).velocity == -3.0);
}

TEST_CASE("A step over a group has the drives of each of its frames", "[actuator][protection]")
{
    const HeldStep step{-0.1, 0.2, -0.3, -0.15, 0.5, 0.6};
    const GroupStep group = designGroupStep(step);
    for (std::size_t driven = 0; driven <= groupFrames; ++driven) // one drive alone, and none
    {
        FrameGroup drives{};
        if (driven < groupFrames)
            drives[driven] = 2.0;
        ResonatorState z{0.3, -0.4};
        const ResonatorState there = group.next(z, drives);
        for (const double drive : drives)
            z = step.next(z, drive);
        CHECK(there.displacement == Approx(z.displacement).epsilon(1e-14));
        CHECK(there.velocity == Approx(z.velocity).epsilon(1e-14));
    }
    CHECK(GroupStep{}.next({1.0, 2.0}, {1.0, 1.0, 1.0, 1.0}).displacement == 1.0);
    CHECK(GroupStep{}.next({1.0, 2.0}, {1.0, 1.0, 1.0, 1.0}).velocity == 2.0);
}

TEST_CASE("Two masses that step over a group side by side get to the numbers of each alone", "[actuator][protection]")
{
    const GroupStep group = designGroupStep(designHeldStep(180.0, 2.5, 0.7, 1e-4));
    ResonatorState first{0.3, -0.4}, second{-1e-9, 5.0};
    TwoStates both(first, second);
    for (int n = 0; n < 50; ++n)
    {
        FrameGroup a, b;
        std::array<Pair, groupFrames> drives;
        for (std::size_t k = 0; k < groupFrames; ++k)
        {
            a[k] = std::sin(0.7 * static_cast<double>(k) + n);
            b[k] = 1.0 / (static_cast<double>(k) - 3.3 * n + 0.1);
            drives[k] = Pair(a[k], b[k]);
        }
        first = group.next(first, a);
        second = group.next(second, b);
        both = group.next(both, drives);
        CHECK(both.first().displacement == first.displacement);
        CHECK(both.first().velocity == first.velocity);
        CHECK(both.second().displacement == second.displacement);
        CHECK(both.second().velocity == second.velocity);
        CHECK(both.energy().first() == first.energy());
        CHECK(both.energy().second() == second.energy());
    }
}

TEST_CASE("A mass begins a group where it is, for steps of another design", "[actuator][protection]")
{
    const HeldStep step = designHeldStep(200.0, 3.0, 1.0, 1e-4), other = designHeldStep(90.0, 0.4, 0.5, 1e-4);
    for (std::size_t before = 0; before <= 9; ++before)
    {
        CAPTURE(before);
        MovingMass mass;
        ResonatorState expected;
        for (std::size_t n = 0; n < before; ++n)
        {
            const double drive = 0.1 * static_cast<double>(n) - 0.3;
            mass.follow(drive, step, designGroupStep(step));
            expected = step.next(expected, drive);
        }
        mass.beginGroup();
        const double at = mass.state().displacement;
        CHECK(at == Approx(expected.displacement).margin(1e-15));
        for (std::size_t n = 0; n < 11; ++n)
        {
            const double drive = 0.2 * static_cast<double>(n) - 0.7;
            mass.follow(drive, other, designGroupStep(other));
            expected = other.next(expected, drive);
            CHECK(mass.state().displacement == Approx(expected.displacement).margin(1e-14));
            CHECK(mass.state().velocity == Approx(expected.velocity).margin(1e-14));
        }
    }
}

TEST_CASE("What is left of a mass's motion far below all that is heard becomes 0", "[actuator][protection]")
{
    const HeldStep still{0.0, 0.0, 0.0, 0.0, 1e-110, 1e-105};
    const GroupStep group = designGroupStep(still);
    for (const std::size_t frames : {std::size_t(1), std::size_t(4), std::size_t(6)})
    {
        MovingMass mass;
        for (std::size_t n = 0; n < frames; ++n)
            mass.follow(1.0, still, group);
        CHECK(mass.state().displacement > 0.0);
        CHECK(mass.state().velocity > 0.0);
        mass.flush();
        CHECK(mass.state().displacement == 0.0);
        CHECK(mass.state().velocity == 0.0);
        for (std::size_t n = frames % groupFrames; n < groupFrames; ++n) // to the end of the group, in which it began
            mass.follow(0.0, still, group);
        // Drives of this group count again; what was before it is gone.
        CHECK(mass.state().displacement <= 1e-110 * static_cast<double>(frames % groupFrames) * 1.001);
        CHECK(mass.state().velocity <= 1e-105 * static_cast<double>(frames % groupFrames) * 1.001);
    }
    const HeldStep large{0.0, 0.0, 0.0, 0.0, 1e-90, 1e-99};
    MovingMass mass;
    mass.follow(1.0, large, designGroupStep(large));
    mass.flush();
    CHECK(mass.state().displacement == 1e-90);
    CHECK(mass.state().velocity == 1e-99);
}
