#include "EqualizerReference.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/linearize/EqualizerRefinement.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
FrequencyResponse refinedResponse(std::size_t points = 80)
{
    FrequencyResponse response;
    response.frequency = logFrequencies(points, 30.0, 1000.0);
    for (const double f : response.frequency)
        response.level.push_back(massOnSpring(f, 70.0, 5.0) + 2.0 * std::sin(3.0 * std::log(f)));
    return response;
}

EqualizerFitProblem refinedProblem(double maxBoost = 12.0, bool boostOutside = false, double fs = 48000.0)
{
    EqualizerFitParams params;
    params.maxBoost = maxBoost;
    params.boostOutside = boostOutside;
    params.sampleRate = fs;
    for (std::size_t i = 0; i < 80; ++i)
        params.weights.push_back(i % 4 == 0 ? 0.5 : 1.5);
    return makeEqualizerFitProblem(refinedResponse(), params).value();
}

EqualizerCandidate candidateOf(std::initializer_list<EqualizerSection> sections, double level = 0.0)
{
    EqualizerCandidate candidate;
    for (const EqualizerSection& section : sections)
        candidate.sections.pushBack(section);
    candidate.level = level;
    return candidate;
}

std::vector<double> candidateValues(const EqualizerCandidate& candidate)
{
    std::vector<double> values{candidate.level, std::log(candidate.cost)};
    for (const EqualizerSection& section : candidate.sections)
    {
        values.push_back(static_cast<double>(section.type));
        values.push_back(std::log(section.frequency));
        values.push_back(section.gain);
        values.push_back(std::log(section.q));
    }
    return values;
}

const EqualizerSection wideCut{EqualizerType::peak, 90.0, -6.0, 1.0};
const EqualizerSection narrowBoost{EqualizerType::peak, 40.0, 4.0, 3.0};
const EqualizerSection lowShelfCut{EqualizerType::lowShelf, 60.0, -5.0, 0.7};
const EqualizerSection highShelfCut{EqualizerType::highShelf, 300.0, -4.0, 0.9};
} // namespace

TEST_CASE("Sections are evaluated at all points of their problem, guards included", "[linearize]")
{
    const auto problem = refinedProblem();
    EqualizerRefinement refinement(problem);
    EqualizerSections sections;
    for (const auto& section : {wideCut, narrowBoost, lowShelfCut, highShelfCut})
        sections.pushBack(section);
    const auto curve = refinement.evaluate(sections);
    REQUIRE(curve.size() == problem.allPoints());
    for (std::size_t i = 0; i < curve.size(); ++i)
        CHECK(curve[i] == Approx(cookbookLevel(sections, problem.frequency[i], problem.fs)).margin(1e-6));
    CHECK(refinement.evaluate({}) == std::vector<double>(problem.allPoints(), 0.0));
    CHECK(refinement.iterations() == 0);
}

TEST_CASE("The cost is Huber's of the weighted deviations plus the squares beyond the limits", "[linearize]")
{
    for (const double outlier : {1e9, 2.5, 0.4})
        for (const double maxBoost : {12.0, 3.0})
            for (const bool outside : {false, true})
            {
                CAPTURE(outlier, maxBoost, outside);
                auto problem = refinedProblem(maxBoost, outside);
                problem.outlier = outlier;
                EqualizerRefinement refinement(problem);
                EqualizerSections sections{{EqualizerType::peak, 22.0, 6.0, 1.0}, // rises outside of the range
                                           {EqualizerType::peak, 400.0, 5.0, 2.0},
                                           {EqualizerType::peak, 1500.0, 4.0, 2.0}};
                const auto curve = refinement.evaluate(sections);
                double sum = 0.0;
                for (std::size_t i = 0; i < 80; ++i)
                {
                    const double d = std::abs(problem.level[i] + curve[i] + 3.0);
                    sum += problem.weight[i] * (d <= outlier ? d * d : 2.0 * outlier * d - outlier * outlier);
                }
                double squares = 0.0, largest = 0.0;
                const auto add = [&](double over)
                {
                    squares += std::max(over, 0.0) * std::max(over, 0.0);
                    largest = std::max(largest, over);
                };
                for (std::size_t i = 0; i < curve.size(); ++i)
                {
                    add(curve[i] - (maxBoost - 0.03));
                    if (!outside && problem.frequency[i] < 30.0)
                        add(curve[i] - std::max(0.0, curve[0]));
                    if (!outside && problem.frequency[i] > 1000.0001)
                        add(curve[i] - std::max(0.0, curve[79]));
                }
                CHECK(refinement.largestExcess() == Approx(largest).margin(1e-9));
                CHECK(refinement.cost(-3.0) == Approx(sum + 100.0 * squares));
                refinement.setPenalty(7.0);
                CHECK(refinement.cost(-3.0) == Approx(sum + 7.0 * squares));
            }
}

