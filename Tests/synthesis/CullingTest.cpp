#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/synthesis/Culling.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::detail;

namespace
{
/// A plan of plays with so many bands each, and what they cost.
RenderPlan culledPlan(const std::vector<std::size_t>& bands)
{
    RenderPlan plan;
    for (std::size_t i = 0; i < bands.size(); ++i)
    {
        PlannedPlay play;
        play.play = i;
        for (std::size_t k = 0; k < bands[i]; ++k)
            play.clip.bands.push_back(
                {1.0, 10.0 * static_cast<double>(i + 1) + static_cast<double>(k), 1000.0, 0, {}, {}});
        plan.plays.push_back(play);
    }
    return plan;
}

Scene sceneOfPlays(std::size_t count)
{
    Scene scene;
    scene.plays.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        scene.plays[i].clip = i;
    return scene;
}

PlayEnergy costing(double most, std::vector<double> bands = {})
{
    PlayEnergy energy;
    energy.most = most;
    energy.bands = std::move(bands);
    return energy;
}

std::string candidatesOf(const RenderPlan& plan, const std::vector<PlayEnergy>& energies)
{
    std::string text;
    for (const Dispensable& candidate : dispensables(plan, energies))
        text += std::to_string(candidate.planned) + (candidate.band ? "." + std::to_string(*candidate.band) : "") + " ";
    return text;
}

std::string leftOutOf(const RenderPlan& plan)
{
    std::string text;
    for (const LeftOut& item : plan.leftOut)
        text += item.where + " " + item.reason + "; ";
    return text;
}
} // namespace

TEST_CASE("Errors of one sound add in amplitude, of others in power, with 1.5 dB for chance", "[scene]")
{
    ErrorSum sum;
    const ErrorSum::Key a{0, 0.0, 0.0}, b{0, 1.0, 0.0}, c{1, 0.0, 0.0}, d{0, 0.0, 5.0};
    CHECK(sum.total() == 0.0);
    CHECK(sum.with(a, 4.0) == Approx(1.41 * 4.0));
    sum.add(a, 4.0);
    CHECK(sum.total() == Approx(1.41 * 4.0));
    CHECK(sum.with(a, 1.0) == Approx(1.41 * 9.0));
    for (const auto& other : {b, c, d})
        CHECK(sum.with(other, 1.0) == Approx(1.41 * 5.0));
    sum.add(a, 1.0);
    CHECK(sum.total() == Approx(1.41 * 9.0));
    sum.add(b, 16.0);
    CHECK(sum.total() == Approx(1.41 * 25.0));
    CHECK(sum.with(a, 1.0) == Approx(1.41 * (16.0 + 16.0)));
    sum.add(b, 0.0);
    CHECK(sum.total() == Approx(1.41 * 25.0));
    CHECK(errorInDecibels(1.0, 100.0) == Approx(-20.0));
    CHECK(errorInDecibels(0.001, 0.01) == Approx(-10.0));
    CHECK(errorInDecibels(0.0, 100.0) == -std::numeric_limits<double>::infinity());
    CHECK(errorInDecibels(1.0, 0.0) == -std::numeric_limits<double>::infinity());
    CHECK(errorInDecibels(-1.0, -1.0) == -std::numeric_limits<double>::infinity());
}

TEST_CASE("What can be left out comes in order of its cost, whole plays before bands", "[scene]")
{
    RenderPlan plan = culledPlan({2, 1, 2});
    const std::vector<PlayEnergy> energies = {costing(5.0, {3.0, 1.0}), costing(4.0, {3.0}), costing(4.0, {0.5, 9.0})};
    CHECK(candidatesOf(plan, energies) == "1 2 0 2.0 0.1 0.0 1.0 2.1 ");
    plan.plays[0].decoder.carriers = CarrierMode::centroid; // each of its bands counts
    CHECK(candidatesOf(plan, energies) == "1 2 0 2.0 1.0 2.1 ");
    plan.plays[0].decoder.carriers = CarrierMode::fixed;
    CHECK(candidatesOf(plan, energies) == "1 2 0 2.0 0.1 0.0 1.0 2.1 ");
    CHECK(candidatesOf(RenderPlan{}, {}).empty());
}

TEST_CASE("What is marked is taken out of a plan and the rest stays in its order", "[scene]")
{
    RenderPlan plan = culledPlan({2, 1, 3});
    removeMarked(plan, {false, true, false}, {{true, false}, {false}, {false, true, false}});
    REQUIRE(plan.plays.size() == 2);
    CHECK(plan.plays[0].play == 0);
    REQUIRE(plan.plays[0].clip.bands.size() == 1);
    CHECK(plan.plays[0].clip.bands[0].centreFrequency == 11.0);
    CHECK(plan.plays[1].play == 2);
    REQUIRE(plan.plays[1].clip.bands.size() == 2);
    CHECK(plan.plays[1].clip.bands[0].centreFrequency == 30.0);
    CHECK(plan.plays[1].clip.bands[1].centreFrequency == 32.0);
}

