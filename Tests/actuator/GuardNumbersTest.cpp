// The numbers of guards, limiters and motors: what they admit, measure and play.

#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/actuator/LevelLimiter.h>
#include <pacini/actuator/MotorDrive.h>
#include <pacini/actuator/Protection.h>
#include <pacini/actuator/SpinningMotor.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{

/// Tones that swell from far below to `top` and back, with a click.
std::vector<float> swellingDrive(std::size_t frames, double top, double step)
{
    std::vector<float> x(frames);
    for (std::size_t n = 0; n < frames; ++n)
    {
        const double t = static_cast<double>(n) / static_cast<double>(frames);
        const double swell = top * std::pow(std::sin(3.14159 * t), 4.0);
        x[n] = static_cast<float>(
            swell * (std::sin(step * static_cast<double>(n)) + 0.3 * std::cos(2.7 * step * static_cast<double>(n))));
    }
    x[frames / 3] = static_cast<float>(top);
    return x;
}

std::vector<double> asNumbers(const std::vector<float>& x)
{
    return {x.begin(), x.end()};
}

struct GuardExample
{
    std::string name;
    ExcursionParams params;
};

std::vector<GuardExample> guardExamples()
{
    Profile profile;
    profile.technology = Technology::vca;
    profile.resonance = {67.0, 3.97};
    profile.drive.excursion = 1e-3;
    profile.drive.maxExcursion = 1.5e-3;
    profile.body = BodyParams{1.342, 0.012, 0.040, 4.0e4, 5.0, 0.010, 800.0, 2.5};
    const auto worn = wornChain(profile);
    profile.resonance.q = 0.2;
    profile.drive.overdrive = 4.0;
    profile.body->skinDamping = 60.0;
    const auto damped = wornChain(profile);
    return {
        {"still", {Hertz(67.0), 3.97, 3e-3, 1.5e-3, {}}},      {"fast", {Hertz(1500.0), 10.0, 2e-3, 1e-3, {}}},
        {"worn", {Hertz(67.0), 3.97, 3e-3, 1.5e-3, worn}},     {"worn, damped", {Hertz(67.0), 0.2, 8e-3, 1e-3, damped}},
        {"worn, weak", {Hertz(67.0), 3.97, 1e-6, 3e-4, worn}},
    };
}

} // namespace

TEST_CASE("What the guards of travel measure and admit stays as it was", "[actuator][protection]")
{
    for (const auto& [name, params] : guardExamples())
        for (const double fs : {4000.0, 48000.0})
        {
            ExcursionGuard guard;
            guard.design(params, fs);
            const auto& c = guard.coefficients();
            std::vector<double> numbers{static_cast<double>(c.steps.size()), std::log(c.energyLimit), c.driveLimit,
                                        std::log(c.groupReach)};
            if (params.worn)
            {
                const auto w = designWornGuard(*params.worn, params.maxExcursion, fs);
                numbers.insert(numbers.end(),
                               {static_cast<double>(w.steps.size()), static_cast<double>(w.groups.size()),
                                std::log(w.limit), w.driveLimit, std::log(w.groupReach)});
            }
            const std::string which = "actuator/guard, " + name + " " + std::to_string(static_cast<int>(fs));
            checkPinned(which, numbers, 1e-6);
            numbers.clear();
            const auto drive = swellingDrive(1001, 1.3, 2.0 * 3.14159 * 71.0 / fs);
            for (std::size_t n = 0; n < drive.size(); ++n)
            {
                const auto u = static_cast<double>(drive[n]);
                numbers.push_back(guard.measure(u));
                numbers.push_back(guard.admit(u));
                CHECK(std::abs(numbers.back()) <= std::abs(u));
                CHECK(numbers.back() * u >= 0.0);
                guard.advance(numbers.back());
                if (n == 700) // goes on from where it is
                    guard.design(params, fs);
            }
            if (name != "fast") // there the guard acts at nearly every frame, and rounding adds up
                checkPinned(which + ", run", numbers, 1e-4);
            // And after a reset as at first.
            guard.reset();
            ExcursionGuard fresh;
            fresh.design(params, fs);
            for (int n = 0; n < 6; ++n)
            {
                REQUIRE(guard.measure(0.7) == fresh.measure(0.7));
                REQUIRE(guard.admit(1.0) == fresh.admit(1.0));
                guard.advance(0.9);
                fresh.advance(0.9);
            }
            // Nothing is left of what is far too small.
            guard.reset();
            CHECK(guard.measure(1e-120) >= 0.0);
            guard.advance(1e-120);
            guard.flush();
            guard.advance(0.0);
            guard.advance(0.0);
            CHECK(guard.measure(0.0) == 0.0);
        }
}