TEST_CASE("What is exactly at a limit costs nothing", "[linearize]")
{
    const auto problem = refinedProblem();
    EqualizerRefinement refinement(problem);
    refinement.evaluate({wideCut});
    CHECK(refinement.largestExcess() == 0.0);
    refinement.evaluate({});
    CHECK(refinement.largestExcess() == 0.0);
    const auto none = refinedProblem(0.0);
    EqualizerRefinement unraised(none);
    unraised.evaluate({});
    CHECK(unraised.largestExcess() == 0.0); // though the margin would be below 0 dB
    CHECK(EqualizerRefinement::maxCut == 39.9);
    CHECK(EqualizerRefinement::usualPenalty == 100.0);
    CHECK(EqualizerCandidate{}.level == 0.0);
    CHECK(EqualizerCandidate{}.cost == std::numeric_limits<double>::infinity());
}

TEST_CASE("Between points that are far apart, the first and the last two too, the edges are no limit", "[linearize]")
{
    // An octave from point to point, between which guards lie.
    FrequencyResponse response;
    for (int i = 0; i < 10; ++i)
        response.frequency.push_back(30.0 * std::exp2(i));
    response.level.assign(10, 0.0);
    const double last = response.frequency.back();
    for (const bool outside : {false, true})
    {
        CAPTURE(outside);
        EqualizerFitParams params;
        params.boostOutside = outside;
        const auto problem = makeEqualizerFitProblem(response, params).value();
        REQUIRE(problem.allPoints() > 50);
        EqualizerRefinement refinement(problem);
        const auto excessOf = [&](double frequency)
        {
            refinement.evaluate({{EqualizerType::peak, frequency, 6.0, 4.0}});
            return refinement.largestExcess();
        };
        for (int i = 0; i < 9; ++i)
            CHECK(excessOf(30.0 * std::exp2(i + 0.5)) == 0.0);
        for (const double beyond : {30.0 * std::exp2(-0.5), last * std::exp2(0.5)})
            CHECK(excessOf(beyond) == Approx(outside ? 0.0 : 5.5).margin(0.5));
    }
}

TEST_CASE("A shelf that raises one side is refined as the one that lowers the other", "[linearize]")
{
    const auto problem = refinedProblem();
    for (const auto& [type, other] : {std::pair(EqualizerType::lowShelf, EqualizerType::highShelf),
                                      std::pair(EqualizerType::highShelf, EqualizerType::lowShelf)})
    {
        EqualizerRefinement refinement(problem);
        auto raising = candidateOf({{type, 120.0, 6.0, 0.8}}, 2.0);
        refinement.refine(raising, 0);
        CHECK(raising.sections[0].type == other);
        CHECK(raising.sections[0].gain == -6.0);
        CHECK(raising.level == -4.0);
        CHECK(refinement.iterations() == 0);
        auto lowering = candidateOf({{type, 120.0, -6.0, 0.8}}, 2.0);
        refinement.refine(lowering, 0);
        CHECK(lowering.sections[0].type == type);
        CHECK(lowering.level == 2.0);
        auto flat = candidateOf({{type, 120.0, 0.0, 0.8}, {EqualizerType::peak, 200.0, 3.0, 1.0}}, 2.0);
        refinement.refine(flat, 0);
        CHECK(flat.sections[0].type == type);
        CHECK(flat.sections[1].type == EqualizerType::peak);
        CHECK(flat.sections[1].gain == 3.0);
    }
}

