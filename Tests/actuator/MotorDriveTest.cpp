#include "actuator/SimulatedActuator.h"
#include "support/BlockContract.h"
#include "support/Catch.h"

#include <pacini/actuator/MotorDrive.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

using namespace pacini;

namespace
{

/// A motor: its speed follows the voltage; at rest it needs startVoltage, turning it stops below the stall voltage.
/// Returns its strength, the square of its speed, for every sample.
std::vector<double> simulatedMotor(const std::vector<float>& voltage, double rise, double fall, double start,
                                   double stall, double motorRate)
{
    std::vector<double> strength;
    double speed = 0.0;
    for (const float u : voltage)
    {
        const auto v = static_cast<double>(u);
        for (int i = 0; i < 50; ++i)
        {
            if (speed == 0.0 && std::abs(v) < start)
                continue;
            speed += (v - speed) / (motorRate * 50.0 * (v > speed ? rise : fall));
            if (std::abs(speed) < 0.5 * stall && std::abs(v) < stall)
                speed = 0.0;
        }
        strength.push_back(speed * speed);
    }
    return strength;
}

std::vector<float> constant(double strength, double seconds, double motorRate)
{
    return std::vector<float>(static_cast<std::size_t>(seconds * motorRate), static_cast<float>(strength));
}

std::vector<float> driven(const MotorDriveParams& params, const std::vector<float>& strength, double motorRate)
{
    MotorDrive motor;
    motor.setParams(params);
    motor.prepare({motorRate, 512});
    return test::runInBlocks(motor, strength, 512);
}

constexpr double motorRate = 8000.0;

} // namespace

TEST_CASE("A motor is not driven hotter than its coil bears, and brakes from the speed that it has", "[actuator]")
{
    Profile profile;
    profile.technology = Technology::erm;
    profile.response = {0.08, 0.08};
    profile.drive.overdrive = 2.0;
    profile.drive.impedance = 45.0;
    profile.drive.maxVoltageRms = 3.0;
    profile.drive.maxPower = 0.2; // the rated voltage may stay on, twice of it would be 0.8 W
    profile.drive.thermalTime = 0.5;
    const MotorDriveParams params = motorDriveParams(profile);
    const auto rated = driven(params, constant(1.0, 5.0, motorRate), motorRate);
    CHECK(rated.back() == 1.0f);

    auto wanted = constant(9.0, 5.0, motorRate); // more strength than there is
    wanted.insert(wanted.end(), 8000, 0.0f);
    const auto voltage = driven(params, wanted, motorRate);
    CHECK(*std::max_element(voltage.begin(), voltage.end()) == 2.0f);
    CHECK(test::hottest(voltage, 0.2, 0.5, motorRate) <= 0.2 * (1.0 + 1e-6));
    CHECK(voltage[39000] == Approx(1.0).epsilon(1e-3));
    // It stops at once and is not turned backwards.
    const FirstOrderTimes times = speedTimes(profile.response);
    double speed = 0.0, slowest = 0.0;
    for (const float u : voltage)
    {
        const auto v = static_cast<double>(u);
        speed += (v - speed) / (motorRate * (v > speed ? times.rise : times.fall));
        slowest = std::min(slowest, speed);
    }
    CHECK(slowest > -0.01);
    CHECK(std::abs(speed) < 0.01);

    MotorDriveParams free = params;
    free.heat.reset();
    CHECK(test::hottest(driven(free, wanted, motorRate), 0.2, 0.5, motorRate) > 0.7);
    test::ContractOptions options;
    options.bound = 2.0;
    test::checkBlockContract<MotorDrive>(params, options);
}