TEST_CASE("The guards of travel go ahead freely exactly as far as before", "[actuator][protection]")
{
    for (const auto& [name, params] : guardExamples())
    {
        const double fs = 4000.0;
        ExcursionGuard start;
        start.design(params, fs);
        std::vector<double> numbers;
        for (int block = 0; block < 4; ++block)
        {
            std::vector<double> wanted(16), played(16);
            for (std::size_t n = 0; n < 16; ++n)
            {
                wanted[n] = 1e-3 * std::sin(0.11 * static_cast<double>(n + 16 * static_cast<std::size_t>(block)));
                played[n] = 0.5 * wanted[n];
            }
            const auto goes = [&](double scale, double wantedPeak, double playedPeak, double most)
            {
                ExcursionGuard guard = start;
                std::vector<double> w = wanted, p = played;
                for (std::size_t n = 0; n < 16; ++n)
                {
                    w[n] *= scale;
                    p[n] *= scale;
                }
                return guard.advanceFreely(w, wantedPeak, p, playedPeak, most);
            };
            // The ends of each, by halving in orders of size.
            const auto end = [](auto&& passes)
            {
                double low = -30.0, high = 30.0;
                for (int i = 0; i < 60; ++i)
                    (passes(std::exp(0.5 * (low + high))) ? low : high) = 0.5 * (low + high);
                return low;
            };
            numbers.push_back(end([&](double x) { return goes(1.0, x, 1e-3, 1.0); }));
            numbers.push_back(end([&](double x) { return goes(1.0, 1e-3, x, 1.0); }));
            numbers.push_back(end([&](double x) { return goes(1.0, 1e-3, 1e-3, 1.0 / x); }));
            numbers.push_back(end([&](double x) { return goes(x, 1e-3, 1e-3, 1.0); }));
            REQUIRE(start.advanceFreely(wanted, 1e-3, played, 1e-3, 1.0));
            numbers.push_back(ExcursionGuard(start).measure(0.3));
        }
        checkPinned("actuator/guard, " + name + ", freely", numbers, 1e-5);
    }
}

TEST_CASE("What the protection plays and reports stays as it was", "[actuator][protection]")
{
    int index = 0;
    for (const auto& [name, excursion] : guardExamples())
        for (const bool heats : {false, true})
            for (const bool boundsAlone : {false, true})
            {
                ProtectionParams params;
                if (index % 3 != 2)
                    params.excursion = excursion;
                if (heats)
                    params.heat = CoilHeatParams{1.0, 0.1, Seconds(0.05)};
                params.lowFrequency = Hertz(index % 2 == 0 ? 20.0 : 90.0);
                params.lookAhead = Seconds(0.00025 * (index % 4));
                params.boundsAlone = boundsAlone;
                const double fs = 8000.0;
                Protection protection;
                protection.setParams(params);
                protection.prepare({fs, 512});
                CHECK(protection.latencyFrames() == static_cast<std::size_t>(2 * (index % 4)));
                std::vector<float> y = swellingDrive(3001, 1.4, 0.055);
                std::vector<double> meters;
                for (std::size_t i = 0; i < y.size(); i += 137)
                {
                    const auto part = std::span(y).subspan(i, std::min<std::size_t>(137, y.size() - i));
                    protection.process(part, part);
                    const ProtectionMeter& meter = protection.meter();
                    CHECK(protection.gainReduction() == meter.gainReduction);
                    meters.insert(meters.end(), {meter.gainReduction, meter.level ? 1.0 : 0.0,
                                                 meter.excursion ? 1.0 : 0.0, meter.heat ? 1.0 : 0.0});
                }
                const std::string which = "actuator/protection " + std::to_string(index++);
                checkPinned(which, asNumbers(y), 1e-4);
                checkPinned(which + ", meters", meters, 1e-4);
                std::vector<float> again = swellingDrive(3001, 1.4, 0.055);
                protection.reset();
                CHECK(protection.meter() == ProtectionMeter{});
                protection.process(again, again);
                CHECK(again == y);
            }
    CHECK(ProtectionMeter{} == ProtectionMeter{0.0, false, false, false, 0});
    CHECK(Protection::maxLookAhead == 0.001);
    CHECK(Protection::largestInput == 100.0);
}

