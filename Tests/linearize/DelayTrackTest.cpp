#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/Random.h>
#include <pacini/linearize/DelayTrack.h>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace pacini;

namespace
{
constexpr double trackRate = 4000.0;

/// `sweep` at `start` s of a recording of `seconds`, heard through two damped resonances, one for each channel.
RecordedChannels trackRecording(const ExponentialSweep& sweep, const std::vector<double>& starts, double seconds,
                                double noise = 0.0)
{
    Random random(17);
    RecordedChannels recording{trackRate, {}};
    for (const double ring : {0.0, 0.6})
    {
        std::vector<double> x(static_cast<std::size_t>(seconds * trackRate));
        double before = 0.0, last = 0.0;
        for (std::size_t n = 0; n < x.size(); ++n)
        {
            double in = noise * random.uniform(-1.0, 1.0);
            for (const double start : starts)
                in += sweep.at(static_cast<double>(n) / trackRate - start);
            const double out = in + ring * (1.4 * last - 0.8 * before);
            before = last;
            last = out;
            x[n] = out;
        }
        recording.channels.push_back(x);
    }
    return recording;
}

ArrivedSweep trackArrived(const RecordedChannels& recording, const ExponentialSweep& sweep, double playTime,
                          double expected)
{
    return arrivedSweep(recording, sweep, playTime, expected, 0.05, 0.03, 0.2);
}
} // namespace

TEST_CASE("A sweep is found at its strongest moment and cut around it", "[linearize]")
{
    const ExponentialSweep sweep(20.0, 1000.0, 1.0, 0.05, 0.02);
    for (const double start : {0.7, 0.71025, 0.66, 0.745})
    {
        CAPTURE(start);
        const auto arrived = trackArrived(trackRecording(sweep, {start}, 3.0), sweep, 0.5, 0.7);
        CHECK(arrived.playTime == 0.5);
        CHECK(arrived.arrival == Approx(start).margin(1.1 / trackRate));
        REQUIRE(arrived.channels.size() == 2);
        CHECK(arrived.channels[0].samples.size() == arrived.channels[1].samples.size());
        CHECK(arrived.channels[0].samples.size() == Approx(0.23 * trackRate).margin(2.0));
        CHECK(arrived.channels[0].firstLag == Approx(-0.03 * trackRate).margin(1.0));
        // the strongest of both channels together is at lag 0
        std::size_t best = 0;
        double most = 0.0;
        for (std::size_t i = 0; i < arrived.channels[0].samples.size(); ++i)
        {
            const double power =
                std::pow(arrived.channels[0].samples[i], 2) + std::pow(arrived.channels[1].samples[i], 2);
            if (power > most)
            {
                most = power;
                best = i;
            }
        }
        CHECK(static_cast<std::ptrdiff_t>(best) + arrived.channels[0].firstLag == 0);
    }
    // beyond the tolerance its edge is as near as it comes
    const auto far = trackArrived(trackRecording(sweep, {0.9}, 3.0), sweep, 0.5, 0.7);
    CHECK(far.arrival <= 0.7501);
    CHECK(ArrivedSweep{}.playTime == 0.0);
    CHECK(ArrivedSweep{}.arrival == 0.0);
    CHECK(DelayPoint{}.time == 0.0);
    CHECK(DelayPoint{}.sinceThen == 0.0);
    CHECK(DelayPoint{}.delay == 0.0);
    CHECK(DelayPoint{}.deviation == 0.0);
    const auto pinned = trackArrived(trackRecording(sweep, {0.7003}, 3.0, 0.1), sweep, 0.5, 0.69);
    checkPinned("linearize/arrived sweep", pinned.channels[0].samples, 1e-6);
    checkPinned("linearize/arrived sweep, second channel", pinned.channels[1].samples, 1e-6);
}

TEST_CASE("The delay of every band is that of the sweep, to a fraction of a frame", "[linearize]")
{
    const ExponentialSweep sweep(20.0, 1000.0, 1.0, 0.05, 0.02);
    // played 1.5 s apart, heard 0.3127 ms later than that
    for (const double late : {0.0, 0.0003127, -0.0041, 0.02})
    {
        CAPTURE(late);
        const auto recording = trackRecording(sweep, {0.7, 2.2 + late}, 4.0);
        const auto reference = trackArrived(recording, sweep, 0.5, 0.7);
        const auto second = trackArrived(recording, sweep, 2.0, 2.2);
        DelayTrack track(reference, trackRate, second.channels[0].samples.size());
        const auto points = track.compare(second, sweep, sweep, 0.0, 25.0, 801.0);
        REQUIRE(points.size() == 61); // five octaves of twelve and the first
        double f = 25.0;
        for (const DelayPoint& point : points)
        {
            CHECK(point.time == Approx(2.0 + sweep.timeOf(f)));
            CHECK(point.sinceThen == Approx(1.5));
            CHECK(point.delay == Approx(late).margin(2e-5));
            CHECK(point.deviation > 0.0);
            CHECK(point.deviation < 2e-3);
            f *= std::exp2(1.0 / 12.0);
        }
    }
}