TEST_CASE("A motor's coil warms alike however its drive is cut into blocks", "[actuator]")
{
    MotorDriveParams params;
    params.speedTimes = {0.03, 0.03};
    params.overdrive = 2.0;
    params.heat = CoilHeatParams{1.0, 0.5, Seconds(0.2)};
    std::vector<float> wanted; // overdriven, coasting, overdriven: the coil comes to its limit, cools and comes again
    for (std::size_t n = 0; n < 24000; ++n)
        wanted.push_back(n / 8000 == 1 ? 0.0f : 3.0f + 0.001f * static_cast<float>(n % 97));
    std::vector<float> whole(wanted.size());
    MotorDrive drive;
    drive.prepare({motorRate, 24000});
    drive.setParams(params);
    drive.process(wanted, whole);
    const auto limited = std::count_if(whole.begin(), whole.end(), [](float v) { return v > 0.5f && v < 1.9f; });
    CHECK(limited > 2000);
    CHECK(std::count(whole.begin(), whole.end(), 2.0f) > 500);
    for (const std::size_t block : {1u, 7u, 8u, 100u, 256u, 1000u})
    {
        CAPTURE(block);
        drive.reset();
        std::vector<float> parts(wanted.size());
        for (std::size_t n = 0; n < wanted.size(); n += block)
        {
            const std::size_t count = std::min(block, wanted.size() - n);
            drive.process(std::span(wanted).subspan(n, count), std::span(parts).subspan(n, count));
        }
        CHECK(parts == whole);
    }
}

TEST_CASE("Motor drive keeps the block contract", "[actuator]")
{
    Profile profile;
    profile.response = {0.08, 0.1};
    profile.drive.overdrive = 1.5;
    test::ContractOptions options;
    options.bound = 1.5;
    options.delay = test::MeasuredDelay::firstFrame;
    test::checkBlockContract<MotorDrive>(motorDriveParams(profile), options);
    test::checkBlockContract<MotorDrive>({}, options);
    test::checkModulation<MotorDrive>(
        {motorDriveParams(profile), {}, {{0.0, 0.1}, 1.0, 2.0, 3.0, Seconds(-1.0), false}}, 1.5);
    test::checkSilenceIsCheap<MotorDrive>(motorDriveParams(profile));
}

TEST_CASE("A motor reaches every strength that it can hold", "[actuator]")
{
    Profile profile;
    profile.response = {0.08, 0.1};
    const auto params = motorDriveParams(profile);
    for (const double strength : {1.0, 0.5, 0.2, 0.05, 0.02})
    {
        CAPTURE(strength);
        const auto voltage = driven(params, constant(strength, 1.0, motorRate), motorRate);
        CHECK(static_cast<double>(voltage.back()) == Approx(std::sqrt(strength)));
        const auto reached =
            simulatedMotor(voltage, params.speedTimes.rise, params.speedTimes.fall, 0.25, 0.125, motorRate);
        CHECK(reached.back() == Approx(strength).epsilon(0.01));
        CHECK(*std::max_element(reached.begin(), reached.end()) < 1.05 * strength);
    }
}

TEST_CASE("Weak strengths start the motor only with a kick", "[actuator]")
{
    Profile profile;
    profile.response = {0.08, 0.1};
    const auto params = motorDriveParams(profile);
    const double weak = 0.03; // a voltage of 0.17
    const auto kicked = driven(params, constant(weak, 0.5, motorRate), motorRate);
    const auto& tau = params.speedTimes;
    CHECK(simulatedMotor(kicked, tau.rise, tau.fall, 0.25, 0.125, motorRate).back() == Approx(weak).epsilon(0.01));
    // a drive of the bare square root does nothing
    const auto bare = constant(std::sqrt(weak), 0.5, motorRate);
    CHECK(simulatedMotor(bare, tau.rise, tau.fall, 0.25, 0.125, motorRate).back() == 0.0);

    // not knowing the spin-up time the kick lasts 20 ms
    const auto unknown = driven({}, constant(weak, 0.5, motorRate), motorRate);
    const auto long25 = static_cast<double>(std::count(unknown.begin(), unknown.end(), 0.25f)) / motorRate;
    CHECK(long25 == Approx(0.020).margin(0.001));
    CHECK(static_cast<double>(unknown.back()) == Approx(std::sqrt(weak)));
}

TEST_CASE("Strengths below what a motor can hold are raised to it or dropped", "[actuator]")
{
    const MotorDriveParams params{{0.03, 0.05}};
    const double weakest = params.stallVoltage * params.stallVoltage;
    CHECK(static_cast<double>(driven(params, constant(0.5 * weakest, 0.5, motorRate), motorRate).back()) ==
          Approx(params.stallVoltage));
    for (const float v : driven(params, constant(0.2 * weakest, 0.5, motorRate), motorRate))
        REQUIRE(v == 0.0f);
}