TEST_CASE("Plays and bands are left out as long as their errors together stay below the tolerance", "[scene]")
{
    const Scene scene = sceneOfPlays(3);
    const auto run = [&](const std::vector<PlayEnergy>& energies, double whole, double tolerance, RenderPlan& plan)
    {
        return leaveOutWeak(plan, scene, energies, whole, tolerance);
    };
    {
        // 1.41 times 1 + 3 is 5.64: below 5.7, above 5.6.
        for (const bool both : {false, true})
        {
            RenderPlan plan = culledPlan({1, 1, 1});
            const double error = run({costing(1.0, {1.0}), costing(3.0, {3.0}), costing(900.0, {900.0})},
                                     both ? 570.0 : 560.0, -20.0, plan);
            CHECK(error == Approx(1.41 * (both ? 4.0 : 1.0)));
            CHECK(plan.plays.size() == (both ? 1u : 2u));
            CHECK(leftOutOf(plan) ==
                  (both ? "plays[0] is too weak to be perceived; plays[1] is too weak to be perceived; "
                        : "plays[0] is too weak to be perceived; "));
            CHECK(plan.leftOut[0].error == Approx(10.0 * std::log10(1.0 / (both ? 570.0 : 560.0))));
        }
    }
    {
        // What is exactly as much as can be borne is left out, and an equaliser takes 0.3 of that.
        RenderPlan plan = culledPlan({0});
        plan.profile = Profile{};
        run({costing(1.0)}, 1.41, 0.0, plan);
        CHECK(plan.plays.empty());
        plan = culledPlan({0});
        plan.profile = Profile{};
        plan.profile->equalizer.pushBack({});
        run({costing(1.0)}, 1.41 * 1.4, 0.0, plan);
        CHECK(plan.plays.size() == 1);
        run({costing(1.0)}, 1.41 * 1.45, 0.0, plan);
        CHECK(plan.plays.empty());
    }
    {
        // Silence is always left out, single bands too, but no band of a play that is left out.
        RenderPlan plan = culledPlan({2, 2, 1});
        const double error =
            run({costing(9.0, {0.0, 8.0}), costing(0.0, {0.0, 0.0}), costing(7.0, {0.01})}, 1e-9, -60.0, plan);
        CHECK(error == 0.0);
        CHECK(leftOutOf(plan) == "plays[1] is silent; plays[0].bands[0] is silent; ");
        CHECK(plan.leftOut[0].error == -std::numeric_limits<double>::infinity());
        REQUIRE(plan.plays.size() == 2);
        REQUIRE(plan.plays[0].clip.bands.size() == 1);
        CHECK(plan.plays[0].clip.bands[0].centreFrequency == 11.0);
        CHECK(plan.plays[1].play == 2);
    }
    {
        // One clip twice at a time adds up in amplitude; at other times or pitches in power.
        for (int which = 0; which < 4; ++which)
        {
            Scene same = sceneOfPlays(2);
            same.plays[1].clip = which == 1 ? 1 : 0;
            same.plays[1].start = which == 2 ? 0.5 : 0.0;
            same.plays[1].transposition = which == 3 ? 0.5 : 0.0;
            RenderPlan plan = culledPlan({1, 1});
            const std::vector<PlayEnergy> energies = {costing(1.0, {1.0}), costing(1.0, {1.0})};
            const double error = leaveOutWeak(plan, same, energies, 100.0, -10.0);
            CHECK(error == Approx(1.41 * (which == 0 ? 4.0 : 2.0)));
        }
    }
    const LeftOut usual;
    CHECK(usual.error == 0.0);
    const RenderPlan plan;
    CHECK(plan.duration == 0.0);
    CHECK(plan.actuators == 1);
    CHECK_FALSE(plan.motor);
    CHECK_FALSE(usual.unplayable);
    CHECK(plan.culledError == 0.0);
    CHECK(plan.predictedError == 0.0);
    CHECK(PlannedPlay{}.play == 0);
    CHECK(PlannedPlay{}.start == 0.0);
}

TEST_CASE("Sections of the equaliser that are flat where the actuator plays are left out", "[scene]")
{
    const auto section = [](double frequency, double gain)
    {
        EqualizerSection one;
        one.frequency = frequency;
        one.gain = gain;
        one.q = 1.0;
        return one;
    };
    for (const double tolerance : {-10.0, -20.0, -40.0, -60.0, -120.0})
    {
        CAPTURE(tolerance);
        RenderPlan plan;
        plan.profile = Profile{};
        plan.profile->range = {50.0, 500.0, 60.0};
        plan.profile->equalizer.pushBack(section(100.0, 0.01));
        plan.profile->equalizer.pushBack(section(200.0, 6.0));
        plan.profile->equalizer.pushBack(section(15000.0, -0.5));
        plan.profile->equalizer.pushBack(section(300.0, 0.0));
        plan.profile->equalizer.pushBack(section(3.0, 3.0));
        plan.profile->equalizer.pushBack(section(250.0, 0.06));
        plan.profile->equalizer.pushBack(section(350.0, 0.12));
        const double error = leaveOutFlatSections(plan, tolerance, 48000.0);
        std::vector<double> all = {error, static_cast<double>(plan.profile->equalizer.size())};
        for (const LeftOut& item : plan.leftOut)
        {
            CHECK(item.reason == "is flat in the actuator's range");
            all.push_back(static_cast<double>(item.where.at(10) - '0'));
            all.push_back(item.error);
        }
        CHECK(error <= 0.3 * std::pow(10.0, tolerance / 10.0));
        checkPinned("synthesis/flat sections at " + std::to_string(std::lround(tolerance)) + " dB", all, 1e-5);
        if (!plan.leftOut.empty())
            CHECK(plan.leftOut[0].where.substr(0, 10) == "equalizer[");
    }
}
