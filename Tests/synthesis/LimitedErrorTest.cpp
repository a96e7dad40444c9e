#include "support/Catch.h"

#include <pacini/synthesis/LimitedError.h>

#include <algorithm>
#include <cmath>
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
