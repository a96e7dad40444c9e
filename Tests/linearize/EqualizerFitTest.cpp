#include "EqualizerReference.h"
#include "support/Catch.h"
#include "support/Golden.h"

#include <pacini/linearize/EqualizerFit.h>

#include <limits>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{
struct Golden
{
    std::string name;
    FrequencyResponse measured, truth;
    bool clean = true;
};

std::vector<Golden> goldenCases()
{
    const auto file = golden("eq_cases");
    std::vector<Golden> cases;
    for (const auto& entry : file["cases"])
    {
        Golden one;
        one.name = entry["name"];
        one.measured.frequency = file["frequencyHz"].get<std::vector<double>>();
        one.measured.level = entry["responseDb"].get<std::vector<double>>();
        one.truth = one.measured;
        if (entry.contains("truthDb"))
            one.truth.level = entry["truthDb"].get<std::vector<double>>();
        one.clean = one.name.substr(0, 2) != "09" && one.name.substr(0, 2) != "20";
        cases.push_back(one);
    }
    return cases;
}

EqualizerFit fitOf(const FrequencyResponse& response, const EqualizerFitParams& params = {})
{
    const auto fit = fitEqualizer(response, params);
    REQUIRE(fit.ok());
    return *fit;
}

EqualizerFitParams withSections(int count)
{
    EqualizerFitParams params;
    params.sections = count;
    return params;
}

struct Summary
{
    std::vector<double> rms; ///< sorted
    int good = 0;
    [[nodiscard]] double median() const { return 0.5 * (rms[rms.size() / 2] + rms[(rms.size() - 1) / 2]); }
};

Summary summaryOf(int sections)
{
    Summary summary;
    for (const Golden& one : goldenCases())
        if (one.clean)
        {
            const auto deviation =
                deviationOf(one.truth, fitOf(one.measured, withSections(sections)).sections, 48000.0);
            summary.rms.push_back(deviation.rms);
            summary.good += deviation.rms <= 0.5 && deviation.max <= 2.0 ? 1 : 0;
        }
    std::sort(summary.rms.begin(), summary.rms.end());
    REQUIRE(summary.rms.size() == 18);
    return summary;
}

/// The most that an equalizer raises any frequency from low to high Hz, on a grid fine enough for q 60.
double boostBetween(const EqualizerSections& sections, double low, double high, double fs)
{
    double most = -1000.0;
    for (const double f : logFrequencies(2000, low, std::min(high, 0.499 * fs)))
        most = std::max(most, cookbookLevel(sections, f, fs));
    return most;
}

FrequencyResponse springResponse(double resonance = 67.0, double q = 4.0)
{
    FrequencyResponse response;
    response.frequency = logFrequencies(256, 30.0, 1000.0);
    for (const double f : response.frequency)
        response.level.push_back(massOnSpring(f, resonance, q));
    return response;
}
} // namespace

TEST_CASE("Three sections flatten most actuators, five all, eight beyond what can be measured", "[linearize]")
{
    const Summary three = summaryOf(3);
    CHECK(three.median() <= 0.40);
    CHECK(three.good >= 13);
    const Summary five = summaryOf(5);
    CHECK(five.good == 18);
    CHECK(five.rms.back() <= 0.30);
    const Summary eight = summaryOf(8);
    CHECK(eight.median() <= 0.02);
    // The measurement of one golden case is 0.256 dB RMS away from its truth, with a shape no fit can tell from it.
    CHECK(eight.rms[16] <= 0.10);
    CHECK(eight.rms[17] <= 0.256);
}

TEST_CASE("Eight sections flatten every clean measurement itself within 0.1 dB RMS", "[linearize]")
{
    for (const Golden& one : goldenCases())
        if (one.clean)
        {
            CAPTURE(one.name);
            CHECK(deviationOf(one.measured, fitOf(one.measured, withSections(8)).sections, 48000.0).rms <= 0.10);
        }
}

TEST_CASE("Left to itself the fit takes few sections and reaches its goal", "[linearize]")
{
    std::size_t sections = 0;
    for (const Golden& one : goldenCases())
    {
        CAPTURE(one.name);
        const EqualizerFit fit = fitOf(one.measured);
        const auto deviation = deviationOf(one.truth, fit.sections, 48000.0);
        sections += fit.sections.size();
        if (one.clean)
        {
            CHECK(fit.reachedGoal);
            CHECK(deviation.rms <= 0.5);
            CHECK(deviation.max <= 2.0);
        }
        else
        {
            CHECK(fit.sections.size() <= 3);
            CHECK(deviation.rms <= 0.8);
        }
    }
    CHECK(static_cast<double>(sections) / 20.0 <= 3.2);
}