TEST_CASE("Input beyond 100 counts as 100, and what is no number as 0", "[actuator][protection]")
{
    const auto played = [](float odd)
    {
        Protection protection;
        protection.prepare({8000.0, 512});
        std::vector<float> x(64, 0.1f);
        x[8] = odd;
        protection.process(x, x);
        return x;
    };
    CHECK(played(1e9f) == played(100.0f));
    CHECK(played(-1e9f) == played(-100.0f));
    CHECK(played(std::nanf("")) == played(0.0f));
    CHECK(played(HUGE_VALF) == played(0.0f));
    CHECK(played(99.0f) != played(100.0f));
}

TEST_CASE("What the limiter of levels plays and reports stays as it was", "[actuator]")
{
    CHECK(LevelLimiterParams{} == LevelLimiterParams{Hertz(20.0), Seconds(0.001)});
    int index = 0;
    for (const double low : {1.0, 20.0, 300.0})
        for (const double lookAhead : {0.0, 0.0004, 0.001, 1.0})
        {
            LevelLimiter limiter;
            limiter.prepare({8000.0, 512});
            limiter.setParams({Hertz(low), Seconds(lookAhead)});
            CHECK(limiter.latencyFrames() == static_cast<std::size_t>(std::min(lookAhead, 0.001) * 8000.0));
            std::vector<float> y = swellingDrive(2001, 2.0, 0.055);
            std::vector<double> meters;
            for (std::size_t i = 0; i < y.size(); i += 137)
            {
                const auto part = std::span(y).subspan(i, std::min<std::size_t>(137, y.size() - i));
                limiter.process(part, part);
                meters.insert(meters.end(), {limiter.meter().gainReduction, limiter.meter().level ? 1.0 : 0.0});
                CHECK(limiter.meter().level == (limiter.meter().gainReduction > 0.0));
            }
            checkPinned("actuator/level limiter " + std::to_string(index), asNumbers(y), 1e-6);
            checkPinned("actuator/level limiter meters " + std::to_string(index++), meters, 1e-6);
            limiter.reset();
            CHECK(limiter.meter() == ProtectionMeter{});
            std::vector<float> again = swellingDrive(2001, 2.0, 0.055);
            limiter.process(again, again);
            CHECK(again == y);
            // A changed look-ahead starts from silence, the same one goes on.
            std::vector<float> ones(20, 0.5f), rest(20, 0.0f);
            limiter.process(ones, ones);
            limiter.setParams({Hertz(low), Seconds(lookAhead)});
            std::vector<float> out(20);
            limiter.process(rest, out);
            CHECK((limiter.latencyFrames() == 0 || out[0] != 0.0f));
            limiter.process(std::vector<float>(20, 0.5f), out);
            limiter.setParams({Hertz(low), Seconds(lookAhead > 0.0 ? 0.0 : 0.0005)});
            limiter.process(rest, out);
            CHECK(out == rest);
        }
}

