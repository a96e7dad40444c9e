#include "devices/RumblePlayer.h"

#include "devices/InstantClock.h"
#include "devices/SonyReports.h"
#include "devices/SteadyClock.h"
#include "devices/WaveformDevice.h"
#include "support/Catch.h"
#include "support/ReportList.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
constexpr ControllerModel joyCon{ControllerHaptics::hdRumble, Transport::bluetooth};

// Silence, but for a tone between `start` and `end`.
Clip toneClip(double duration, double start, double end)
{
    Clip clip;
    clip.duration = duration;
    clip.bands.push_back({150.0, 160.0, 250.0, 0, {{start, 0.0}, {start, 0.5}, {end, 0.5}, {end, 0.0}}, {}});
    return clip;
}

ClipRumble rumbleOf(const Clip& clip, const ControllerModel& model, bool loop = false)
{
    return ClipRumble(clip, {Seconds(0.0), Seconds(clip.duration), loop}, 0_dB, model);
}

using test::ReportList;
using test::SentReport;
using Played = test::PlayedReports;

bool isNeutral(const Report& report)
{
    const auto bytes = report.content();
    return bytes.size() == 10 && std::equal(neutralRumble.begin(), neutralRumble.end(), bytes.begin() + 2) &&
           std::equal(neutralRumble.begin(), neutralRumble.end(), bytes.begin() + 6);
}

int counterOf(const Report& report)
{
    return std::to_integer<int>(report.content()[1]);
}
} // namespace

TEST_CASE("HD rumble is enabled, then sent every 15 ms to the end, then silenced twice", "[devices]")
{
    const Played played(joyCon, toneClip(1.0, 0.0, 1.0));
    REQUIRE(played.result);
    const auto& sent = played.sink.sent;
    REQUIRE(sent.size() > 70);
    CHECK(sent[0].report == Report(switchEnableRumbleReport(0, true)));
    for (std::size_t i = 1; i + 2 < sent.size(); ++i)
    {
        CAPTURE(i);
        CHECK(sent[i].time == Approx(0.015 * static_cast<double>(i)));
        CHECK(counterOf(sent[i].report) == static_cast<int>(i % 16));
        CHECK_FALSE(isNeutral(sent[i].report));
    }
    for (std::size_t i = sent.size() - 2; i < sent.size(); ++i)
        CHECK(isNeutral(sent[i].report));
    CHECK(sent[sent.size() - 2].time == Approx(sent[sent.size() - 3].time + 0.015));
    CHECK(played.result->sent == static_cast<std::int64_t>(sent.size()));
    CHECK(played.result->leftOut == 0);
    CHECK(played.result->latest.value < 1e-9);
}

TEST_CASE("A Pro Controller on a cable is asked to listen first", "[devices]")
{
    const Played played({ControllerHaptics::hdRumble, Transport::usb}, toneClip(0.1, 0.0, 0.1));
    const auto& sent = played.sink.sent;
    CHECK(sent[0].report == Report(std::array{std::byte{0x80}, std::byte{0x02}}));
    CHECK(sent[1].report == Report(std::array{std::byte{0x80}, std::byte{0x04}}));
    CHECK(sent[2].report == Report(switchEnableRumbleReport(2, true)));
}

TEST_CASE("Silence is sent for 300 ms and then no more, until something sounds", "[devices]")
{
    const Played played(joyCon, toneClip(60.0, 59.0, 59.1));
    const auto& sent = played.sink.sent;
    std::vector<double> times;
    for (const SentReport& packet : sent)
        times.push_back(packet.time - 0.015); // the start is after the enabling
    const auto pause = std::adjacent_find(times.begin(), times.end(), [](double a, double b) { return b - a > 0.02; });
    REQUIRE(pause != times.end());
    CHECK(*pause == Approx(0.300));
    CHECK(pause[1] == Approx(59.0).margin(0.015));
    CHECK(times.size() < 70);
    for (std::size_t i = 1; i < sent.size(); ++i)
        CHECK(counterOf(sent[i].report) == static_cast<int>(i % 16)); // also after what was not sent
}

TEST_CASE("Motors are told of changes and reminded twice a second", "[devices]")
{
    const ControllerModel xbox{ControllerHaptics::xbox, Transport::bluetooth};
    Clip clip = toneClip(2.0, 0.0, 2.0);
    for (Breakpoint& point : clip.bands[0].amplitude)
        point.value *= 0.8; // 0.4, which is 56 of 100, and no step beside it
    const Played played(xbox, clip);
    std::vector<double> strong;
    std::vector<double> times;
    for (const SentReport& packet : played.sink.sent)
    {
        strong.push_back(std::to_integer<int>(packet.report.content()[4]));
        times.push_back(packet.time);
    }
    REQUIRE(strong == std::vector<double>{56, 56, 56, 56, 0, 0, 0});
    CHECK(times[1] - times[0] == Approx(0.512)); // the first packet of 16 ms after half a second
    CHECK(times[3] - times[0] == Approx(1.536));
    CHECK(times[4] == Approx(2.0).margin(0.033));
}

