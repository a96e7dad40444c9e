#include "linearize/DroppedFrames.h"
#include "linearize/QuickSweep.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/linearize/SimulatedRig.h>
#include <pacini/linearize/SweepTiming.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
SweepParams timedSweep()
{
    SweepParams params = quickSweep(1.0, 0.4, {-6.0, -16.0});
    params.markerDuration = 0.25;
    return params;
}

RigParams timedRig()
{
    RigParams rig = quickRig(2.0, 1e-5);
    rig.driftPpm = 120.0;
    return rig;
}

RecordedChannels timedRecording(const SweepParams& params, const RigParams& rig)
{
    RecordedChannels recording{rig.sampleRate, {}};
    for (const auto& channel : recordOnRig(makeSweepSignal(params).value(), rig))
        recording.channels.emplace_back(channel.begin(), channel.end());
    return recording;
}

/// The timing of a recording of one channel at 4 kHz.
SweepTiming timingOf(const std::vector<float>& channel, const SweepParams& params)
{
    RecordedChannels recording{4000.0, {}};
    recording.channels.emplace_back(channel.begin(), channel.end());
    const auto schedule = makeSweepSchedule(params);
    return timeSweeps(recording, params, schedule, locateSweeps(recording, schedule, 4000.0, measuringSweep(params)));
}

std::vector<double> timingValues(const SweepTiming& timing)
{
    std::vector<double> values{timing.start, 1e4 * timing.drift, timing.driftKnown ? 1.0 : 0.0,
                               static_cast<double>(timing.steps.size())};
    for (const DelayStep& step : timing.steps)
    {
        values.push_back(step.time);
        values.push_back(100.0 * step.seconds);
    }
    return values;
}
} // namespace

TEST_CASE("Sweeps are located to the grid, and stand out of the rest", "[linearize]")
{
    const auto params = timedSweep();
    const auto schedule = makeSweepSchedule(params);
    auto rig = timedRig();
    std::vector<double> values;
    for (const double latency : {0.01, 0.5, -0.3})
    {
        rig.latency = latency;
        const auto position = locateSweeps(timedRecording(params, rig), schedule, 4000.0, measuringSweep(params));
        CHECK(position.start == Approx(latency).margin(0.011));
        CHECK(position.contrast > 100.0);
        CHECK(position.focus > 0.5); // markers and the other sweep are near
        values.insert(values.end(), {position.start, std::log(position.contrast), position.focus});
    }
    checkPinned("linearize/positions", values, 1e-5);
    CHECK(SweepPosition{}.start == 0.0);
    CHECK(SweepPosition{}.contrast == 0.0);
    CHECK(SweepPosition{}.focus == 0.0);
}

TEST_CASE("Positions in noise, of other orders of levels, and of several channels are those that they were",
          "[linearize]")
{
    std::vector<double> values;
    const auto add = [&](const SweepParams& params, const RecordedChannels& recording, double stretch)
    {
        const auto position = locateSweeps(recording, makeSweepSchedule(params), params.sampleRate,
                                           measuringSweep(params).byClock(stretch - 1.0), stretch);
        values.insert(values.end(), {position.start, std::log(position.contrast), position.focus});
    };
    auto params = timedSweep();
    auto rig = timedRig();
    rig.noiseDensity = 0.004;
    add(params, timedRecording(params, rig), 1.0);
    params.levels = {-20.0, -3.0, -9.0};
    rig = timedRig();
    rig.driftPpm = 4000.0;
    add(params, timedRecording(params, rig), 1.0);
    auto recording = timedRecording(params, rig);
    recording.channels.push_back(std::vector<double>(recording.frames(), 0.25)); // never changes
    recording.channels.push_back(recording.channels[0]);
    Random random(3);
    for (double& v : recording.channels[2])
        v = 0.2 * v + random.uniform(-0.2, 0.2);
    add(params, recording, 1.0);
    add(params, recording, 1.004);
    params.markerDuration = 0.0;
    params.levels = {-10.0};
    add(params, timedRecording(params, timedRig()), 1.0);
    auto rings = timedRig();
    rings.body = RigParams{}.body;
    rings.range = 50.0;
    add(params, timedRecording(params, rings), 1.0);
    checkPinned("linearize/positions in noise", values, 1e-4);
}

