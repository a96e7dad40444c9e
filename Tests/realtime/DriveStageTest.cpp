#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/realtime/DriveStage.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace pacini;

namespace
{
constexpr double stageRate = 6000.0;

/// A hop of the stage, every sample of it `value`.
std::vector<float> hop(DriveStage& stage, double value, double gate = 1.0)
{
    std::vector<float> out(controlHop, static_cast<float>(value));
    std::array<double, controlHop> gates;
    gates.fill(gate);
    (void)stage.process(out, gates, 0);
    return out;
}

TranslatorDesign motorDesign(double riseTime)
{
    TranslatorSetup setup;
    Profile& motor = setup.profile.emplace();
    motor.technology = Technology::erm;
    motor.polyphony = 0;
    motor.range = {133.0, 200.0, 60.0};
    motor.response = {riseTime, riseTime};
    return designTranslator(setup, stageRate);
}
} // namespace

TEST_CASE("an event drives a motor for its rise time, 12 ms at least, and then no longer", "[realtime]")
{
    for (const double rise : {0.002, 0.012, 0.05, 0.1})
    {
        CAPTURE(rise);
        const TranslatorDesign design = motorDesign(rise);
        DriveStage stage;
        stage.adopt(design);
        stage.jump(1.0);
        CHECK_FALSE(stage.bursting());
        stage.beginBurst(0.6);
        CHECK(stage.bursting());
        double driven = 0.0, lastWanted = 0.0;
        for (std::size_t n = 0; n < 400; ++n)
        {
            stage.aim(1.0, 1.0, 0.0, 0.0);
            const auto out = hop(stage, 0.0);
            if (stage.bursting())
                CHECK(out.back() > 0.0f);
            driven += stage.bursting() ? static_cast<double>(controlHop) / stageRate : 0.0;
            lastWanted = static_cast<double>(out.back());
        }
        CHECK_FALSE(stage.bursting());
        CHECK(lastWanted == 0.0);
        const double wanted = std::max(rise, 0.012);
        CHECK(driven <= wanted + 1e-9);
        CHECK(driven > wanted - 1.01 * static_cast<double>(controlHop) / stageRate);
        // Forgotten by a reset.
        stage.beginBurst(0.6);
        stage.reset();
        CHECK_FALSE(stage.bursting());
    }
}

TEST_CASE("without limits to keep, the drive stage limits at full scale and says how much", "[realtime]")
{
    const TranslatorDesign design = designTranslator({}, stageRate);
    DriveStage stage;
    stage.adopt(design);
    stage.jump(1.0);
    stage.aim(1.0, 1.0, 0.0, 0.0);
    (void)hop(stage, 0.9, 0.5);
    CHECK(stage.takeLimiterGain() == 1.0);
    for (std::size_t n = 0; n < 20; ++n)
    {
        stage.aim(1.0, 1.0, 0.0, 0.0);
        for (const float y : hop(stage, 4.0))
            CHECK(y <= 1.0f);
    }
    CHECK(stage.takeLimiterGain() == Approx(0.25).margin(0.01));
    std::vector<float> out(controlHop, -4.0f);
    stage.aim(1.0, 1.0, 0.0, 0.0);
    CHECK(stage.process(out, std::vector<double>(controlHop, 0.5), 0) == 2.0);
    stage.reset();
    stage.aim(1.0, 1.0, 0.0, 0.0);
    CHECK(static_cast<double>(hop(stage, 0.85).front()) == Approx(0.85));
}

TEST_CASE("the drive stage raises what is weak by the map of levels, but not what is below 180 dB", "[realtime]")
{
    TranslatorSetup setup;
    setup.maxBoost = Decibels(0.0);
    Profile& profile = setup.profile.emplace();
    profile.technology = Technology::vca;
    profile.range = {40.0, 400.0, 20.0};
    profile.drive.overdrive = 1.25;
    const TranslatorDesign design = designTranslator(setup, stageRate);
    REQUIRE_FALSE(design.levels.isIdentity());
    REQUIRE(design.filter.sections.empty());
    for (const double peak : {0.0, 1e-10, 1e-9, 1.5e-9, 1e-3, 0.1, 1.0})
    {
        CAPTURE(peak);
        DriveStage stage;
        stage.adopt(design);
        stage.jump(0.5);
        stage.aim(0.5, 1.0, peak, 0.0);
        const double gain = peak > 1e-9 ? design.levels(peak) / peak : 1.0;
        const double value = 1e-3 / std::max(1.0, gain);
        const auto out = hop(stage, value, 0.8);
        for (std::size_t i = 0; i < controlHop; ++i)
        {
            const double way = static_cast<double>(i + 1) / static_cast<double>(controlHop);
            CHECK(static_cast<double>(out[i]) ==
                  Approx(0.5 * 0.8 / 1.25 * value * (1.0 + way * (gain - 1.0))).epsilon(1e-5).margin(1e-10));
        }
    }
}

TEST_CASE("a motor's drive stage follows the strength of a sound as before", "[realtime]")
{
    const TranslatorDesign design = motorDesign(0.03);
    DriveStage stage;
    stage.adopt(design);
    stage.jump(0.9);
    std::vector<double> drive;
    const auto run = [&]
    {
        for (std::size_t n = 0; n < 150; ++n)
        {
            const double energy = n < 60 ? 2.0 : n < 90 ? 0.02 : 0.0;
            if (n == 20 || n == 110)
                stage.beginBurst(n == 20 ? 0.3 : 0.5);
            stage.aim(n < 40 ? 0.9 : 0.6, 0.3, 0.0, energy);
            for (const float y : hop(stage, 0.1, n % 10 == 9 ? 0.5 : 1.0))
                drive.push_back(static_cast<double>(y));
        }
    };
    run();
    checkPinned("realtime/motor stage", drive, 2e-6);
    // Nothing of it is left after a reset.
    const auto first = drive;
    drive.clear();
    stage.reset();
    stage.jump(0.9);
    run();
    CHECK(drive == first);
}