TEST_CASE("Drop-outs are found and do not bend the fit", "[linearize]")
{
    for (const Golden& one : goldenCases())
        if (one.name.substr(0, 2) == "20")
        {
            const EqualizerFit fit = fitOf(one.measured, withSections(5));
            CHECK(fit.dropouts == 12);
            CHECK(deviationOf(one.truth, fit.sections, 48000.0).rms <= 0.1);
            CHECK(fit.rms > 5.0); // they still count in what is reported
        }
        else
            CHECK(fitOf(one.measured, withSections(1)).dropouts == 0);
}

TEST_CASE("The boost never exceeds its limit", "[linearize]")
{
    for (const Golden& one : goldenCases())
        for (const int count : {1, 3, 8})
            for (const double most : {0.0, 6.0, 12.0})
            {
                CAPTURE(one.name, count, most);
                EqualizerFitParams params = withSections(count);
                params.maxBoost = most;
                const EqualizerFit fit = fitOf(one.measured, params);
                const double boost = boostBetween(fit.sections, 10.0, 2000.0, 48000.0);
                CHECK(boost <= most + 0.2);
                CHECK(std::abs(std::max(boost, 0.0) - std::max(fit.boost, 0.0)) <= 0.1);
            }
}

TEST_CASE("Outside of the range nothing is raised more than at its edge, unless that is asked for", "[linearize]")
{
    const FrequencyResponse response = springResponse(); // falls at 12 dB per octave towards low frequencies
    for (const int count : {1, 2, 3, 5, 8})
    {
        CAPTURE(count);
        EqualizerFitParams params = withSections(count);
        params.lowFrequency = 50.0;
        params.highFrequency = 500.0;
        const EqualizerFit fit = fitOf(response, params);
        const double atLow = std::max(0.0, cookbookLevel(fit.sections, 50.0, 48000.0));
        const double atHigh = std::max(0.0, cookbookLevel(fit.sections, 500.0, 48000.0));
        CHECK(boostBetween(fit.sections, 5.0, 50.0, 48000.0) <= atLow + 0.2);
        CHECK(boostBetween(fit.sections, 500.0, 20000.0, 48000.0) <= atHigh + 0.2);
    }
    // a dip just outside of the range pulls a peak there only where it may
    FrequencyResponse edge;
    edge.frequency = logFrequencies(100, 100.0, 1000.0);
    for (const double f : edge.frequency)
        edge.level.push_back(-cookbookLevel({EqualizerType::peak, 60.0, 9.0, 1.0}, f, 48000.0));
    EqualizerFitParams peaks = withSections(1);
    peaks.shelves = false;
    CHECK(boostBetween(fitOf(edge, peaks).sections, 30.0, 100.0, 48000.0) <=
          std::max(0.0, cookbookLevel(fitOf(edge, peaks).sections, 100.0, 48000.0)) + 0.2);
    peaks.boostOutside = true;
    const EqualizerFit raised = fitOf(edge, peaks);
    CHECK(raised.rms <= 0.01);
    CHECK(boostBetween(raised.sections, 30.0, 100.0, 48000.0) > 8.0);
}

TEST_CASE("The reported error is that of the sections returned, at any rate", "[linearize]")
{
    for (const double fs : {3000.0, 8000.0, 48000.0, 768000.0})
        for (const Golden& one : goldenCases())
        {
            CAPTURE(fs, one.name);
            EqualizerFitParams params = withSections(5);
            params.sampleRate = fs;
            const EqualizerFit fit = fitOf(one.measured, params);
            const auto deviation = deviationOf(one.measured, fit.sections, fs);
            CHECK(std::abs(fit.rms - deviation.rms) <= 0.01);
            CHECK(std::abs(fit.max - deviation.max) <= 0.01);
            CHECK(std::abs(fit.level - deviation.level) <= 0.01);
            CHECK(equalizerLevel(fit.sections, 200.0, fs) ==
                  Approx(cookbookLevel(fit.sections, 200.0, fs)).margin(1e-6));
            if (one.clean)
                CHECK(fit.rms <= 0.30);
        }
}