TEST_CASE("Overdrive and braking make a motor at least twice as quick", "[actuator]")
{
    Profile profile;
    profile.response = {0.08, 0.1};
    profile.drive.overdrive = 2.0;
    const auto params = motorDriveParams(profile);
    auto wanted = constant(1.0, 0.4, motorRate);
    wanted.resize(wanted.size() * 2, 0.0f);
    const auto run = [&](const std::vector<float>& voltage)
    {
        return simulatedMotor(voltage, params.speedTimes.rise, params.speedTimes.fall, 0.25, 0.125, motorRate);
    };
    const auto rise = [](const std::vector<double>& s)
    {
        return static_cast<double>(std::find_if(s.begin(), s.end(), [](double v) { return v >= 0.9; }) - s.begin()) /
               motorRate;
    };
    const auto fall = [&](const std::vector<double>& s)
    {
        auto last = s.end() - 1;
        while (*last < 0.1)
            --last;
        return static_cast<double>(last - s.begin()) / motorRate - 0.4;
    };
    const auto plain = run(wanted); // the square root of 0 and 1
    CHECK(rise(plain) == Approx(0.08).epsilon(0.01));
    CHECK(fall(plain) == Approx(0.1).epsilon(0.01));
    const auto quick = run(driven(params, wanted, motorRate));
    CHECK(rise(quick) < 0.5 * rise(plain));
    CHECK(fall(quick) < 0.5 * fall(plain));
    CHECK(*std::max_element(quick.begin(), quick.end()) < 1.02);
    CHECK(quick.back() < 1e-3);

    auto unbraked = params;
    unbraked.braking = false;
    for (const float v : driven(unbraked, wanted, motorRate))
        REQUIRE(v >= 0.0f);
}

TEST_CASE("The inverse of a first-order lag starts at rest and is where it shall be with the next sample", "[actuator]")
{
    FirstOrderInverse inverse;
    CHECK(inverse.value() == 0.0);
    CHECK(inverse.tick(0.3, -1.0, 1.0) == 0.3); // without times there is nothing to undo
    inverse.reset();
    CHECK(inverse.value() == 0.0);
    inverse.design({0.010, 0.005}, 1000.0);
    // Ten frames of a lag of 10 ms make 1 - 1/e of a step that is held; here one frame shall make it all.
    double speed = 0.0;
    for (const double wanted : {0.05, 0.05, 0.08, 0.02, 0.0})
    {
        const double time = wanted > speed ? 0.010 : 0.005;
        const double drive = inverse.tick(wanted, -1.0, 1.0);
        speed = drive + (speed - drive) * std::exp(-0.001 / time);
        CHECK(speed == Approx(wanted).margin(1e-12));
        CHECK(inverse.value() == wanted);
    }
    for (int n = 0; n < 10; ++n)
        CHECK(inverse.tick(0.9, -0.5, 0.5) == 0.5);
    CHECK(inverse.value() == Approx(0.5 * (1.0 - std::exp(-1.0))));
}

TEST_CASE("Lags of a fraction of a frame and of minutes are undone", "[actuator]")
{
    for (const double time : {1e-4, 4e-4, 2.0, 900.0})
    {
        CAPTURE(time);
        FirstOrderInverse inverse;
        inverse.design({time, time}, 1000.0);
        double state = 0.0;
        for (const double wanted : {1.0, 0.25})
        {
            const double drive = inverse.tick(wanted, -1e9, 1e9);
            state = drive + (state - drive) * std::exp(-0.001 / time);
            CHECK(state == Approx(wanted).epsilon(1e-6));
        }
    }
    // A thousand seconds is the slowest there is.
    FirstOrderInverse slow, slowest;
    slow.design({5e3, 5e3}, 1000.0);
    slowest.design({1e3, 1e3}, 1000.0);
    CHECK(slow.tick(0.5, -1e9, 1e9) == slowest.tick(0.5, -1e9, 1e9));
    CHECK(FirstOrderInverse().tick(-0.5, -1.0, 1.0) == -0.5);
    // And no time is none.
    FirstOrderInverse quick;
    quick.design({0.0, 0.0}, 1000.0);
    CHECK(quick.tick(0.5, -1.0, 1.0) == 0.5);
    CHECK(quick.value() == 0.5);
    CHECK(quick.tick(0.1, -1.0, 1.0) == 0.1);
    CHECK(quick.value() == Approx(0.1));
}