TEST_CASE("The strength of arrivals is highest where the sweeps are", "[linearize]")
{
    auto params = timedSweep();
    params.levels = {-6.0};
    params.markerDuration = 0.0;
    const auto recording = timedRecording(params, timedRig());
    const auto arrivals = detail::arrivalStrength(recording, measuringSweep(params));
    CHECK(arrivals.channels == 1);
    CHECK(arrivals.first == Approx(-1.0)); // a sweep before the recording
    CHECK(arrivals.strength.size() == static_cast<std::size_t>((1.0 + recording.seconds()) * 1000.0));
    const auto highest = std::max_element(arrivals.strength.begin(), arrivals.strength.end());
    const double at = arrivals.first + 0.001 * static_cast<double>(highest - arrivals.strength.begin());
    CHECK(at == Approx(0.4 + 0.0123).margin(0.012));
    checkPinned("linearize/strength of arrivals", arrivals.strength, 1e-4);
    const RecordedChannels constant{4000.0, {std::vector<double>(9000, 0.3)}};
    CHECK(detail::arrivalStrength(constant, measuringSweep(params)).channels == 0);
    CHECK(detail::ArrivalStrength{}.first == 0.0);
    CHECK(detail::ArrivalStrength{}.channels == 0);
    RecordedChannels faint{4000.0, {std::vector<double>(9000, 0.3)}};
    faint.channels[0][5000] += 2e-9;
    CHECK(detail::arrivalStrength(faint, measuringSweep(params)).channels == 1);
    faint.channels[0][5000] = 0.3 + 0.5e-9;
    CHECK(detail::arrivalStrength(faint, measuringSweep(params)).channels == 0);
}

TEST_CASE("The largest of a range is that of the tens of values around it", "[linearize]")
{
    for (const std::size_t count : {1u, 9u, 10u, 11u, 95u, 160u, 321u})
    {
        std::vector<double> values;
        for (std::size_t i = 0; i < count; ++i)
            values.push_back(static_cast<double>((i * 7919) % 1009));
        const detail::RangeMaximum maximum(values);
        for (std::size_t first = 0; first < count + 12; first += 3)
            for (std::size_t last = first; last < count + 25; last += 7)
            {
                double expected = 0.0;
                for (std::size_t i = first / 10 * 10; i < std::min(count, last / 10 * 10 + 10); ++i)
                    expected = std::max(expected, values[i]);
                CAPTURE(count, first, last);
                REQUIRE(maximum.over(first, last) == expected);
            }
        CHECK(maximum.over(5, 4) == 0.0);
    }
}

TEST_CASE("A recording at another rate than it says is told by how its sweeps stand out", "[linearize]")
{
    SweepParams params = timedSweep();
    params.sampleRate = 8000.0;
    params.levels = {-6.0};
    auto rig = timedRig();
    rig.sampleRate = 8000.0;
    rig.driftPpm = 0.0;
    auto recording = timedRecording(params, rig);
    const auto schedule = makeSweepSchedule(params);
    const auto likelier = [&](double stated)
    {
        recording.rate = stated;
        const auto position = locateSweeps(recording, schedule, 8000.0, measuringSweep(params));
        return likelierRate(recording, schedule, params, stated, position);
    };
    CHECK(widestDrift == 0.005);
    // four times as much is asked for
    RecordedChannels quick = recording;
    quick.rate = 8820.0;
    const double stretch = 8000.0 / 8820.0;
    const double most =
        locateSweeps(quick, schedule, 8000.0, measuringSweep(params).byClock(stretch - 1.0), stretch).contrast;
    const auto against = [&](double contrast)
    {
        return likelierRate(quick, schedule, params, 8820.0, SweepPosition{0.0, contrast, 1.0});
    };
    CHECK(against(most / 4.2).value() == 8000.0);
    CHECK_FALSE(against(most / 3.8).has_value());
    CHECK(likelier(8820.0).value() == 8000.0);
    CHECK_FALSE(likelier(8000.0).has_value());
    recording = timedRecording(params, rig);
    // the other usual rates, in the ratios that they have
    for (const double rate : {16000.0, 22050.0, 32000.0, 44100.0, 48000.0, 88200.0, 96000.0, 176400.0, 192000.0})
    {
        // 8000 frames per second, said to be at `stated`, of a recorder whose rate is `rate`
        const double stated = rate * 1.25;
        RecordedChannels coarse = recording;
        coarse.rate = 8000.0 * stated / rate;
        const auto position = locateSweeps(coarse, schedule, 8000.0, measuringSweep(params));
        const auto found = likelierRate(coarse, schedule, params, stated, position);
        CAPTURE(rate);
        REQUIRE(found.has_value());
        CHECK(*found == rate);
    }
}