TEST_CASE("Events of waveforms that follow each other are each triggered, and the device is stopped in the end",
          "[devices]")
{
    Clip clip = toneClip(0.5, 0.3, 0.4);
    clip.transients = {{0.1, 1.0, 1.0}, {0.12, 1.0, 1.0}, {0.14, 1.0, 1.0}};
    const Played played({ControllerHaptics::waveforms, Transport::usb, standardTrigger()}, clip);
    std::vector<std::array<int, 2>> told; // ms, ordinal
    for (const SentReport& packet : played.sink.sent)
    {
        const auto content = packet.report.content();
        told.push_back({static_cast<int>(std::lround(1e3 * packet.time)), std::to_integer<int>(content[1])});
        if (content[1] == std::byte{3})
            CHECK(std::to_integer<int>(content[2]) > 45);
    }
    told.erase(
        std::unique(told.begin(), told.end(), [](const auto& a, const auto& b) { return a[1] == 5 && b[1] == 5; }),
        told.end()); // levels of the buzz
    CHECK(told == std::vector<std::array<int, 2>>{
                      {0, 2}, {100, 3}, {120, 3}, {140, 3}, {160, 2}, {300, 5}, {400, 2}, {520, 2}, {540, 2}});
    for (const StopReport& stop : played.sink.stops)
        CHECK(stop.report == waveformReport(standardTrigger(), {}));
}

TEST_CASE("A slow packet moves no other, and what it covers is left out", "[devices]")
{
    InstantClock* clock = nullptr;
    InstantClock shared;
    clock = &shared;
    ReportList sink(shared);
    sink.then = [&](std::size_t count)
    {
        if (count == 11) // packet 9 takes 50 ms
            clock->pause(50_ms);
        return Result<void>();
    };
    RumblePlayer player(joyCon, rumbleOf(toneClip(1.0, 0.0, 1.0), joyCon), sink, shared);
    const auto result = player.finish();
    REQUIRE(result);
    CHECK(result->leftOut == 2);
    CHECK(sink.sent[10].time == Approx(0.015 * 10));
    CHECK(sink.sent[11].time == Approx(0.015 * 10 + 0.050)); // packet 12, late by 5 ms
    CHECK(sink.sent[12].time == Approx(0.015 * 14));
    CHECK(result->latest.value == Approx(0.005));
}

TEST_CASE("Whenever playing is stopped, the last packets are silent", "[devices]")
{
    for (const std::size_t after : {std::size_t{1}, std::size_t{5}, std::size_t{40}})
    {
        InstantClock clock;
        ReportList sink(clock);
        sink.then = [&](std::size_t count)
        {
            if (count == after)
                clock.interrupt();
            return Result<void>();
        };
        RumblePlayer player(joyCon, rumbleOf(toneClip(1.0, 0.0, 1.0), joyCon, true), sink, clock);
        REQUIRE(player.finish());
        CHECK_FALSE(player.isPlaying());
        CAPTURE(after);
        REQUIRE(sink.sent.size() == after + 2);
        CHECK(isNeutral(sink.sent[after].report));
        CHECK(isNeutral(sink.sent[after + 1].report));
        CHECK(sink.sent[after].time - sink.sent[after - 1].time < 0.016);
    }
}

TEST_CASE("A player that is destroyed has silenced its controller", "[devices]")
{
    InstantClock clock;
    ReportList sink(clock);
    {
        const RumblePlayer player(joyCon, rumbleOf(toneClip(1.0, 0.0, 1.0), joyCon, true), sink, clock);
    }
    REQUIRE(sink.sent.size() >= 3);
    CHECK(isNeutral(sink.sent.back().report));
}

TEST_CASE("An error of the controller ends playing, after one more try to silence it", "[devices]")
{
    const Played played(
        joyCon, toneClip(1.0, 0.0, 1.0),
        [](std::size_t count) {
            return count < 20 ? Result<void>() : Error{ErrorCode::io, "", "gone " + std::to_string(count)};
        });
    REQUIRE_FALSE(played.result);
    CHECK(played.result.error().message == "gone 20");
    CHECK(played.sink.sent.size() == 21);
    CHECK(isNeutral(played.sink.sent.back().report));
}

TEST_CASE("The packet for a crash is silent and has the counter that is due", "[devices]")
{
    const Played played(joyCon, toneClip(0.1, 0.0, 0.1));
    for (std::size_t i = 0; i < 16; ++i)
    {
        CHECK(isNeutral(played.sink.stops[i].report));
        CHECK(counterOf(played.sink.stops[i].report) == static_cast<int>(i));
    }
}

TEST_CASE("A DualSense is given back to its audio at the end", "[devices]")
{
    const Played played({ControllerHaptics::dualSense, Transport::bluetooth}, toneClip(0.2, 0.0, 0.2));
    const auto& sent = played.sink.sent;
    REQUIRE(sent.size() >= 4);
    const auto last = static_cast<unsigned>(sent.size() - 1);
    CHECK(sent[last].report == Report(dualSenseBluetoothReport({}, DualSenseMode::audioHaptics, last)));
    CHECK(sent[last - 1].report == Report(dualSenseBluetoothReport({}, DualSenseMode::improvedRumble, last - 1)));
}

TEST_CASE("Stopping from another thread interrupts the real clock at once", "[devices]")
{
    SteadyClock clock;
    InstantClock unused;
    ReportList sink(unused);
    std::atomic<bool> begun{false};
    sink.then = [&](std::size_t)
    {
        begun.store(true);
        begun.notify_one();
        return Result<void>();
    };
    // The only sound is hours away: a player that slept until then would hang here.
    RumblePlayer player(joyCon, rumbleOf(toneClip(9000.0, 8999.0, 9000.0), joyCon, true), sink, clock);
    begun.wait(false);
    player.stop();
    CHECK_FALSE(player.isPlaying());
    CHECK(isNeutral(sink.sent.back().report));
}