TEST_CASE("A refinement finds the sections that a response was made of", "[linearize]")
{
    const EqualizerSections made{{EqualizerType::peak, 70.0, -9.0, 3.0}, {EqualizerType::peak, 300.0, 5.0, 1.5}};
    FrequencyResponse response;
    response.frequency = logFrequencies(120, 30.0, 1000.0);
    for (const double f : response.frequency)
        response.level.push_back(5.0 - cookbookLevel(made, f, 48000.0));
    EqualizerFitParams params;
    params.boostOutside = true;
    const auto problem = makeEqualizerFitProblem(response, params).value();
    EqualizerRefinement refinement(problem);
    auto candidate = candidateOf({{EqualizerType::peak, 80.0, -5.0, 2.0}, {EqualizerType::peak, 250.0, 3.0, 1.0}}, 4.0);
    refinement.refine(candidate, 60);
    CHECK(candidate.sections[0].frequency == Approx(70.0).epsilon(1e-3));
    CHECK(candidate.sections[0].gain == Approx(-9.0).epsilon(1e-3));
    CHECK(candidate.sections[0].q == Approx(3.0).epsilon(1e-3));
    CHECK(candidate.sections[1].frequency == Approx(300.0).epsilon(1e-3));
    CHECK(candidate.sections[1].gain == Approx(5.0).epsilon(1e-3));
    CHECK(candidate.sections[1].q == Approx(1.5).epsilon(1e-3));
    CHECK(candidate.level == Approx(5.0).margin(1e-3));
    CHECK(candidate.cost < 1e-6);
    CHECK(refinement.iterations() > 3);
    CHECK(refinement.iterations() < 30);
}

TEST_CASE("Each step of a refinement goes where it went, and never raises the cost", "[linearize]")
{
    const auto run = [](const char* name, const EqualizerFitProblem& problem, const EqualizerCandidate& from)
    {
        CAPTURE(name);
        std::vector<double> values;
        double before = std::numeric_limits<double>::infinity();
        for (const int steps : {1, 2, 3, 5, 9, 40})
        {
            EqualizerRefinement refinement(problem);
            EqualizerCandidate candidate = from;
            refinement.refine(candidate, steps);
            CHECK(candidate.cost <= before);
            before = candidate.cost;
            CHECK(refinement.iterations() <= steps);
            if (steps < 40) // where it ends in the flat, rounding may add a step
                for (const double v : candidateValues(candidate))
                    values.push_back(v);
            EqualizerRefinement other(problem);
            other.evaluate(candidate.sections);
            CHECK(other.cost(candidate.level) <= candidate.cost * (1.0 + 1e-9)); // less where a shelf turned
        }
        checkPinned(std::string("linearize/refinement, ") + name, values, 1e-6);
    };
    const auto usual = refinedProblem();
    run("a peak", usual, candidateOf({wideCut}, -1.0));
    run("two peaks", usual, candidateOf({wideCut, narrowBoost}));
    run("shelves and peaks", usual, candidateOf({lowShelfCut, wideCut, highShelfCut, narrowBoost}, 3.0));
    run("shelves that raise", usual,
        candidateOf({{EqualizerType::lowShelf, 60.0, 8.0, 0.7}, {EqualizerType::highShelf, 500.0, 3.0, 1.0}}));
    run("a section of nothing", usual, candidateOf({{EqualizerType::peak, 70.0, 0.0, 1.0}}));
    run("little boost allowed", refinedProblem(1.0), candidateOf({wideCut, narrowBoost}));
    run("no boost allowed", refinedProblem(0.0), candidateOf({wideCut, narrowBoost}));
    run("boost allowed outside", refinedProblem(12.0, true),
        candidateOf({{EqualizerType::peak, 20.0, 6.0, 1.0}, wideCut}));
    run("beyond the edges", usual,
        candidateOf({{EqualizerType::peak, 20.0, 9.0, 1.0}, {EqualizerType::peak, 1500.0, 9.0, 1.0}}));
    run("at the bounds", usual,
        candidateOf({{EqualizerType::peak, 15.0, -39.9, 0.1},
                     {EqualizerType::peak, 2000.0, 15.0, usual.highestQ},
                     {EqualizerType::lowShelf, 2000.0, -39.9, 4.0}}));
    run("a low rate", refinedProblem(12.0, false, 3000.0), candidateOf({wideCut, highShelfCut}));
    auto robust = refinedProblem();
    robust.outlier = 1.5;
    run("outliers", robust, candidateOf({wideCut, lowShelfCut}));
    FrequencyResponse flat = refinedResponse();
    for (double& level : flat.level)
        level *= 0.001;
    const auto gentle = makeEqualizerFitProblem(flat, {}).value();
    run("small slopes at the bounds", gentle,
        candidateOf({{EqualizerType::peak, gentle.lowestFrequency, 0.02, 0.1},
                     {EqualizerType::peak, gentle.highestFrequency, 0.02, gentle.highestQ},
                     {EqualizerType::peak, gentle.highestFrequency, -0.01, 0.1},
                     {EqualizerType::lowShelf, gentle.lowestFrequency, -0.01, 4.0}}));
    EqualizerFitParams params;
    params.highpass = EqualizerSection{EqualizerType::highpass, 60.0, 0.0, 0.7071067811865476, 2};
    params.maxBoost = 2.0;
    const auto highpassed = makeEqualizerFitProblem(refinedResponse(), params).value();
    run("a high-pass", highpassed, candidateOf({{EqualizerType::peak, 35.0, 9.0, 1.0}, wideCut}));
}