TEST_CASE("A mass on a spring takes two sections at any rate", "[linearize]")
{
    for (const double fs : {3000.0, 8000.0, 48000.0, 768000.0})
    {
        CAPTURE(fs);
        EqualizerFitParams params = withSections(2);
        params.sampleRate = fs;
        CHECK(fitOf(springResponse(), params).rms <= 0.06);
    }
}

TEST_CASE("Points from 0.49 of the sample rate on do not count", "[linearize]")
{
    FrequencyResponse response = springResponse();
    EqualizerFitParams params;
    params.sampleRate = 1500.0;
    const EqualizerFit fit = fitOf(response, params);
    CHECK(fit.points < response.size());
    while (response.frequency.back() >= 0.49 * 1500.0)
    {
        response.frequency.pop_back();
        response.level.pop_back();
    }
    CHECK(fit.points == response.size());
    CHECK(fit.rms == Approx(deviationOf(response, fit.sections, 1500.0).rms).margin(1e-9));
    for (const EqualizerSection& section : fit.sections)
        CHECK(section.frequency < 0.49 * 1500.0);
}

TEST_CASE("A flat response needs no sections", "[linearize]")
{
    FrequencyResponse flat;
    flat.frequency = logFrequencies(100, 20.0, 2000.0);
    flat.level.assign(100, -37.5);
    for (const int count : {0, 1, 16})
    {
        const EqualizerFit fit = fitOf(flat, count == 0 ? EqualizerFitParams{} : withSections(count));
        CHECK(fit.sections.empty());
        CHECK(fit.rms <= 1e-9);
        CHECK(fit.level == Approx(-37.5));
        CHECK(fit.reachedGoal);
    }
}

TEST_CASE("Weights decide where the error lies", "[linearize]")
{
    const FrequencyResponse response = springResponse(150.0, 15.0);
    EqualizerFitParams params = withSections(1);
    for (const double f : response.frequency)
        params.weights.push_back(f > 200.0 ? 100.0 : 0.01);
    const auto above = [&](const EqualizerFit& fit)
    {
        FrequencyResponse part;
        for (std::size_t i = 0; i < response.size(); ++i)
            if (response.frequency[i] > 200.0)
            {
                part.frequency.push_back(response.frequency[i]);
                part.level.push_back(response.level[i]);
            }
        return deviationOf(part, fit.sections, 48000.0).rms;
    };
    CHECK(above(fitOf(response, params)) < 0.1 * above(fitOf(response, withSections(1))));
}

TEST_CASE("A fixed high-pass is part of the equalizer and of the fit", "[linearize]")
{
    const FrequencyResponse response = springResponse();
    EqualizerFitParams params = withSections(4);
    params.highpass = EqualizerSection{EqualizerType::highpass, 25.0, 0.0, 0.7071067811865476, 2};
    const EqualizerFit fit = fitOf(response, params);
    REQUIRE_FALSE(fit.sections.empty());
    CHECK(fit.sections[0] == *params.highpass);
    const auto deviation = deviationOf(response, fit.sections, 48000.0);
    CHECK(fit.rms == Approx(deviation.rms).margin(1e-6));
    CHECK(deviation.rms <= 0.1);
}

TEST_CASE("The same fit gives the same bits", "[linearize]")
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        const FrequencyResponse response = randomResponse(seed);
        const EqualizerFit one = fitOf(response), two = fitOf(response);
        CHECK(one.sections == two.sections);
        CHECK(one.rms == two.rms);
        CHECK(one.level == two.level);
    }
}

TEST_CASE("Random responses always give valid sections within the limits that are no worse than none", "[linearize]")
{
    for (std::uint64_t seed = 1; seed <= 200; ++seed)
    {
        Random random(seed);
        const FrequencyResponse response = randomResponse(seed);
        EqualizerFitParams params;
        params.sampleRate = std::array{3000.0, 8000.0, 48000.0, 768000.0}[random.next() % 4];
        if (random.uniform() < 0.7)
            params.sections = 1 + static_cast<int>(random.next() % 16);
        params.maxBoost = random.uniform(0.0, 20.0);
        params.shelves = random.uniform() < 0.8;
        const std::size_t most = static_cast<std::size_t>(params.sections.value_or(params.maxSections));
        CAPTURE(seed, params.sampleRate, most);
        const auto fit = fitEqualizer(response, params);
        if (!fit)
        {
            CHECK(response.frequency[7] >= 0.49 * params.sampleRate);
            continue;
        }
        CHECK(validate(fit->sections, "sections").ok());
        CHECK(fit->sections.size() <= most);
        CHECK(std::isfinite(fit->rms));
        CHECK(std::isfinite(fit->level));
        CHECK(boostBetween(fit->sections, 5.0, 4000.0, params.sampleRate) <= params.maxBoost + 0.2);
        if (response.frequency.back() < 0.49 * params.sampleRate && fit->dropouts == 0)
            CHECK(fit->rms <= deviationOf(response, {}, params.sampleRate).rms + 1e-9);
        for (const EqualizerSection& section : fit->sections)
        {
            CHECK(section.frequency < 0.49 * params.sampleRate);
            CHECK((params.shelves || section.type == EqualizerType::peak));
        }
    }
}

