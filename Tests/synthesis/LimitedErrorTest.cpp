#include "support/ActuatorOf.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/synthesis/LimitedError.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::detail;

namespace
{
PlayEnergy plainEnergy(const Clip& clip)
{
    PlayEnergy energy;
    energy.bands.assign(clip.bands.size(), 1.0);
    energy.gains.bands.assign(clip.bands.size(), 1.0);
    energy.gains.noise.assign(clip.noise.size(), 1.0);
    energy.gains.events = 1.0;
    return energy;
}

PlannedPlay playOf(const Clip& clip, double start, double stretch = 1.0)
{
    PlannedPlay planned;
    planned.clip = clip;
    planned.start = start;
    planned.decoder.stretch = stretch;
    planned.timeline.gains = {{{0.0, 1.0}}};
    return planned;
}

/// The largest of f over [from, to], sampled.
template <typename F>
double largestOf(double from, double to, F&& f)
{
    double largest = 0.0;
    for (int i = 0; i <= 1000; ++i)
        largest = std::max(largest, f(from + (to - from) * i / 1000.0));
    return largest;
}
} // namespace

TEST_CASE("Cells last 20 ms, longer where a scene would need more than five thousand", "[scene]")
{
    const TimeCells cells(1.01);
    CHECK(cells.length == 0.02);
    CHECK(cells.count == 51);
    CHECK(cells.at(-1.0) == 0);
    CHECK(cells.at(0.0199) == 0);
    CHECK(cells.at(0.0201) == 1);
    CHECK(cells.at(1.01) == 50);
    CHECK(cells.at(9.0) == 50);
    CHECK(cells.covering(0.0) == 1);
    CHECK(cells.covering(0.015) == 2); // begins in one, ends in the next
    CHECK(TimeCells(1000.0).length == 0.2);
    CHECK(TimeCells(1000.0).count == 5001);
}

TEST_CASE("The squares of a play are the largest of its curve in each cell and those that delays reach", "[scene]")
{
    Clip clip;
    clip.duration = 1.003; // no end and no step where cells meet
    clip.bands = {{80.0,
                   100.0,
                   120.0,
                   0,
                   {{0.1, 0.2}, {0.13, 0.9}, {0.307, 0.1}, {0.307, 0.7}, {0.62, 0.0}, {0.9, 0.0}, {0.95, 0.4}},
                   {}}};
    for (const double start : {0.0, 0.507})
        for (const double stretch : {1.0, 1.7})
            for (const double latest : {0.0, 0.005, 0.09})
            {
                CAPTURE(start, stretch, latest);
                PlannedPlay planned = playOf(clip, start, stretch);
                planned.decoder.gain = 0.5;
                if (latest > 0.0)
                    planned.timeline.delays = {{{0.0, 0.0}, {1.0, latest}}, {{0.0, 0.5 * latest}}};
                const PlayEnergy energy = plainEnergy(clip);
                const double duration = 2.05;
                const TimeCells cells(duration);
                REQUIRE(cells.length == 0.02);
                const PlaySquares play(planned, energy, duration, cells);
                const CellTrack track = play.ofBand(0, play.ofGain({{0.0, 3.0}}));
                const double end = std::min(duration, start + stretch * clip.duration);
                const auto square = [&](double time)
                {
                    // A step counts on both sides.
                    const double at = std::clamp((time - start) / stretch, 0.0, clip.duration);
                    const double a =
                        std::max(valueAt(clip.bands[0].amplitude, at), valueAt(clip.bands[0].amplitude, at - 1e-9)) *
                        0.5 * 3.0;
                    return time < start || time > end ? 0.0 : a * a;
                };
                // One cell for what rings, and as many as the longest delay covers.
                const auto reach = static_cast<std::size_t>(std::ceil(latest / 0.02)) + 1;
                CHECK(track.first == static_cast<std::size_t>(start / 0.02));
                for (std::size_t k = 0; k < cells.count; ++k)
                {
                    CAPTURE(k);
                    double wanted = 0.0;
                    for (std::size_t j = k - std::min(k, reach); j <= k; ++j)
                    {
                        const double from = std::max(start, static_cast<double>(j) * 0.02);
                        const double to = std::min(end, static_cast<double>(j + 1) * 0.02);
                        if (to > from)
                            wanted = std::max(wanted, largestOf(from, to, square));
                    }
                    const double found =
                        k >= track.first && k - track.first < track.values.size() ? track.values[k - track.first] : 0.0;
                    CHECK(found == Approx(wanted).epsilon(0.01).margin(1e-6));
                }
            }
}