TEST_CASE("A drift that the deconvolution took out is put back into the delays", "[linearize]")
{
    const ExponentialSweep sweep(20.0, 1000.0, 1.0, 0.05, 0.02);
    const ExponentialSweep marker(20.0, 1000.0, 0.25, 0.005, 0.005);
    const double drift = 2e-3;
    std::vector<double> values;
    std::vector<double> deviations;
    for (const double noise : {0.0, 0.3})
    {
        // the marker at 0.4 s, the sweep at 1.2 s of the playback
        auto recording = trackRecording(marker.byClock(drift), {0.9}, 4.0, noise);
        const auto other = trackRecording(sweep.byClock(drift), {0.9 + 0.8 * (1.0 + drift)}, 4.0);
        for (std::size_t c = 0; c < 2; ++c)
            for (std::size_t n = 0; n < recording.channels[c].size(); ++n)
                recording.channels[c][n] += other.channels[c][n];
        const auto reference = trackArrived(recording, marker.byClock(drift), 0.4, 0.9);
        const auto second = trackArrived(recording, sweep.byClock(drift), 1.2, 1.7);
        DelayTrack track(reference, trackRate, second.channels[0].samples.size());
        for (const DelayPoint& point : track.compare(second, sweep, marker, drift, 30.0, 700.0))
        {
            values.insert(values.end(), {point.time, point.sinceThen, 1000.0 * point.delay});
            deviations.push_back(std::log(point.deviation));
            if (noise == 0.0)
                CHECK(point.delay == Approx(drift * point.sinceThen).margin(2e-4));
        }
    }
    checkPinned("linearize/delays", values, 1e-5);
    checkPinned("linearize/deviations of delays", deviations, 1e-5);
}

TEST_CASE("Bands that do not resemble the reference are left out", "[linearize]")
{
    const ExponentialSweep sweep(20.0, 1000.0, 1.0, 0.05, 0.02);
    const auto recording = trackRecording(sweep, {0.7}, 4.0, 1e-3);
    const auto reference = trackArrived(recording, sweep, 0.5, 0.7);
    const auto nothing = trackArrived(recording, sweep, 2.0, 2.4);
    DelayTrack track(reference, trackRate, nothing.channels[0].samples.size());
    CHECK(track.compare(nothing, sweep, sweep, 0.0, 25.0, 800.0).size() < 40);
    auto silent = nothing;
    for (auto& channel : silent.channels)
        channel.samples.assign(channel.samples.size(), 0.0);
    CHECK(track.compare(silent, sweep, sweep, 0.0, 25.0, 800.0).empty());
    CHECK(track.compare(reference, sweep, sweep, 0.0, 25.0, 24.9).empty());
    CHECK(track.compare(reference, sweep, sweep, 0.0, 25.0, 25.0).size() == 1);
    std::vector<double> values;
    for (const DelayPoint& point : track.compare(nothing, sweep, sweep, 0.0, 25.0, 800.0))
        values.push_back(point.time);
    checkPinned("linearize/bands that resemble the reference", values, 1e-6);
}

TEST_CASE("The time of a step is where the frequencies begin to be late", "[linearize]")
{
    const ExponentialSweep sweep(20.0, 1000.0, 2.0, 0.05, 0.02);
    const double step = -0.006;
    std::vector<double> values;
    for (const double at : {0.6, 1.1, 1.5})
    {
        CAPTURE(at);
        // the second sweep, at 3 s, loses 6 ms when `at` of it has been played
        auto recording = trackRecording(sweep, {0.7}, 8.0, 1e-4);
        for (auto& channel : recording.channels)
            for (std::size_t n = 0; n < channel.size(); ++n)
            {
                const double t = static_cast<double>(n) / trackRate - 3.2;
                channel[n] += t < at ? sweep.at(t) : sweep.at(t - step);
            }
        const auto reference = trackArrived(recording, sweep, 0.5, 0.7);
        const auto second = trackArrived(recording, sweep, 3.0, 3.2);
        DelayTrack track(reference, trackRate, second.channels[0].samples.size());
        const double found = track.stepTime(second, sweep, 0.0, 0.0, step, 3.2, 4.9);
        CHECK(found == Approx(3.0 + at).margin(0.08));
        values.push_back(found);
        values.push_back(track.stepTime(second, sweep, 1e-4, 1e-4, step, 3.0 + at - 0.2, 3.0 + at + 0.2));
        CHECK(track.stepTime(second, sweep, 0.0, 0.0, step, 3.0 + at + 0.3, 3.0 + at + 0.5) ==
              Approx(3.0 + at + 0.3).margin(0.05)); // it is before all of these
    }
    checkPinned("linearize/step times", values, 1e-6);
}
