#include "EqualizerReference.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/linearize/EqualizerStart.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
EqualizerFitProblem startProblem(std::size_t points, double low, double high, const EqualizerFitParams& params = {})
{
    FrequencyResponse response{logFrequencies(points, low, high), std::vector<double>(points, 0.0)};
    return makeEqualizerFitProblem(response, params).value();
}

/// What the points deviate by where `section` has not been taken out yet.
std::vector<double> startDeviation(const EqualizerFitProblem& problem, const EqualizerSections& sections)
{
    std::vector<double> deviation;
    for (std::size_t i = 0; i < problem.points(); ++i)
        deviation.push_back(-cookbookLevel(sections, problem.frequency[i], problem.fs));
    return deviation;
}

std::vector<double> startValues(const std::vector<EqualizerSection>& sections)
{
    std::vector<double> values{static_cast<double>(sections.size())};
    for (const EqualizerSection& section : sections)
    {
        values.push_back(static_cast<double>(section.type));
        values.push_back(std::log(section.frequency));
        values.push_back(section.gain);
        values.push_back(std::log(section.q));
    }
    return values;
}
} // namespace

TEST_CASE("A deviation of the shape of a peak or a shelf proposes that", "[linearize]")
{
    const auto problem = startProblem(128, 20.0, 1280.0);
    const EqualizerStart start(problem);
    for (const double q : {0.5, 1.0, 2.0, 4.0})
        for (const int octave : {2, 3, 4})
        {
            CAPTURE(q, octave);
            const EqualizerSection made{EqualizerType::peak, 20.0 * std::exp2(octave), -1.0, q};
            const auto proposals = start.proposals(startDeviation(problem, {made}));
            REQUIRE_FALSE(proposals.empty());
            CHECK(proposals[0].type == EqualizerType::peak);
            CHECK(proposals[0].frequency == Approx(made.frequency));
            CHECK(proposals[0].q == q);
            CHECK(proposals[0].gain == Approx(-1.0).epsilon(0.1));
        }
    const EqualizerSection shelf{EqualizerType::lowShelf, 160.0, -1.0, 0.7};
    const auto proposals = start.proposals(startDeviation(problem, {shelf}));
    CHECK(proposals.back().type == EqualizerType::lowShelf);
    CHECK(proposals.back().frequency == Approx(160.0));
    CHECK(proposals.back().q == 0.7);
    CHECK(proposals.back().gain == Approx(-1.0).epsilon(0.1));
}

TEST_CASE("What is flat proposes nothing, and shelves only where they may be", "[linearize]")
{
    const auto problem = startProblem(100, 20.0, 2000.0);
    CHECK(EqualizerStart(problem).proposals(std::vector<double>(100, 0.0)).empty());
    EqualizerFitParams params;
    params.shelves = false;
    const auto peaks = startProblem(100, 20.0, 2000.0, params);
    const auto deviation = startDeviation(peaks, {{EqualizerType::lowShelf, 100.0, -9.0, 0.7}});
    for (const auto& section : EqualizerStart(peaks).proposals(deviation))
        CHECK(section.type == EqualizerType::peak);
    CHECK(EqualizerStart(problem).proposals(deviation).back().type == EqualizerType::lowShelf);
}

TEST_CASE("A single high point is proposed as a narrow peak on it", "[linearize]")
{
    const auto problem = startProblem(100, 20.0, 2000.0);
    std::vector<double> deviation(100, 0.0);
    deviation[40] = 9.0;
    deviation[41] = 4.6;
    deviation[42] = 4.5; // half is not more than half
    deviation[39] = 4.4;
    const auto proposals = EqualizerStart(problem).proposals(deviation);
    REQUIRE(proposals.size() == 3);
    CHECK(proposals[1].type == EqualizerType::peak);
    CHECK(proposals[1].frequency == problem.frequency[40]);
    CHECK(proposals[1].gain == -9.0);
    CHECK(proposals[1].q == Approx(1.0 / std::log(problem.frequency[42] / problem.frequency[39])));

    // Of the ends the outermost point is the side.
    for (const std::size_t at : {std::size_t(0), std::size_t(99)})
    {
        std::vector<double> end(100, 0.0);
        end[at] = -5.0;
        const auto found = EqualizerStart(problem).proposals(end);
        REQUIRE(found.size() >= 2);
        CHECK(found[1].frequency == problem.frequency[at]);
        CHECK(found[1].gain == 5.0);
        CHECK(found[1].q == problem.highestQ); // one step is narrower than the narrowest
    }
    // Gains are those allowed: 30 dB down, maxBoost up.
    deviation.assign(100, 0.0);
    deviation[30] = 45.0;
    CHECK(EqualizerStart(problem).proposals(deviation)[1].gain == -30.0);
    deviation[30] = -45.0;
    CHECK(EqualizerStart(problem).proposals(deviation)[1].gain == 12.0);
}

TEST_CASE("Proposals for any deviation are those that they were", "[linearize]")
{
    const auto pin = [](const char* name, const EqualizerFitProblem& problem)
    {
        const EqualizerStart start(problem);
        std::vector<double> values;
        for (int kind = 0; kind < 8; ++kind)
        {
            std::vector<double> deviation;
            for (std::size_t i = 0; i < problem.points(); ++i)
            {
                const double x = static_cast<double>(i) / static_cast<double>(problem.points() - 1);
                deviation.push_back(kind == 0   ? 8.0 * x - 4.0
                                    : kind == 1 ? 6.0 * std::sin(9.0 * x)
                                    : kind == 2 ? -50.0 * std::exp(-300.0 * (x - 0.3) * (x - 0.3)) + 2.0
                                    : kind == 3 ? 60.0 * std::exp(-9000.0 * (x - 0.52) * (x - 0.52))
                                    : kind == 4 ? (x < 0.2 ? -90.0 : 15.0 * x)
                                    : kind == 5
                                        ? -5.0 * std::exp(-9.0 * x) + 1.7 * std::exp(-900.0 * (x - 0.7) * (x - 0.7))
                                    : kind == 6 ? 0.01 * std::cos(31.0 * x * x)
                                                : 3.0 * std::exp(-30.0 * (1.0 - x)) - 1.0);
            }
            for (const double v : startValues(start.proposals(deviation)))
                values.push_back(v);
        }
        checkPinned(std::string("linearize/proposals, ") + name, values, 1e-6);
    };
    EqualizerFitParams params;
    pin("many points", startProblem(150, 20.0, 2000.0));
    pin("few points", startProblem(12, 25.0, 700.0));
    pin("a narrow range", startProblem(90, 100.0, 160.0));
    pin("eleven octaves", startProblem(256, 9.0, 19000.0));
    params.sampleRate = 2500.0;
    params.maxBoost = 3.0;
    pin("a low rate", startProblem(70, 40.0, 1200.0, params));
    params = {};
    params.shelves = false;
    for (std::size_t i = 0; i < 97; ++i)
        params.weights.push_back(i < 9 ? 0.0 : (i % 5 == 0 ? 0.2 : 2.0));
    pin("weights", startProblem(97, 20.0, 2000.0, params));
    pin("above 20 kHz", startProblem(60, 2000.0, 90000.0, fitParamsAt(400000.0)));
    pin("below 1 Hz", startProblem(60, 0.2, 30.0, fitParamsAt(1000.0)));
}
