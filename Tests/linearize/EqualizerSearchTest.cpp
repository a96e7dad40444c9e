#include "EqualizerReference.h"
#include "support/Catch.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/linearize/EqualizerFit.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// Resonances, tilts and ripple; of `points` points.
FrequencyResponse searchedResponse(std::size_t points, double resonance, double q, double tilt, double ripple)
{
    FrequencyResponse response;
    response.frequency = logFrequencies(points, 25.0, 1200.0);
    for (const double f : response.frequency)
        response.level.push_back(massOnSpring(f, resonance, q) + tilt * std::log2(f / 25.0) +
                                 ripple * std::sin(7.0 * std::log(f)));
    return response;
}

void pinFit(const char* name, const FrequencyResponse& response, const EqualizerFitParams& params)
{
    CAPTURE(name);
    const auto fit = fitEqualizer(response, params);
    REQUIRE(fit.ok());
    std::vector<double> values;
    for (const EqualizerSection& section : fit->sections)
    {
        values.push_back(static_cast<double>(section.type));
        values.push_back(std::log(section.frequency));
        values.push_back(section.gain);
        values.push_back(std::log(section.q));
    }
    checkPinned(std::string("linearize/fit, ") + name, values, 1e-5);
    checkPinned(std::string("linearize/fit, figures, ") + name,
                {fit->rms, fit->max, fit->level, fit->boost, static_cast<double>(fit->points),
                 static_cast<double>(fit->dropouts), static_cast<double>(fit->iterations),
                 fit->reachedGoal ? 1.0 : 0.0},
                1e-5);
}
} // namespace

TEST_CASE("Flatness is the weighted mean, deviation and largest deviation", "[linearize]")
{
    EqualizerFitProblem problem;
    for (const double level : {1.0, 2.0, 4.0, 9.0})
        problem.addPoint(100.0 * level, level, 1.0);
    problem.addGuard(1000.0);
    const std::vector<double> curve{0.5, 0.0, -1.0, 0.0, 77.0};
    const auto flat = flatnessOf(problem, curve, {1.0, 2.0, 1.0, 0.0});
    CHECK(flat.level == Approx(8.5 / 4.0));
    CHECK(flat.rms == Approx(std::sqrt((0.625 * 0.625 + 2.0 * 0.125 * 0.125 + 0.875 * 0.875) / 4.0)));
    CHECK(flat.max == Approx(0.875)); // the fourth has no weight
    CHECK(flatnessOf(problem, curve, {1.0, 2.0, 1.0, 0.01}).max > 6.0);
    CHECK(Flatness{}.level == 0.0);
    CHECK(Flatness{}.rms == 0.0);
    CHECK(Flatness{}.max == 0.0);
}