TEST_CASE("An event counts where it plays in the scene, and as far as it rings and delays reach", "[scene]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.transients = {{0.25, 0.5, 0.5}, {0.75, 0.8, 0.5}};
    PlayEnergy energy = plainEnergy(clip);
    energy.gains.events = 0.5;
    const double duration = 3.0;
    const TimeCells cells(duration);
    const PlannedPlay planned = playOf(clip, 0.513, 2.0);
    const PlaySquares play(planned, energy, duration, cells);
    const CellTrack track = play.ofWhole(play.ofGain({{0.0, 4.0}}));
    const auto first = static_cast<std::size_t>((0.513 + 0.5) / 0.02);  // its cell,
    const auto second = static_cast<std::size_t>((0.513 + 1.5) / 0.02); // the next and one more
    for (std::size_t k = 0; k < cells.count; ++k)
    {
        CAPTURE(k);
        const double wanted = k >= first && k <= first + 2 ? 1.0 : k >= second && k <= second + 2 ? 2.56 : 0.0;
        const double found =
            k >= track.first && k - track.first < track.values.size() ? track.values[k - track.first] : 0.0;
        CHECK(found == Approx(wanted));
    }
    CHECK(play.peakRatio() == 1.0);
}

TEST_CASE("Squares of bands and noise add up, and the peak ratio is that of their number", "[scene]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{80.0, 100.0, 120.0, 0, {{0.0, 0.3}}, {}}, {180.0, 200.0, 220.0, 0, {{0.0, 0.4}}, {}}};
    clip.noise = {{50.0, 500.0, {{0.0, 0.2}}}};
    PlayEnergy energy = plainEnergy(clip);
    energy.gains.bands = {2.0, 1.0};
    const TimeCells cells(2.0);
    const PlannedPlay planned = playOf(clip, 0.0);
    {
        const PlaySquares play(planned, energy, 2.0, cells);
        // Amplitudes of sinusoids, RMS values of noise.
        CHECK(play.ofWhole(play.ofGain({{0.0, 1.0}})).values[10] == Approx(0.36 + 0.16 + 2.0 * 0.04));
        CHECK(play.peakRatio() == Approx(std::sqrt(2.0 + 8.0)));
    }
    // Levelled, the envelope tells.
    energy.levelled = true;
    PlannedPlay levelled = planned;
    levelled.clip.envelope = {{0.0, 0.5}};
    levelled.clip.transients = {{0.9, 0.0, 0.5}};
    const PlaySquares play(levelled, energy, 2.0, cells);
    CHECK(play.ofWhole(play.ofGain({{0.0, 1.0}})).values[10] == Approx(4.0 * 0.25 * PlayEnergy::fastBeats));
    CHECK(play.peakRatio() == Approx(std::sqrt(2.0 + 8.0 + 1.0)));
}

TEST_CASE("The memory of a limiter holds its highest level, then lets it go by 40 dB per second", "[scene]")
{
    const TimeCells cells(1.0);
    LimiterMemory memory(0.05, cells); // two and a half cells: 3 to 4 of them
    const std::vector<double> squares{0.5, 2.0, 1.0};
    const double decay = std::pow(10.0, -40.0 * 0.02 / 10.0);
    CHECK(memory.at(0, squares) == 0.5);
    for (std::size_t i = 1; i <= 5; ++i)
        CHECK(memory.at(i, squares) == 2.0);
    CHECK(memory.at(6, squares) == Approx(2.0 * decay));
    CHECK(memory.at(7, squares) == Approx(2.0 * decay * decay));
}