TEST_CASE("A section that does nothing is left out, however many were asked for", "[linearize]")
{
    // Responses for which the fit moves one of its sections to next to no gain.
    for (const std::uint64_t seed : {74u, 77u, 245u})
        for (const double maxBoost : {0.0, 1.0, 12.0})
        {
            CAPTURE(seed, maxBoost);
            EqualizerFitParams params = withSections(16);
            params.maxBoost = maxBoost;
            const EqualizerFit fit = fitOf(randomResponse(seed), params);
            CHECK_FALSE(fit.sections.empty());
            for (const EqualizerSection& section : fit.sections)
                CHECK(std::abs(section.gain) >= 0.001);
        }
}

TEST_CASE("Many points are fitted as well as few", "[linearize]")
{
    FrequencyResponse dense;
    dense.frequency = logFrequencies(20000, 30.0, 1000.0);
    for (const double f : dense.frequency)
        dense.level.push_back(massOnSpring(f, 175.0, 20.0));
    const EqualizerFit fit = fitOf(dense, withSections(3));
    CHECK(fit.points == 20000);
    CHECK(fit.rms == Approx(deviationOf(dense, fit.sections, 48000.0).rms).margin(1e-6));
    CHECK(fit.rms <= 0.2);
}

TEST_CASE("The derivatives of a section's level are those of its level", "[linearize]")
{
    const std::vector<double> frequencies = logFrequencies(40, 5.0, 3500.0);
    for (const double fs : {8000.0, 48000.0, 768000.0})
        for (const auto type : {EqualizerType::peak, EqualizerType::lowShelf, EqualizerType::highShelf})
            for (const double gain : {-30.0, -3.0, 0.0, 12.0})
                for (const double q : {0.2, 0.7, 8.0})
                {
                    const EqualizerSection section{type, 180.0, gain, q};
                    std::vector<double> warped;
                    for (const double f : frequencies)
                        warped.push_back(warpedSquare(f, fs));
                    std::vector<double> byFrequency(40), byGain(40), byQ(40);
                    SectionCurve(section, fs).differentiate(warped, {byFrequency, byGain, byQ});
                    for (std::size_t i = 0; i < 40; ++i)
                    {
                        CAPTURE(fs, static_cast<int>(type), gain, q, frequencies[i]);
                        const auto at = [&](double f, double g, double k)
                        {
                            return cookbookLevel({type, section.frequency * std::exp(f), gain + g, q * std::exp(k)},
                                                 frequencies[i], fs);
                        };
                        // the fourth-order difference
                        const auto slope = [](const auto& level, double h)
                        {
                            return (8.0 * (level(h) - level(-h)) - (level(2.0 * h) - level(-2.0 * h))) / (12.0 * h);
                        };
                        const double df = slope([&](double h) { return at(h, 0.0, 0.0); }, 1e-3);
                        const double dg = slope([&](double h) { return at(0.0, h, 0.0); }, 1e-2);
                        const double dq = slope([&](double h) { return at(0.0, 0.0, h); }, 1e-3);
                        CHECK(std::abs(byFrequency[i] - df) <= 1e-6 * std::max(1.0, std::abs(df)));
                        CHECK(std::abs(byGain[i] - dg) <= 1e-6 * std::max(1.0, std::abs(dg)));
                        CHECK(std::abs(byQ[i] - dq) <= 1e-6 * std::max(1.0, std::abs(dq)));
                    }
                }
}

