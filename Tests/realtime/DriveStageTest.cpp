#include "support/Catch.h"

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

TEST_CASE("the drive fades in a straight line of four hops, and says when it has", "[realtime]")
{
    const TranslatorDesign design = designTranslator({}, stageRate);
    DriveStage stage;
    stage.adopt(design);
    stage.jump(0.5);
    stage.aim(0.5, 1.0, 0.0, 0.0);
    for (const float y : hop(stage, 0.8))
        CHECK(static_cast<double>(y) == Approx(0.4));
    for (const bool out : {true, false})
    {
        stage.setFade(out);
        for (std::size_t n = 0; n < 4; ++n)
        {
            stage.aim(0.5, 1.0, 0.0, 0.0);
            const auto y = hop(stage, 0.8);
            CHECK_FALSE(stage.faded());
            for (std::size_t i = 0; i < controlHop; ++i)
            {
                const double way = static_cast<double>(n * controlHop + i + 1) / static_cast<double>(4 * controlHop);
                CHECK(static_cast<double>(y[i]) == Approx(0.4 * (out ? 1.0 - way : way)).margin(1e-6));
            }
        }
        stage.aim(0.5, 1.0, 0.0, 0.0);
        CHECK(stage.faded() == out);
        CHECK(static_cast<double>(hop(stage, 0.8).back()) == Approx(out ? 0.0 : 0.4).margin(1e-9));
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