TEST_CASE("The limiter of a plain signal holds for 20 Hz, that of an actuator for its lowest tone", "[scene]")
{
    const LimiterModel plain = limiterModel(nullptr);
    CHECK(plain.perDrive == 1.0);
    CHECK(plain.spread == 1.0);
    CHECK(plain.hold == Approx(0.026));
    CHECK_FALSE(plain.soft);
    CHECK(plain.gain(1.0) == 1.0);
    CHECK(plain.gain(0.9) == 1.0);
    CHECK(plain.gain(4.0) == Approx(0.5));
    const LimiterModel usual;
    CHECK(usual.perDrive == 1.0);
    CHECK(usual.spread == 1.0);
    CHECK(usual.hold == 0.0);
    CHECK_FALSE(usual.soft);
    Profile profile = test::actuatorOf(Technology::lra, {100.0, 2.0}, {50.0, 400.0, 60.0});
    profile.drive.overdrive = 1.6;
    LimiterModel model = limiterModel(&profile);
    CHECK(model.spread == 1.0);
    CHECK(model.perDrive == Approx(1.0 / 1.6));
    CHECK(model.hold == Approx(0.011));
    CHECK(model.soft);
    CHECK(model.gain(0.79) == 1.0);
    CHECK(model.gain(1.0) == Approx(std::pow(10.0, -0.25 / 20.0))); // within the knee
    CHECK(model.gain(4.0) == Approx(0.5));
    // Travel and heat that some drive exceeds: the larger ratio counts.
    profile.drive.excursion = 1e-4;
    profile.drive.maxExcursion = 1e-4;
    const double travel = protectionNeeds(profile).worstExcursion / 1e-4;
    REQUIRE(travel > 1.5);
    CHECK(limiterModel(&profile).spread == Approx(travel));
    CHECK(limiterModel(&profile).perDrive == Approx(travel / 1.6));
    profile.drive.impedance = 8.0;
    profile.drive.maxVoltageRms = 4.0;
    profile.drive.maxPower = 1e-3;
    const double heat = std::sqrt(protectionNeeds(profile).worstPower / 1e-3);
    REQUIRE(heat > travel);
    CHECK(limiterModel(&profile).spread == Approx(heat));
    profile.drive.maxExcursion = 0.1;
    CHECK(limiterModel(&profile).spread == Approx(heat));
    profile.drive.maxPower = 100.0;
    CHECK(limiterModel(&profile).spread == 1.0);
}

TEST_CASE("A track keeps the largest value of each of its cells and adds others cell by cell", "[scene]")
{
    CellTrack track{3, {0.0, 1.0, 2.0}};
    track.include(2, 9.0);
    track.include(6, 9.0);
    track.include(3, 0.5);
    track.include(4, 0.5);
    track.include(5, 2.5);
    CHECK(track.values == std::vector<double>{0.5, 1.0, 2.5});
    track.add({3, {1.0, 2.0, 4.0}}, 0.5);
    CHECK(track.values == std::vector<double>{1.0, 2.0, 4.5});
    CHECK(CellTrack{}.first == 0);
    const TimeCells cells(0.0);
    CHECK(cells.count == 1);
    CHECK(cells.at(0.0) == 0);
    CHECK(cells.at(5.0) == 0);
    CHECK(TimeCells(100.0).length == 0.02);
    CHECK(TimeCells(101.0).length == Approx(0.0202));
    CHECK(TimeCells(101.0).count == 5001);
    CHECK(TimeCells(1.0).covering(0.02) == 2);
    CHECK(TimeCells(1.0).covering(0.021) == 3);
}

TEST_CASE("A limiter takes what its memory says, and errors spread where it moves", "[scene]")
{
    // A tone that is held at 2 for half of its second: the peak of one sinusoid is its amplitude.
    Clip clip;
    clip.duration = 0.5;
    clip.bands = {{90.0, 100.0, 110.0, 0, {{0.0, 2.0}}, {}}};
    RenderPlan plan;
    plan.duration = 2.0;
    plan.plays = {playOf(clip, 0.0)};
    plan.plays[0].decoder.carriers = CarrierMode::pitch;
    PlayEnergy energy = plainEnergy(clip);
    energy.least = 1.0;
    energy.most = 1.5;
    const std::vector<PlayEnergy> energies = {energy};
    LimitedScene limited(plan, energies, {1.0, 1.0, 0.03, false});
    REQUIRE(limited.limits());
    limited.limit(plan.plays[0], plan.duration, energy);
    // Squares of 4 in 25 cells and the one after the end, both of the crests 2 and the root of 2 see a peak of 2.
    CHECK(energy.least == Approx(0.25));
    // Of the spread: 0.5 * 0.02 s * 4 * a quarter in each of those cells, and what is held and let go after them.
    CHECK(energy.most > 1.5 * 0.25 + 0.01 * 26.0);
    checkPinned("synthesis/one tone behind a limiter", {energy.least, energy.most, energy.bands[0]});
    // Half of the drive is not limited at all.
    CHECK_FALSE(LimitedScene(plan, energies, {0.5, 1.0, 0.03, false}).limits());
    CHECK(LimitedScene(plan, energies, {0.501, 1.0, 0.03, false}).limits());
    CHECK(LimitedScene(plan, energies, {0.5, 1.0, 0.03, true}).limits()); // its knee begins below
    CHECK(LimitedScene::wholeScene == 2.0);
    CHECK_FALSE(LimitedScene(RenderPlan{}, {}, {}).limits());
}