TEST_CASE("What cannot be fitted is refused by name", "[linearize]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    const FrequencyResponse good = springResponse();
    const auto whereOf = [](const FrequencyResponse& response, const EqualizerFitParams& params)
    {
        const auto fit = fitEqualizer(response, params);
        REQUIRE_FALSE(fit.ok());
        CHECK_FALSE(fit.error().message.empty());
        return fit.error().where;
    };
    const auto withResponse = [&](const auto& change)
    {
        FrequencyResponse response = good;
        change(response);
        return whereOf(response, {});
    };
    const auto withParams = [&](const auto& change)
    {
        EqualizerFitParams params;
        change(params);
        return whereOf(good, params);
    };
    using Response = FrequencyResponse;
    using Params = EqualizerFitParams;
    CHECK(withResponse([](Response& r) { r.frequency.resize(7), r.level.resize(7); }) == "points");
    CHECK(withResponse([](Response& r) { r.level.pop_back(); }) == "points");
    CHECK(withResponse([](Response& r) { std::swap(r.frequency[3], r.frequency[4]); }) == "points[4].frequency");
    CHECK(withResponse([](Response& r) { r.frequency.assign(r.size(), 100.0); }) == "points[1].frequency");
    CHECK(withResponse([&](Response& r) { r.level[9] = nan; }) == "points[9].level");
    CHECK(withResponse([&](Response& r) { r.frequency[9] = inf; }) == "points[9].frequency");
    for (const double wrong : {nan, inf, -1.0, 999.0, 1e8})
        CHECK(withParams([&](Params& p) { p.sampleRate = wrong; }) == "sampleRate");
    for (const double wrong : {nan, inf, -0.1, 41.0})
        CHECK(withParams([&](Params& p) { p.maxBoost = wrong; }) == "maxBoost");
    for (const int wrong : {-1, 0, 17})
    {
        CHECK(withParams([&](Params& p) { p.sections = wrong; }) == "sections");
        CHECK(withParams([&](Params& p) { p.maxSections = wrong; }) == "maxSections");
    }
    CHECK(withParams([&](Params& p) { p.lowFrequency = nan; }) == "lowFrequency");
    CHECK(withParams([&](Params& p) { p.highFrequency = inf; }) == "highFrequency");
    CHECK(withParams([&](Params& p) { p.goalRms = nan; }) == "goalRms");
    CHECK(withParams([&](Params& p) { p.goalMax = -1.0; }) == "goalMax");
    CHECK(withParams([](Params& p) { p.lowFrequency = 500.0, p.highFrequency = 400.0; }) == "highFrequency");
    CHECK(withParams([](Params& p) { p.lowFrequency = 950.0; }) == "lowFrequency");
    CHECK(withParams([](Params& p) { p.highFrequency = 31.0; }) == "highFrequency");
    CHECK(withParams([](Params& p) { p.weights = {1.0, 2.0}; }) == "weights");
    CHECK(withParams([](Params& p) { p.weights.assign(256, 0.0); }) == "weights");
    const auto withWeight = [&](double weight)
    {
        return withParams(
            [&](Params& p)
            {
                p.weights.assign(256, 1.0);
                p.weights[5] = weight;
            });
    };
    for (const double wrong : {nan, inf, -1.0})
        CHECK(withWeight(wrong) == "weights[5]");
    CHECK(withParams([](Params& p) { p.highpass = EqualizerSection{}; }) == "highpass.type");
    CHECK(withParams(
              [](Params& p) {
                  p.highpass = EqualizerSection{EqualizerType::highpass, 20.0, 0.0, 0.7, 9};
              }) == "highpass[0].order");
    FrequencyResponse high = good;
    for (double& f : high.frequency)
        f *= 100.0;
    EqualizerFitParams slow;
    slow.sampleRate = 6000.0;
    CHECK(whereOf(high, slow) == "sampleRate");
}

TEST_CASE("By default a fit is content with half a decibel on the whole and two at the worst point", "[linearize]")
{
    // A bump of some neighbouring points on a flat response; both are below half a decibel RMS.
    const auto bump = [](double height, double width)
    {
        FrequencyResponse response{logFrequencies(100, 20.0, 2000.0), {}};
        for (int i = 0; i < 100; ++i)
            response.level.push_back(height * std::exp(-0.5 * (i - 50.0) * (i - 50.0) / (width * width)));
        return response;
    };
    const EqualizerFit small = fitOf(bump(1.7, 3.0), {});
    CHECK(small.sections.empty());
    CHECK(small.rms < 0.5);
    CHECK(small.max > 1.5);
    CHECK(small.reachedGoal);
    const EqualizerFit high = fitOf(bump(2.6, 1.5), {});
    CHECK_FALSE(high.sections.empty());
    CHECK(high.max < 2.0);
    const EqualizerFit wide = fitOf(bump(1.7, 12.0), {});
    CHECK_FALSE(wide.sections.empty());
    CHECK(wide.rms < 0.5);
}