TEST_CASE("Arrival times are those of the rig, to a fraction of a frame", "[linearize]")
{
    auto params = timedSweep();
    const auto timingOf = [&](const RecordedChannels& recording)
    {
        const auto schedule = makeSweepSchedule(params);
        return timeSweeps(recording, params, schedule,
                          locateSweeps(recording, schedule, params.sampleRate, measuringSweep(params)));
    };
    auto rig = timedRig();
    std::vector<double> values;
    const auto add = [&](const SweepTiming& timing)
    {
        for (const double v : timingValues(timing))
            values.push_back(v);
    };
    for (const double ppm : {-900.0, 0.0, 120.0, 2000.0})
    {
        CAPTURE(ppm);
        rig.driftPpm = ppm;
        const auto timing = timingOf(timedRecording(params, rig));
        CHECK(timing.driftKnown);
        CHECK(1e6 * timing.drift == Approx(ppm).margin(3.0));
        CHECK(timing.start == Approx(rig.latency * (1.0 + 1e-6 * ppm)).margin(2e-4));
        CHECK(timing.steps.empty());
        add(timing);
    }
    // without markers, two repeats
    params.markerDuration = 0.0;
    params.repeats = 2;
    params.levels = {-9.0};
    rig.driftPpm = 300.0;
    add(timingOf(timedRecording(params, rig)));
    CHECK(timingOf(timedRecording(params, rig)).driftKnown);
    // and a single sweep, which tells nothing of the clocks
    params.repeats = 1;
    const auto single = timingOf(timedRecording(params, rig));
    CHECK_FALSE(single.driftKnown);
    CHECK(single.drift == 0.0);
    add(single);
    // a body, which rings, and noise
    params = timedSweep();
    rig.body = RigParams{}.body;
    rig.range = 50.0;
    rig.noiseDensity = 0.002;
    add(timingOf(timedRecording(params, rig)));
    params.duration = 2.5;
    params.pause = 0.2;
    add(timingOf(timedRecording(params, rig)));
    checkPinned("linearize/timing", values, 1e-4);
}

TEST_CASE("Frames that are missing are found where they got lost", "[linearize]")
{
    auto params = timedSweep();
    params.duration = 3.0;
    params.levels = {-6.0};
    auto rig = timedRig();
    const auto signal = makeSweepSignal(params).value();
    std::vector<double> values;
    for (const auto& [frame, lost] :
         {std::pair(std::size_t(10000), std::size_t(12)), std::pair(std::size_t(7000), std::size_t(100))})
    {
        CAPTURE(frame, lost);
        auto channels = recordOnRig(signal, rig);
        drop(channels, frame, lost);
        const auto timing = timingOf(channels[0], params);
        REQUIRE(timing.steps.size() == 1);
        CHECK(timing.steps[0].seconds == Approx(-static_cast<double>(lost) / 4000.0).margin(1e-4));
        CHECK(timing.steps[0].time == Approx(static_cast<double>(frame) / 4000.0 - rig.latency).margin(0.1));
        for (const double v : timingValues(timing))
            values.push_back(v);
    }
    checkPinned("linearize/timing of lost frames", values, 1e-3);
    // the second of two sweeps, which lasts from 4.45 to 7.45 s
    params.levels = {-6.0, -8.0};
    auto channels = recordOnRig(makeSweepSignal(params).value(), rig);
    drop(channels, 23000, 60);
    const auto timing = timingOf(channels[0], params);
    REQUIRE(timing.steps.size() == 1);
    CHECK(timing.steps[0].seconds == Approx(-0.015).margin(1e-4));
    CHECK(timing.steps[0].time == Approx(5.75 - rig.latency).margin(0.1));
    checkPinned("linearize/timing of frames lost in the second sweep", timingValues(timing), 1e-3);
}