TEST_CASE("A watch sets guards on sharp sections and on the highest point beside and between the points", "[linearize]")
{
    FrequencyResponse response{logFrequencies(10, 100.0, 1000.0), std::vector<double>(10, 0.0)};
    const auto guardsFor = [&](const EqualizerSections& sections, const EqualizerFitParams& params = {})
    {
        auto problem = makeEqualizerFitProblem(response, params).value();
        const std::size_t before = problem.allPoints();
        EqualizerWatch watch(problem);
        CHECK(problem.allPoints() == before);
        watch.guard(sections);
        return std::vector<double>(problem.frequency.begin() + static_cast<std::ptrdiff_t>(before),
                                   problem.frequency.end());
    };
    // a peak: itself, then the highest of 3.5 octaves below, between the points and above
    const auto low = guardsFor({{EqualizerType::peak, 30.0, 12.0, 8.0}});
    REQUIRE(low.size() == 4);
    CHECK(low[0] == 30.0);
    CHECK(low[1] == Approx(100.0 * std::exp2(-56.0 / 32.0))); // the nearest to 30 Hz of a grid of 1/32 octave
    CHECK(low[2] == Approx(std::sqrt(response.frequency[0] * response.frequency[1])));
    CHECK(low[3] == Approx(1000.0 * std::exp2(1.0 / 32.0)));
    const auto far = guardsFor({{EqualizerType::peak, 5.0, 12.0, 8.0}});
    CHECK(far[1] == Approx(100.0 * std::exp2(-3.5)));
    const auto high = guardsFor({{EqualizerType::peak, 11000.0, 12.0, 4.0}});
    CHECK(high[3] == Approx(1000.0 * std::exp2(110.0 / 32.0)).epsilon(0.04));
    const auto between = guardsFor({{EqualizerType::peak, 670.0, 12.0, 8.0}});
    CHECK(between[2] == Approx(std::sqrt(response.frequency[7] * response.frequency[8])));
    // a shelf: the frequencies of its poles and zeros
    const auto shelf = guardsFor({{EqualizerType::lowShelf, 300.0, -16.0, 1.0}});
    REQUIRE(shelf.size() == 5);
    CHECK(shelf[0] == Approx(300.0 * std::pow(10.0, -0.2)));
    CHECK(shelf[1] == Approx(300.0 * std::pow(10.0, 0.2)));
    // half of the rate is the end, and a high-pass counts
    EqualizerFitParams params;
    params.sampleRate = 2100.0;
    CHECK(guardsFor({{EqualizerType::peak, 30.0, 12.0, 8.0}}, params)[3] == Approx(1000.0 * std::exp2(1.0 / 32.0)));
    params.sampleRate = 2040.9; // even the lowest of the grid above is beyond
    CHECK(guardsFor({{EqualizerType::peak, 30.0, 12.0, 8.0}}, params).size() == 3);
    params = {};
    params.highpass = EqualizerSection{EqualizerType::highpass, 90.0, 0.0, 0.7071067811865476, 2};
    CHECK(guardsFor({{EqualizerType::peak, 30.0, 12.0, 1.0}}, params)[1] > 40.0);
    checkPinned(
        "linearize/watch",
        guardsFor({{EqualizerType::peak, 40.0, 9.0, 2.0}, {EqualizerType::highShelf, 500.0, -6.0, 2.0}}, params));
}

TEST_CASE("Fits find what they found", "[linearize]")
{
    const auto spring = searchedResponse(100, 67.0, 4.0, 0.0, 0.0);
    const auto tilted = searchedResponse(90, 120.0, 9.0, -2.0, 1.2);
    EqualizerFitParams params;
    pinFit("a spring", spring, params);
    pinFit("a tilt", tilted, params);
    for (const int sections : {1, 2, 3, 6})
    {
        params.sections = sections;
        pinFit(("a tilt with " + std::to_string(sections) + " sections").c_str(), tilted, params);
    }
    params = {};
    params.maxSections = 2;
    pinFit("two sections at most", tilted, params);
    params = {};
    params.goalRms = 0.05;
    params.goalMax = 0.3;
    pinFit("a high goal", spring, params);
    params = {};
    params.goalRms = 3.0;
    params.goalMax = 100.0;
    pinFit("a low goal", tilted, params);
    params = {};
    params.maxBoost = 1.0;
    params.sections = 4;
    pinFit("little boost", tilted, params);
    params.maxBoost = 0.0;
    pinFit("no boost", tilted, params);
    params = {};
    params.boostOutside = true;
    params.shelves = false;
    params.sections = 3;
    pinFit("peaks, boost outside", tilted, params);
    params = {};
    params.sampleRate = 2600.0;
    params.lowFrequency = 40.0;
    params.highFrequency = 900.0;
    pinFit("a low rate and a part of the range", tilted, params);
    params = {};
    params.highpass = EqualizerSection{EqualizerType::highpass, 30.0, 0.0, 0.7071067811865476, 2};
    params.sections = 3;
    pinFit("a high-pass", tilted, params);
    params = {};
    for (std::size_t i = 0; i < 90; ++i)
        params.weights.push_back(i < 30 ? 0.1 : 3.0);
    params.sections = 3;
    pinFit("weights", tilted, params);
}