TEST_CASE("Energies behind limiters of crowds, noise, events and delays are what they were", "[scene]")
{
    Clip tones;
    tones.duration = 0.613;
    for (int k = 0; k < 3; ++k)
        tones.bands.push_back(
            {50.0, 100.0 + 40.0 * k, 400.0, 0, {{0.0, 0.1 * k}, {0.2, 0.9}, {0.2, 0.3}, {0.5, 0.6}}, {}});
    Clip events;
    events.duration = 1.2;
    events.transients = {{0.1, 1.4, 0.5}, {0.5, 0.8, 0.5}, {1.19, 2.0, 0.5}};
    events.noise = {{100.0, 200.0, {{0.0, 0.1}, {1.0, 0.7}}}};
    Clip levelled = tones;
    levelled.envelope = {{0.0, 0.2}, {0.3, 1.5}, {0.6, 0.0}};
    RenderPlan plan;
    plan.duration = 1.507;
    plan.plays = {playOf(tones, 0.111, 1.3), playOf(events, 0.4), playOf(levelled, 0.5, 0.8), playOf(tones, 1.4)};
    plan.plays[0].timeline.gains = {{{0.0, 0.5}, {0.5, 2.0}}, {{0.0, 1.0}, {1.0, 0.0}}};
    plan.plays[0].timeline.delays = {{{0.0, 0.0}, {1.0, 0.07}}, {{0.0, 0.01}}};
    plan.plays[1].timeline.gains = {{{0.0, 1.0}}, {{0.7, 0.1}, {0.8, 3.0}}};
    plan.plays[2].decoder.gain = 1.7;
    std::vector<PlayEnergy> energies;
    for (const PlannedPlay& play : plan.plays)
    {
        PlayEnergy energy = plainEnergy(play.clip);
        energy.least = 0.5;
        energy.most = 0.7;
        energy.gains.events = 1.1;
        energy.levelled = !play.clip.envelope.empty();
        energy.bandErrors = energy.levelled ? 4.0 : 1.0;
        energies.push_back(energy);
    }
    int run = 0;
    for (const LimiterModel& model : {LimiterModel{1.0, 1.0, 0.026, false},
                                      {0.6, 1.5, 0.01, true},
                                      {2.5, 4.0, 0.1, true},
                                      {0.3, 1.0, 0.026, false}})
    {
        const LimitedScene limited(plan, energies, model);
        std::vector<double> all = {limited.limits() ? 1.0 : 0.0};
        for (std::size_t i = 0; i < plan.plays.size(); ++i)
        {
            PlayEnergy energy = energies[i];
            limited.limit(plan.plays[i], plan.duration, energy);
            all.push_back(energy.least);
            all.push_back(energy.most);
            all.insert(all.end(), energy.bands.begin(), energy.bands.end());
        }
        REQUIRE(all.size() <= 24);
        checkPinned("synthesis/energies behind limiter " + std::to_string(++run), all);
    }
    // A play that begins at the end or later, or has nothing, keeps what it has.
    PlannedPlay late = playOf(tones, 1.6);
    PlayEnergy energy = energies[0];
    LimitedScene(plan, energies, {1.0, 1.0, 0.026, false}).limit(late, plan.duration, energy);
    CHECK(energy.least == 0.5);
    CHECK(energy.most == 0.7);
    CHECK(energy.bands == energies[0].bands);
}

TEST_CASE("Squares begin, end and step where a curve does, within its cells", "[scene]")
{
    // Ends where cells meet, points before and after the play, and a curve of one point.
    for (const auto& [name, curve] :
         {std::pair<std::string, Curve>{"points outside", {{-0.05, 0.2}, {0.03, 0.9}, {0.5, 0.1}}},
          {"one point", {{0.05, 0.7}}},
          {"meeting cells", {{0.02, 0.3}, {0.04, 0.8}, {0.04, 0.1}, {0.08, 0.5}, {0.1, 0.0}}},
          {"falling and rising", {{0.0, 1.0}, {0.031, -1.0}, {0.057, 0.5}}}})
        for (const double start : {0.0, 0.013, 0.2003})
        {
            Clip clip;
            clip.duration = 0.1;
            clip.bands = {{90.0, 100.0, 110.0, 0, curve, {}}};
            PlannedPlay planned = playOf(clip, start);
            const PlayEnergy energy = plainEnergy(clip);
            const TimeCells cells(0.25);
            const PlaySquares play(planned, energy, 0.25, cells);
            const CellTrack track = play.ofBand(0, play.ofGain({{0.05, 1.0}, {0.06, 0.5}}));
            std::vector<double> all = {static_cast<double>(track.first)};
            all.insert(all.end(), track.values.begin(), track.values.end());
            checkPinned("synthesis/squares of " + name + " from " + std::to_string(std::lround(1000.0 * start)) + " ms",
                        all);
        }
}