TEST_CASE("A sweep is heard by the recorder's clock and without what it lost", "[linearize]")
{
    const ExponentialSweep sweep(20.0, 1200.0, 1.0, 0.05, 0.02);
    SweepTiming timing;
    CHECK(timing.start == 0.0);
    CHECK(timing.drift == 0.0);
    CHECK_FALSE(timing.driftKnown);
    timing.start = 0.25;
    timing.drift = 1e-3;
    timing.steps = {{2.5, -0.01}, {2.8, 0.02}};
    const auto heard = heardSweep(sweep, 2.0, timing, 4000.0, 9000, 4500);
    REQUIRE(heard.size() == 4500);
    for (std::size_t n = 0; n < heard.size(); n += 7)
    {
        const double time = static_cast<double>(9000 + n) / 4000.0;
        CHECK(heard[n] == sweep.at(timing.playTime(time) - 2.0));
    }
    // without steps the inverse of arrival()
    timing.steps.clear();
    CHECK(heardSweep(sweep, 2.0, timing, 4000.0, -3, 10) == std::vector<double>(10, 0.0));
    const double at = timing.arrival(2.3);
    const auto first = static_cast<std::ptrdiff_t>(std::floor(at * 4000.0));
    CHECK(heardSweep(sweep, 2.0, timing, 4000.0, first, 1)[0] ==
          Approx(sweep.at((static_cast<double>(first) / 4000.0 - 0.25) / 1.001 - 2.0)));
    // a step counts from its own time on, seen from either side
    timing.steps = {{3.0, -0.1}};
    for (const double played : {2.5, 2.89, 3.0, 3.2})
        CHECK(timing.playTime(timing.arrival(played)) == Approx(played));
}

TEST_CASE("Nothing is to be heard before the first sweep and in the second half of each pause", "[linearize]")
{
    SweepParams params = timedSweep();
    SweepTiming timing;
    timing.start = 0.5;
    timing.drift = 0.001;
    const auto quiet = quietTimes(params, makeSweepSchedule(params), timing, 5.0);
    // pause 0.4, marker 0.25, pause, sweep 1, pause, sweep 1, pause, marker 0.25, pause
    const double starts[] = {0.4, 1.05, 2.45, 3.85};
    const double ends[] = {0.65, 2.05, 3.45, 4.1};
    REQUIRE(quiet.size() == 5);
    CHECK(quiet[0].first == 0.0);
    for (std::size_t i = 0; i < 4; ++i)
    {
        CHECK(quiet[i].second == Approx(0.5 + 1.001 * starts[i] - 0.03));
        CHECK(quiet[i + 1].first == Approx(0.5 + 1.001 * ends[i] + 0.2));
    }
    CHECK(quiet[4].second == 5.0); // 0.5 + 4.104 + 0.4 is beyond the end
    const auto longer = quietTimes(params, makeSweepSchedule(params), timing, 50.0);
    CHECK(longer[4].second == Approx(0.5 + 1.001 * 4.1 + 0.4));
    const auto cut = quietTimes(params, makeSweepSchedule(params), timing, 2.0);
    CHECK(cut[4].first == 2.0);
    CHECK(cut[4].second == 2.0);
    timing.start = -0.9;
    const auto late = quietTimes(params, makeSweepSchedule(params), timing, 5.0);
    CHECK(late[0] == std::pair(0.0, 0.0));
    CHECK(late[1].first == 0.0);
    params.markerDuration = 0.0;
    CHECK(quietTimes(params, makeSweepSchedule(params), timing, 5.0).size() == 3);
}