TEST_CASE("Fits of noisy, sparse, dense and broken responses find what they found", "[linearize]")
{
    Random random(7);
    auto noisy = searchedResponse(160, 80.0, 6.0, 0.5, 0.0);
    for (double& level : noisy.level)
        level += random.uniform(-1.5, 1.5);
    EqualizerFitParams params;
    params.goalRms = 0.1; // below the noise, so that only the criterion ends the search
    pinFit("noise", noisy, params);
    for (std::size_t i = 20; i < 160; i += 40)
        noisy.level[i] -= 60.0;
    pinFit("noise and drop-outs", noisy, params);
    pinFit("eight points", searchedResponse(8, 100.0, 2.0, 1.0, 0.0), {});
    pinFit("eleven points", searchedResponse(11, 200.0, 1.0, 0.0, 2.0), {});
    params = {};
    params.sections = 16;
    pinFit("few points, many sections", searchedResponse(25, 60.0, 3.0, 1.0, 1.0), params);
    params.sections = 2;
    pinFit("dense", searchedResponse(1500, 90.0, 5.0, 0.0, 0.5), params);
    pinFit("an overshooting dip", searchedResponse(60, 90.0, 0.3, 4.0, 6.0), params);
    auto notch = searchedResponse(120, 400.0, 1.0, 0.0, 0.0);
    for (std::size_t i = 0; i < 120; ++i)
        notch.level[i] -= 25.0 * std::exp(-0.02 * (static_cast<double>(i) - 50.0) * (static_cast<double>(i) - 50.0));
    params.sections = 3;
    params.maxBoost = 6.0;
    pinFit("a notch beyond the boost", notch, params);
}

TEST_CASE("A fit of a number of sections has no section of nothing and sorts them", "[linearize]")
{
    EqualizerFitParams params;
    params.sections = 5;
    const auto fit = fitEqualizer(searchedResponse(100, 150.0, 3.0, 1.0, 2.0), params).value();
    for (std::size_t i = 0; i < fit.sections.size(); ++i)
    {
        CHECK(std::abs(fit.sections[i].gain) >= 0.001);
        if (i > 0)
            CHECK(fit.sections[i].frequency >= fit.sections[i - 1].frequency);
    }
    CHECK(fit.iterations > 10);
    // no more parameters than points: eight points hold two sections
    params.sections = 16;
    CHECK(fitEqualizer(searchedResponse(8, 100.0, 6.0, 2.0, 3.0), params)->sections.size() == 2);
    CHECK(fitEqualizer(searchedResponse(10, 100.0, 6.0, 2.0, 3.0), params)->sections.size() == 3);
}

