#include "study/procedures/Staircase.h"

#include "support/Catch.h"

#include <pacini/foundation/Random.h>

#include <cmath>
#include <string_view>
#include <vector>

using namespace pacini;
using namespace pacini::study;

namespace
{
struct Found
{
    double bias = 0.0, sd = 0.0; ///< dB
};

/// The strength at which the share of right answers is `p`.
double strengthAt(const Psychometric& function, double p)
{
    const double missed = (1.0 - function.lapse - p) / (1.0 - function.guess - function.lapse);
    return function.threshold + 20.0 / function.slope * std::log10(-std::log(missed));
}

/// Mean and spread of the thresholds of many simulated observers, against the strength at the share that is looked for.
Found observe(const Adaptive& adaptive, Psychometric truth, Interval thresholds, int runs)
{
    Random random(3);
    std::vector<double> errors;
    for (int run = 0; run < runs; ++run)
    {
        truth.threshold = random.uniform(thresholds.low, thresholds.high);
        Staircase staircase(adaptive, 2);
        while (!staircase.isDone())
            staircase.answer(random.uniform() < truth(staircase.strength()));
        const auto threshold = staircase.threshold();
        REQUIRE(threshold);
        const bool isLevitt = adaptive.procedure == Procedure::levitt;
        errors.push_back(threshold->strength - (isLevitt ? strengthAt(truth, threshold->share) : truth.threshold));
    }
    return {meanOf(errors), sdOf(errors)};
}
} // namespace

TEST_CASE("QUEST+ places its trials as Watson's reference does")
{
    // questplus 2023.1 (PyPI), with the same grids, minimal entropy and the mean of the parameters.
    Adaptive adaptive;
    adaptive.lowest = -40.0;
    adaptive.highest = 0.0;
    adaptive.trials = 30;
    QuestPlus quest(adaptive, 2);
    const std::string_view answers = "111011011101110011110110111101";
    const std::vector<double> wanted{-18, -22, -25, -28, -19, -21, -22, -15, -17, -18, -19, -14, -15, -16, -17,
                                     -13, -8,  -9,  -10, -11, -12, -8,  -9,  -9,  -6,  -7,  -7,  -8,  -9,  -6};
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
        INFO("trial " << i);
        CHECK(quest.strength() == Approx(wanted[i]).margin(1e-9));
        quest.answer(answers[i] == '1');
    }
    const Psychometric mean = quest.posterior().mean();
    CHECK(mean.threshold == Approx(-8.333941523891896).epsilon(1e-9));
    CHECK(mean.slope == Approx(4.040660009374897).epsilon(1e-9));
    CHECK(mean.lapse == Approx(0.020264728446376216).epsilon(1e-9));
}

TEST_CASE("QUEST+ finds thresholds within .3 dB, spread by 1.5 dB at most, in 40 trials")
{
    const Found found = observe({}, {0.0, 3.5, 0.5, 0.02}, {-45.0, -18.0}, 800);
    INFO("bias " << found.bias << ", SD " << found.sd);
    CHECK(std::abs(found.bias) < 0.3);
    CHECK(found.sd < 1.5);
}

TEST_CASE("Levitt's staircase comes within .5 dB of its theoretical point")
{
    Adaptive adaptive;
    adaptive.procedure = Procedure::levitt;
    adaptive.reversals = 20;
    adaptive.trials = 400;
    for (const int down : {2, 3})
    {
        adaptive.down = down;
        const Found found = observe(adaptive, {0.0, 3.5, 0.5, 0.0}, {-40.0, -20.0}, 2000);
        INFO(down << " down: bias " << found.bias << ", SD " << found.sd);
        CHECK(std::abs(found.bias) < 0.5);
    }
}

TEST_CASE("The strength of a variable and its value belong together")
{
    for (const Variable variable : {Variable::level, Variable::levelDifference, Variable::frequency, Variable::delay,
                                    Variable::bands, Variable::breakpoints, Variable::bits})
        for (const double value : {0.5, 1.0, 7.0, 30.0})
            CHECK(valueOf(variable, strengthOf(variable, value)) == Approx(value).epsilon(1e-12));
    CHECK(strengthOf(Variable::frequency, 10.0) > strengthOf(Variable::frequency, 5.0));
    CHECK(strengthOf(Variable::bands, 10.0) < strengthOf(Variable::bands, 5.0));
}

TEST_CASE("A psychometric function starts at guessing, ends at lapses and turns round")
{
    const Psychometric function{-20.0, 3.5, 0.5, 0.02};
    CHECK(function(-200.0) == Approx(0.5));
    CHECK(function(100.0) == Approx(0.98));
    for (const double share : {0.6, 0.75, 0.9})
        CHECK(function(strengthAt(function, share)) == Approx(share));
}

TEST_CASE("Answers that nothing explains leave a posterior that is one")
{
    PsychometricPrior prior;
    prior.thresholds = {-40.0, -30.0, 11};
    prior.lapses = {0.0, 0.0, 1};
    PsychometricPosterior posterior(prior);
    for (int i = 0; i < 50; ++i)
        posterior.update(200.0, false);
    CHECK(std::isfinite(posterior.mean().threshold));
    CHECK(std::isfinite(posterior.thresholdSd()));
    CHECK(posterior.threshold95().low <= posterior.threshold95().high);
}