TEST_CASE("The knees of limiters are those of the formula", "[actuator]")
{
    for (double level = -3.0; level < 3.0; level += 0.05)
    {
        const double ratioSquared = std::pow(10.0, level / 10.0);
        const double over = std::max(0.0, level + 1.0);
        const double reduction = level >= 1.0 ? level : over * over / 4.0;
        CHECK(SoftKnee::gain(ratioSquared) == Approx(std::pow(10.0, -reduction / 20.0)).epsilon(1e-9));
        CHECK(HardKnee::gain(ratioSquared) == Approx(std::pow(10.0, -std::max(0.0, level) / 20.0)).epsilon(1e-12));
    }
    CHECK(SoftKnee::startSquared == Approx(std::pow(10.0, -0.1)).epsilon(1e-14));
    CHECK(SoftKnee::endSquared == Approx(std::pow(10.0, 0.1)).epsilon(1e-14));
    CHECK(SoftKnee::width == 2.0);
    CHECK(SoftKnee::gain(1e-6) == 1.0);
    CHECK(HardKnee::gain(1.0) == 1.0);
    CHECK(HardKnee::startSquared == 1.0);
    CHECK(longestLimiterHold == 0.05);
    for (const auto& [low, hold] :
         {std::pair(20.0, 0.025), std::pair(10.0, 0.05), std::pair(5.0, 0.05), std::pair(0.0, 0.05),
          std::pair(100.0, 0.005), std::pair(250.0, 0.002), std::pair(249.0, 0.5 / 249.0), std::pair(1e9, 0.002),
          std::pair(std::nan(""), 0.05)})
        CHECK(limiterHold(Hertz(low)) == Approx(hold).epsilon(1e-14));
}

TEST_CASE("Gains of limiters stay as they were", "[actuator]")
{
    int index = 0;
    for (const auto& [ahead, hold] : {std::pair(0, 0), std::pair(5, 3), std::pair(5, 40), std::pair(8, 200)})
    {
        LimiterGain gain;
        KneeLimiterGain<HardKnee> hard;
        CHECK(gain.tick(0.1) == 1.0);
        CHECK(gain.idle());
        gain.prepare(8, 100);
        hard.prepare(8, 100);
        gain.design(static_cast<std::size_t>(ahead), static_cast<std::size_t>(hold), 1000.0);
        hard.design(static_cast<std::size_t>(ahead), static_cast<std::size_t>(hold), 1000.0);
        std::vector<double> numbers;
        const auto run = [&](auto& computer)
        {
            for (int n = 0; n < 1500; ++n)
            {
                const double level = n % 400 == 20  ? 9.0
                                     : n % 400 < 60 ? 0.9 + 0.3 * std::sin(0.3 * n)
                                     : n < 700      ? 0.1
                                                    : 1.0;
                numbers.push_back(computer.tick(level));
                CHECK(numbers.back() <= 1.0 + 1e-12);
                numbers.push_back(computer.idle() ? 1.0 : 0.0);
            }
        };
        run(gain);
        run(hard);
        checkPinned("actuator/limiter gain " + std::to_string(index++), numbers);
        const std::vector<double> before = numbers;
        gain.reset();
        hard.reset();
        CHECK(gain.idle());
        numbers.clear();
        run(gain);
        run(hard);
        CHECK(numbers == before);
        gain.design(static_cast<std::size_t>(ahead), static_cast<std::size_t>(hold), 1000.0); // goes on
        CHECK_FALSE(gain.idle());
        gain.design(3, 10, 1000.0); // another look-ahead begins anew
        CHECK(gain.idle());
    }
}

