#include "actuator/SimulatedActuator.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/actuator/DriveShaping.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{

/// Strength 1 from 0.1 s to 0.4 s.
std::vector<float> burst(double fs)
{
    std::vector<float> x(static_cast<std::size_t>(0.8 * fs), 0.0f);
    std::fill(x.begin() + static_cast<std::ptrdiff_t>(0.1 * fs), x.begin() + static_cast<std::ptrdiff_t>(0.4 * fs),
              1.0f);
    return x;
}

std::vector<float> shaped(const DriveShapingParams& params, const std::vector<float>& wanted, double fs)
{
    DriveShaping shaping;
    shaping.setParams(params);
    shaping.prepare({fs, 512});
    return test::runInBlocks(shaping, wanted, 512);
}

/// m' = (u - m) / tau in small steps, tau depending on the direction.
std::vector<double> simulatedLag(const std::vector<float>& drive, double rise, double fall, double fs)
{
    std::vector<double> strength;
    double m = 0.0;
    for (const float u : drive)
    {
        for (int i = 0; i < 200; ++i)
        {
            const double distance = static_cast<double>(u) - m;
            m += distance / (fs * 200.0 * (distance > 0.0 ? rise : fall));
        }
        strength.push_back(m);
    }
    return strength;
}

/// A resonator driven by a sinusoid at its resonance with the amplitude `drive`; its amplitude over that of a steady
/// drive of 1, for every sample.
std::vector<double> simulatedLra(const std::vector<float>& drive, double frequency, double q, double fs)
{
    test::SimulatedResonator mass(frequency, q, 1.0 / q, fs);
    std::vector<double> strength;
    for (std::size_t n = 0; n < drive.size(); ++n)
    {
        const double phase = 2.0 * std::numbers::pi * frequency * static_cast<double>(n) / fs;
        mass.hold(static_cast<double>(drive[n]) * std::sin(phase));
        strength.push_back(mass.amplitude());
    }
    return strength;
}

struct Times
{
    double rise; ///< s from 0.1 s to a strength of 0.9
    double fall; ///< s from 0.4 s to a strength of 0.1, for good
};

Times timesOf(const std::vector<double>& strength, double fs)
{
    const auto at = [&](double t)
    {
        return strength.begin() + static_cast<std::ptrdiff_t>(t * fs);
    };
    const auto up = std::find_if(at(0.1), at(0.4), [](double s) { return s >= 0.9; });
    auto down = strength.end() - 1;
    while (down > at(0.4) && *down < 0.1)
        --down;
    return {static_cast<double>(up - at(0.1)) / fs, static_cast<double>(down - at(0.4)) / fs};
}

} // namespace

TEST_CASE("Drive shaping keeps the block contract", "[actuator]")
{
    test::ContractOptions options;
    options.bound = 2.0;
    options.delay = test::MeasuredDelay::firstFrame;
    test::checkBlockContract<DriveShaping>({{0.02, 0.03}, 2.0, true}, options);
    test::checkBlockContract<DriveShaping>({}, options);
    test::checkModulation<DriveShaping>({{{0.02, 0.03}, 2.0, true}, {{0.0, 1.0}, 1.0, false}, {}}, 2.0);
    test::checkSilenceIsCheap<DriveShaping>({{0.02, 0.03}, 2.0, false});
}

TEST_CASE("Without response times the drive is the wanted strength", "[actuator]")
{
    Profile profile;
    CHECK_FALSE(driveShapingNeeded(profile));
    auto x = test::noise(2000, 3);
    for (float& v : x)
        v = std::abs(v);
    CHECK(shaped(driveShapingParams(profile), x, 8000.0) == x);
    profile.response = {0.05, 0.07};
    CHECK(driveShapingNeeded(profile));
    CHECK(shaped(driveShapingParams(profile), x, 8000.0) != x);
}

TEST_CASE("With an overdrive of 2 a slow actuator follows at least twice as fast and does not pass the mark",
          "[actuator]")
{
    for (const double fs : {8000.0, 48000.0})
        for (const auto& response :
             {ActuatorResponse{0.05, 0.05}, ActuatorResponse{0.03, 0.08}, ActuatorResponse{0.12, 0.06}})
        {
            CAPTURE(fs, response.riseTime, response.fallTime);
            const auto tau = strengthTimes(response);
            const auto plain = timesOf(simulatedLag(burst(fs), tau.rise, tau.fall, fs), fs);
            CHECK(plain.rise == Approx(response.riseTime).epsilon(0.01));
            CHECK(plain.fall == Approx(response.fallTime).epsilon(0.01));

            const auto drive = shaped({tau, 2.0, true}, burst(fs), fs);
            CHECK(*std::max_element(drive.begin(), drive.end()) <= 2.0f);
            CHECK(*std::min_element(drive.begin(), drive.end()) >= -2.0f);
            const auto strength = simulatedLag(drive, tau.rise, tau.fall, fs);
            const auto quick = timesOf(strength, fs);
            CHECK(quick.rise < 0.5 * plain.rise);
            CHECK(quick.fall < 0.5 * plain.fall);
            CHECK(*std::max_element(strength.begin(), strength.end()) < 1.01);
            CHECK(*std::min_element(strength.begin(), strength.end()) > -0.01);
        }
}

TEST_CASE("A strength that moves slowly enough is followed exactly", "[actuator]")
{
    const double fs = 8000.0;
    const auto tau = strengthTimes({0.05, 0.05});
    std::vector<float> wanted(8000);
    for (std::size_t n = 0; n < wanted.size(); ++n)
        wanted[n] =
            static_cast<float>(0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * 5.0 * static_cast<double>(n) / fs));
    const auto strength = simulatedLag(shaped({tau, 2.0, true}, wanted, fs), tau.rise, tau.fall, fs);
    const auto lagging = simulatedLag(wanted, tau.rise, tau.fall, fs);
    double largest = 0.0;
    double without = 0.0;
    for (std::size_t n = 0; n < wanted.size(); ++n)
    {
        largest = std::max(largest, std::abs(strength[n] - static_cast<double>(wanted[n])));
        without = std::max(without, std::abs(lagging[n] - static_cast<double>(wanted[n])));
    }
    CHECK(largest < 1e-4); // the simulation's steps
    CHECK(without > 0.2);
}

TEST_CASE("A shaped burst of an LRA rises and falls sooner", "[actuator]")
{
    for (const double q : {8.0, 15.0, 30.0})
    {
        CAPTURE(q);
        const double fs = 48000.0;
        const double f0 = 175.0;
        const double tau = q / (std::numbers::pi * f0);
        Profile profile;
        profile.response = {tau * std::numbers::ln10, tau * std::numbers::ln10};
        profile.drive.overdrive = 2.0;
        const auto plain = timesOf(simulatedLra(burst(fs), f0, q, fs), fs);
        const auto strength = simulatedLra(shaped(driveShapingParams(profile), burst(fs), fs), f0, q, fs);
        const auto quick = timesOf(strength, fs);
        CHECK(plain.rise == Approx(profile.response.riseTime).epsilon(0.1));
        CHECK(quick.rise < 0.5 * plain.rise);
        CHECK(quick.fall < 0.5 * plain.fall);
        CHECK(*std::max_element(strength.begin(), strength.end()) < 1.02);

        // and without overdrive braking alone still helps
        profile.drive.overdrive = 1.0;
        const auto braked = timesOf(simulatedLra(shaped(driveShapingParams(profile), burst(fs), fs), f0, q, fs), fs);
        CHECK(braked.rise == Approx(plain.rise).epsilon(0.02));
        CHECK(braked.fall < 0.5 * plain.fall);
    }
}
