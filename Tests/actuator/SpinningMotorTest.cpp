#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/actuator/SpinningMotor.h>

using namespace pacini;
using namespace pacini::test;

namespace
{
const SpinningMotorParams motor{180_Hz, {0.06, 0.1}};

std::vector<float> run(const std::vector<float>& drive, double fs)
{
    SpinningMotor block;
    block.setParams(motor);
    block.prepare({fs, 512});
    return runInBlocks(block, drive, 512);
}

/// The largest magnitude within a turn's length after `seconds`.
double strengthAt(const std::vector<float>& force, double seconds, double fs, double turns = 1.0)
{
    const auto begin = static_cast<std::size_t>(seconds * fs);
    const auto end = begin + static_cast<std::size_t>(turns * fs / motor.frequency.value);
    double largest = 0.0;
    for (std::size_t i = begin; i < end; ++i)
        largest = std::max(largest, std::abs(static_cast<double>(force[i])));
    return largest;
}
} // namespace

TEST_CASE("A motor reaches 90 % of its strength in its rise time and 10 % in its fall time", "[actuator][body]")
{
    for (const double fs : {8000.0, 48000.0})
    {
        std::vector<float> drive(static_cast<std::size_t>(1.5 * fs), 0.0f);
        std::fill_n(drive.begin(), static_cast<std::size_t>(fs), 1.0f);
        const auto force = run(drive, fs);
        // Strength is seen only near the tops of the sinusoid: half a turn here or there.
        CHECK(strengthAt(force, 0.06 - 0.5 / 180.0, fs) == Approx(0.9).margin(0.02));
        CHECK(strengthAt(force, 0.9, fs) == Approx(1.0).epsilon(1e-2));
        CHECK(strengthAt(force, 1.0 + 0.1 - 0.01, fs, 3.0) == Approx(0.12).margin(0.03));
    }
}

TEST_CASE("A motor's frequency follows the drive and its force the square", "[actuator][body]")
{
    const double fs = 48000.0;
    for (const double drive : {1.0, 0.5, -0.5})
    {
        const auto force = run(std::vector<float>(96000, static_cast<float>(drive)), fs);
        const auto settled = std::vector<float>(force.begin() + 48000, force.end());
        const double amplitude = 2.0 * std::abs(spectrumAt<float>(settled, 180.0 * std::abs(drive), fs)) /
                                 static_cast<double>(settled.size());
        CHECK(amplitude == Approx(drive * drive).epsilon(1e-3));
    }
}

TEST_CASE("A motor hardly turns when the drive alternates, since the mean of the voltage counts", "[actuator][body]")
{
    const double fs = 48000.0;
    const auto force = run(sine(96000, 200.0, fs), fs);
    CHECK(strengthAt(force, 1.5, fs, 20.0) < 0.02);
    auto lifted = sine(96000, 200.0, fs, 0.5);
    for (float& v : lifted)
        v += 0.5f;
    CHECK(strengthAt(run(lifted, fs), 1.5, fs, 20.0) > 0.15);
}

TEST_CASE("A motor keeps the contract of blocks", "[actuator][body][contract]")
{
    checkBlockContract<SpinningMotor>(motor, {.bound = 200.0});
    checkBlockContract<SpinningMotor>({180_Hz, {0.0, 0.0}}, {.bound = 200.0});
    checkModulation<SpinningMotor>({motor, {Hertz(1e9), {0.0, 0.0}}, {0_Hz, {1.0, 1e9}}}, 200.0);
    checkSilenceIsCheap<SpinningMotor>(motor);
    checkSilenceIsCheap<SpinningMotor>(motor, 480000);
}