TEST_CASE("What motors are driven with, and what they do, stays as it was", "[actuator]")
{
    CHECK(MotorDriveParams{} ==
          MotorDriveParams{FirstOrderTimes{0.0, 0.0}, 1.0, 0.25, 0.125, Seconds(0.020), true, std::nullopt});
    CHECK(speedTimes({0.06, 0.1}).rise == Approx(0.06 / -std::log(1.0 - std::sqrt(0.9))));
    CHECK(speedTimes({0.06, 0.1}).fall == Approx(0.1 / -std::log(std::sqrt(0.1))));
    std::vector<float> wanted(1600);
    for (std::size_t n = 0; n < wanted.size(); ++n)
    {
        const double t = static_cast<double>(n);
        wanted[n] = static_cast<float>(n < 300    ? 0.02
                                       : n < 500  ? 0.9
                                       : n < 600  ? 0.0
                                       : n < 900  ? 0.004
                                       : n < 1200 ? std::abs(std::sin(0.01 * t))
                                       : n < 1300 ? -1.0
                                                  : 2.0);
    }
    const CoilHeatParams heat{1.0, 0.2, Seconds(0.1)};
    int index = 0;
    for (const MotorDriveParams& params : {MotorDriveParams{}, MotorDriveParams{{0.03, 0.05}},
                                           MotorDriveParams{{0.03, 0.05}, 2.0, 0.4, 0.2, Seconds(0.05), true, heat},
                                           MotorDriveParams{{0.0, 0.05}, 2.0, 0.4, 0.2, Seconds(0.05), false, {}},
                                           MotorDriveParams{{0.05, 0.0}, 0.5, 0.3, 0.6, Seconds(9.0), true, {}},
                                           MotorDriveParams{{0.0, 0.0}, 20.0, 2.0, 2.0, Seconds(-1.0), false, heat},
                                           MotorDriveParams{{0.0, 0.0}, 1.0, -1.0, 0.2, Seconds(2.0), true, {}}})
    {
        MotorDrive motor;
        motor.setParams(params);
        motor.prepare({1000.0, 512});
        std::vector<float> y(wanted.size());
        motor.process(wanted, y);
        checkPinned("actuator/motor drive " + std::to_string(index), asNumbers(y), 1e-6);
        motor.reset();
        std::vector<float> again(wanted.size());
        motor.process(wanted, again);
        CHECK(again == y);
        SpinningMotor spinning;
        spinning.setParams({Hertz(30.0 + 40.0 * index), {0.02 * index, 0.1}});
        spinning.prepare({1000.0, 512});
        spinning.process(y, y);
        ++index;
        CHECK(std::all_of(y.begin(), y.end(), [](float v) { return std::abs(v) <= 100.0f; }));
    }
    CHECK(SpinningMotorParams{} == SpinningMotorParams{Hertz(180.0), ActuatorResponse{0.0, 0.0}});
    const auto force = [](double frequency, double rise, double fall, float drive)
    {
        SpinningMotor motor;
        motor.setParams({Hertz(frequency), {rise, fall}});
        motor.prepare({8000.0, 64});
        std::vector<float> x(64, drive);
        std::fill(x.begin() + 40, x.end(), 0.1f);
        motor.process(x, x);
        return x;
    };
    CHECK(force(0.01, 0.0, 0.0, 1.0f) == force(0.1, 0.0, 0.0, 1.0f));
    CHECK(force(0.12, 0.0, 0.0, 1.0f) != force(0.1, 0.0, 0.0, 1.0f));
    CHECK(force(1e6, 0.0, 0.0, 1.0f) == force(1e5, 0.0, 0.0, 1.0f));
    CHECK(force(9.1e4, 0.0, 0.0, 1.0f) != force(1e5, 0.0, 0.0, 1.0f));
    CHECK(force(200.0, 1e4, 0.1, 1.0f) == force(200.0, 100.0, 0.1, 1.0f));
    CHECK(force(200.0, 90.0, 0.1, 1.0f) != force(200.0, 100.0, 0.1, 1.0f));
    CHECK(force(200.0, -1.0, 1e4, 1.0f) == force(200.0, 0.0, 100.0, 1.0f));
    CHECK(force(200.0, 0.0, 0.0, 50.0f) == force(200.0, 0.0, 0.0, 10.0f));
    CHECK(force(200.0, 0.0, 0.0, 9.0f) != force(200.0, 0.0, 0.0, 10.0f));
}