TEST_CASE("Refined sections stay within their bounds", "[linearize]")
{
    // A dip of 60 dB asks for more than is allowed of each parameter.
    FrequencyResponse response = refinedResponse();
    for (std::size_t i = 0; i < 80; ++i)
        response.level[i] = i < 3 ? 200.0 : (i > 60 && i < 64 ? -80.0 : (i > 30 && i < 33 ? 90.0 : 0.0));
    EqualizerFitParams params;
    params.maxBoost = 30.0;
    auto problem = makeEqualizerFitProblem(response, params).value();
    problem.weight = problem.given;
    std::vector<double> values;
    for (const double most : {30.0, 38.5})
    {
        problem.maxBoost = most;
        EqualizerRefinement refinement(problem);
        auto candidate = candidateOf({{EqualizerType::peak, response.frequency[62], 20.0, 8.0},
                                      {EqualizerType::peak, response.frequency[31], -20.0, 8.0},
                                      {EqualizerType::lowShelf, 31.0, -20.0, 2.0}});
        refinement.refine(candidate, 12);
        for (const EqualizerSection& section : candidate.sections)
        {
            CHECK(section.frequency >= problem.lowestFrequency);
            CHECK(section.frequency <= problem.highestFrequency);
            CHECK(section.gain >= -39.9);
            CHECK(section.gain <= (section.type == EqualizerType::peak ? std::min(39.9, most + 3.0) : 0.0));
            CHECK(section.q >= problem.lowestQ);
            CHECK(section.q <= (section.type == EqualizerType::peak ? problem.highestQ : 4.0));
        }
        for (const double v : candidateValues(candidate))
            values.push_back(v);
    }
    checkPinned("linearize/refinement, bounds", values, 1e-5);
}

TEST_CASE("A refinement ends after two steps in a row that gain next to nothing", "[linearize]")
{
    const auto problem = refinedProblem();
    EqualizerRefinement refinement(problem);
    auto candidate = candidateOf({wideCut, narrowBoost});
    refinement.refine(candidate, 1000);
    const int first = refinement.iterations();
    CHECK(first < 60);
    refinement.refine(candidate, 1000);
    CHECK(refinement.iterations() - first <= 30); // counted on
    CHECK(refinement.iterations() > first);
    // It takes as many steps as it took.
    std::vector<double> steps;
    for (const auto& from : {candidateOf({wideCut}), candidateOf({narrowBoost}), candidateOf({lowShelfCut, wideCut}),
                             candidateOf({highShelfCut, narrowBoost, wideCut}), candidateOf({highShelfCut})})
    {
        EqualizerRefinement one(problem);
        auto moving = from;
        one.refine(moving, 1000);
        steps.push_back(one.iterations());
    }
    checkPinned("linearize/refinement, steps to the end", steps);
    EqualizerRefinement zero(problem);
    auto same = candidateOf({wideCut}, 1.0);
    zero.refine(same, 0);
    CHECK(same.sections[0] == wideCut);
    CHECK(same.level == 1.0);
}