TEST_CASE("Parameters of a fit may be at the ends of their ranges but not beyond", "[linearize]")
{
    const auto response = searchedResponse(40, 100.0, 2.0, 0.0, 0.0);
    const auto where = [&](auto change)
    {
        EqualizerFitParams params;
        change(params);
        const auto valid = validate(response, params);
        CHECK((valid.ok() || valid.error().code == ErrorCode::invalidArgument));
        return valid.ok() ? std::string() : valid.error().where + ": " + valid.error().message;
    };
    const std::string fine;
    using Params = EqualizerFitParams;
    for (const double good : {1000.0, 1e7})
        CHECK(where([&](Params& p) { p.sampleRate = good; }) == fine);
    for (const double bad : {999.9, 1.0001e7})
        CHECK(where([&](Params& p) { p.sampleRate = bad; }) == "sampleRate: must be 1000 to 10000000 Hz");
    for (const int good : {1, 16})
    {
        CHECK(where([&](Params& p) { p.sections = good; }) == fine);
        CHECK(where([&](Params& p) { p.maxSections = good; }) == fine);
    }
    CHECK(where([](Params& p) { p.sections = 17; }) == "sections: must be 1 to 16, or left open");
    CHECK(where([](Params& p) { p.sections = 0; }) == "sections: must be 1 to 16, or left open");
    CHECK(where([](Params& p) { p.maxSections = 17; }) == "maxSections: must be 1 to 16");
    CHECK(where([](Params& p) { p.maxSections = 0; }) == "maxSections: must be 1 to 16");
    for (const double good : {0.0, 40.0})
        CHECK(where([&](Params& p) { p.maxBoost = good; }) == fine);
    for (const double bad : {-0.001, 40.001})
        CHECK(where([&](Params& p) { p.maxBoost = bad; }) == "maxBoost: must be 0 to 40 dB");
    for (const double good : {0.0, 100.0})
    {
        CHECK(where([&](Params& p) { p.goalRms = good; }) == fine);
        CHECK(where([&](Params& p) { p.goalMax = good; }) == fine);
    }
    for (const double bad : {-0.001, 100.001})
    {
        CHECK(where([&](Params& p) { p.goalRms = bad; }) == "goalRms: must be 0 to 100 dB");
        CHECK(where([&](Params& p) { p.goalMax = bad; }) == "goalMax: must be 0 to 100 dB");
    }
    for (const double good : {0.0, 0.1, 200000.0})
    {
        CHECK(where([&](Params& p) { p.lowFrequency = good; }) == fine);
        CHECK(where([&](Params& p) { p.highFrequency = good; }) == fine);
    }
    for (const double bad : {-1.0, 0.0999, 200001.0})
    {
        CHECK(where([&](Params& p) { p.lowFrequency = bad; }) ==
              "lowFrequency: must be 0.1 to 200000 Hz, or 0 for the first point");
        CHECK(where([&](Params& p) { p.highFrequency = bad; }) ==
              "highFrequency: must be 0.1 to 200000 Hz, or 0 for the last point");
    }
    CHECK(where([](Params& p) { p.lowFrequency = p.highFrequency = 300.0; }) ==
          "highFrequency: must be above lowFrequency");
    CHECK(where([](Params& p) { p.lowFrequency = 300.0, p.highFrequency = 300.1; }) == fine);
    const EqualizerSection highpass{EqualizerType::highpass, 20.0, 0.0, 0.7, 2};
    CHECK(where([&](Params& p) { p.highpass = highpass, p.sections = 15; }) == fine);
    CHECK(where([&](Params& p) { p.highpass = highpass, p.maxSections = 15; }) == fine);
    CHECK(where([&](Params& p) { p.highpass = highpass, p.maxSections = 16, p.sections = 15; }) == fine);
    CHECK(where([&](Params& p) { p.highpass = highpass, p.sections = 16; }) ==
          "sections: must be 1 to 15 beside a high-pass");
    CHECK(where([&](Params& p) { p.highpass = highpass, p.maxSections = 16; }) ==
          "maxSections: must be 1 to 15 beside a high-pass");
    CHECK(where([](Params& p) { p.highpass = EqualizerSection{}; }) == "highpass.type: must be highpass");
    CHECK(where([](Params& p) { p.weights.assign(40, 0.0), p.weights[39] = 1e9; }) == fine);
    CHECK(where([](Params& p) { p.weights.assign(40, 1.0), p.weights[0] = -1e-9; }) == "weights[0]: must be 0 to 1e9");
    CHECK(where([](Params& p) { p.weights.assign(40, 1.0), p.weights[39] = 1.0001e9; }) ==
          "weights[39]: must be 0 to 1e9");
    CHECK(where([](Params& p) { p.weights.assign(39, 1.0); }) == "weights: must be as many as the response has points");

    const EqualizerFitParams defaults;
    CHECK(defaults.sampleRate == 48000.0);
    CHECK_FALSE(defaults.sections.has_value());
    CHECK(defaults.maxSections == 8);
    CHECK(defaults.maxBoost == 12.0);
    CHECK(defaults.lowFrequency == 0.0);
    CHECK(defaults.highFrequency == 0.0);
    CHECK(defaults.weights.empty());
    CHECK_FALSE(defaults.boostOutside);
    CHECK(defaults.shelves);
    CHECK_FALSE(defaults.highpass.has_value());
    CHECK(defaults.goalRms == 0.5);
    CHECK(defaults.goalMax == 2.0);
    const EqualizerFit none;
    CHECK(none.sections.empty());
    CHECK(test::asNumbers(none.rms, none.max, none.level, none.boost) == test::Numbers{0.0, 0.0, 0.0, 0.0});
    CHECK(test::asNumbers(none.points, none.dropouts, none.iterations, none.reachedGoal) ==
          test::Numbers{0, 0, 0, false});
}
