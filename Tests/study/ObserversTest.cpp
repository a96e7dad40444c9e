#include "study/Observers.h"

#include "study/StudyTemplates.h"
#include "support/Catch.h"

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
