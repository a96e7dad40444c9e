#include "study/Observers.h"

#include "study/StudyTemplates.h"
#include "support/Catch.h"

#include <array>
#include <cmath>

using namespace pacini::study;

TEST_CASE("The power of simulated studies is that of the non-central t distribution, within 2 %")
{
    auto study = makeStudy("coherence", {"a.wav", "b.wav", "c.wav", "d.wav"});
    REQUIRE(study);
    // Small on the scale, so that its ends do not matter.
    ObserverParams params;
    params.stimulusSd = 0.05;
    params.biasSd = 0.08;
    params.noiseSd = 0.17;
    for (const double effect : {0.0, 0.06, 0.1, 0.15})
    {
        params.effect = effect;
        for (const PowerEstimate& found : estimatePower(*study, params, 10000))
        {
            INFO(effect << ": " << found.byParticipant << ", analytic " << found.analytic);
            CHECK(std::abs(found.byParticipant - found.analytic) < 0.02);
        }
    }
    CHECK(estimatePower(*study, params, 10).size() == 2);
    study->groups.resize(1);
    CHECK(estimatePower(*study, params, 10).empty());
}

TEST_CASE("The power of a design follows from its people and trials")
{
    auto study = makeStudy("coherence", {"a.wav", "b.wav", "c.wav", "d.wav"});
    REQUIRE(study);
    const ObserverParams params;
    const auto designs = powerOfDesign(*study, params);
    // A and B against C, and two stimuli in each of the two blocks of ratings.
    REQUIRE(designs.size() == 4);
    CHECK((designs[0].first == "A" && designs[0].second == "C" && designs[0].trials == 4));
    CHECK((designs[2].block == "coherence, one after the other" && designs[2].firstPeople == 22));
    // statsmodels 0.15: TTestIndPower().power(d, 11, .05), TTestPower().power(d, 22, .05).
    const std::array<double, 6> independent{0.07318, 0.145296, 0.268119, 0.431038, 0.607098, 0.763341};
    const std::array<double, 6> paired{0.145754, 0.432722, 0.765375, 0.946939, 0.99391, 0.999659};
    for (std::size_t i = 0; i < independent.size(); ++i)
    {
        CHECK(designs[0].effects[i].effect == tabulatedEffects[i]);
        CHECK(std::abs(designs[0].effects[i].power - independent[i]) < 2e-6);
        CHECK(std::abs(designs[2].effects[i].power - paired[i]) < 2e-6);
    }
    // Points: 1.7 of a rating and .8 between people; a leaning is in both stimuli alike.
    CHECK(std::abs(designs[0].effects.back().points - 1.2 * std::sqrt(0.8 * 0.8 + 1.7 * 1.7 / 4.0)) < 1e-12);
    CHECK(std::abs(designs[2].effects.back().points - 1.2 * 1.7 * std::sqrt(2.0)) < 1e-12);
    // An effect in points has the power that study simulate tells.
    for (const double points : {0.5, 1.0})
    {
        ObserverParams asked = params;
        asked.effect = points;
        const auto told = estimatePower(*study, asked, 10);
        const auto found = powerOfDesign(*study, params, points);
        for (std::size_t i = 0; i < told.size(); ++i)
        {
            REQUIRE(found[i].effects.size() == 1);
            CHECK(std::abs(found[i].effects[0].power - told[i].analytic) < 1e-12);
            CHECK(std::abs(found[i].effects[0].points - points) < 1e-12);
        }
    }
    // More trials: the same power of d, less of the same points.
    for (Block& block : study->blocks)
        block.repeats = 9;
    const auto more = powerOfDesign(*study, params);
    CHECK(more[0].effects[2].power == designs[0].effects[2].power);
    CHECK(more[0].effects[2].points < designs[0].effects[2].points);
    CHECK(more[2].effects[2].points * 3.0 == Approx(designs[2].effects[2].points));
    study = makeStudy("threshold", {});
    CHECK(powerOfDesign(*study, params).empty());
}

TEST_CASE("A simulated person is the same each time")
{
    const auto study = makeStudy("coherence", {"a.wav", "b.wav"});
    REQUIRE(study);
    for (std::size_t slot : {0u, 5u})
    {
        const auto trials = trialsOf(*study, 4, slot);
        Observer first(*study, {}, slot), second(*study, {}, slot);
        for (const Trial& trial : trials)
            CHECK(first.answer(trial, {}).value == second.answer(trial, {}).value);
    }
}
