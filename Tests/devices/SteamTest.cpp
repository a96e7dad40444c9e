#include "devices/ClipRumble.h"
#include "devices/InstantClock.h"
#include "devices/MuLaw.h"
#include "devices/RumblePlayer.h"
#include "devices/SteamReports.h"
#include "support/Catch.h"
#include "support/ReportList.h"

#if defined(__linux__)
#include "devices/HidrawList.h"
#include "support/TempFolder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
constexpr ControllerModel onCable{ControllerHaptics::steamController, Transport::usb};
constexpr ControllerModel byReceiver{ControllerHaptics::steamController, Transport::receiver};
constexpr ControllerModel onBluetooth{ControllerHaptics::steamController, Transport::bluetooth};

// A tone of 100 Hz between `start` and `end`.
Clip humClip(double duration, double start, double end, double frequency = 100.0)
{
    Clip clip;
    clip.duration = duration;
    clip.bands.push_back(
        {0.9 * frequency, frequency, 1.1 * frequency, 0, {{start, 0.0}, {start, 0.5}, {end, 0.5}, {end, 0.0}}, {}});
    return clip;
}

int byteOf(const Report& report, std::size_t at)
{
    return std::to_integer<int>(report.content()[at]);
}

bool isSwitch(const Report& report, int what, int pair, int format)
{
    return report == Report(std::array{std::byte{0x86}, static_cast<std::byte>(what), static_cast<std::byte>(pair),
                                       static_cast<std::byte>(format)});
}

// As G.711 has it: the middle of the step.
int decodedMuLaw(std::byte code)
{
    const int bits = ~std::to_integer<int>(code) & 0xFF;
    const int magnitude = ((8 * (bits & 15) + 132) << (bits >> 4 & 7)) - 132;
    return (bits & 0x80) != 0 ? -magnitude : magnitude;
}

// The samples of one side of all reports 88.
std::vector<double> samplesOf(const std::vector<test::SentReport>& sent, bool right)
{
    std::vector<double> samples;
    for (const auto& [time, report] : sent)
        if (byteOf(report, 0) == 0x88)
            for (std::size_t i = 0; i < static_cast<std::size_t>(byteOf(report, 1)); ++i)
            {
                const std::size_t at = 2 + (right ? 31 : 0) + i;
                if (byteOf(report, 1) == 31)
                    samples.push_back(decodedMuLaw(report.content()[at]) / 32768.0);
                else if (i % 2 == 0)
                    samples.push_back(static_cast<std::int16_t>(byteOf(report, at) + 256 * byteOf(report, at + 1)) /
                                      32768.0);
            }
    return samples;
}

double peakOf(const std::vector<double>& samples, std::size_t from, std::size_t to)
{
    double peak = 0.0;
    for (std::size_t i = from; i < std::min(to, samples.size()); ++i)
        peak = std::max(peak, std::abs(samples[i]));
    return peak;
}

// The frequency by rising zero crossings.
double frequencyOf(const std::vector<double>& samples, double fs)
{
    std::vector<std::size_t> rises;
    for (std::size_t i = 1; i < samples.size(); ++i)
        if (samples[i - 1] < 0.0 && samples[i] >= 0.0)
            rises.push_back(i);
    REQUIRE(rises.size() > 2);
    return fs * static_cast<double>(rises.size() - 1) / static_cast<double>(rises.back() - rises.front());
}
} // namespace

TEST_CASE("mu-law is that of G.711: known codes, and every sample within half a step", "[devices]")
{
    // From the audioop module of Python.
    const std::array<std::array<int, 2>, 9> known{{{0, 0xFF},
                                                   {4, 0xFE},
                                                   {100, 0xF2},
                                                   {1000, 0xCE},
                                                   {8031, 0xA0},
                                                   {32635, 0x80},
                                                   {32767, 0x80},
                                                   {-1000, 0x4E},
                                                   {-32768, 0x00}}};
    for (const auto& [sample, code] : known)
        CHECK(std::to_integer<int>(muLawByte(static_cast<std::int16_t>(sample))) == code);
    for (int sample = -32768; sample <= 32767; ++sample)
    {
        const int decoded = decodedMuLaw(muLawByte(static_cast<std::int16_t>(sample)));
        const int halfStep = std::max(4, (std::abs(sample) + 132) / 32);
        if (std::abs(sample) <= 32635)
            REQUIRE(std::abs(decoded - sample) <= halfStep);
    }
}

TEST_CASE("A Steam Controller is sent samples in the form of its connection", "[devices]")
{
    PcmBlock block;
    block.left[0] = 0x0102;
    block.left[14] = -2;
    block.right[0] = 1000;
    const Report wired = steamSamplesReport(steamStream(Transport::usb), block);
    REQUIRE(wired.content().size() == 64);
    CHECK(byteOf(wired, 0) == 0x88);
    CHECK(byteOf(wired, 1) == 30);
    CHECK(byteOf(wired, 2) == 0x02);
    CHECK(byteOf(wired, 3) == 0x01);
    CHECK(byteOf(wired, 30) == 0xFE);
    CHECK(byteOf(wired, 31) == 0xFF);
    CHECK(byteOf(wired, 33) == 0xE8);
    CHECK(byteOf(wired, 34) == 0x03);
    block.left[30] = 1000;
    const Report radio = steamSamplesReport(steamStream(Transport::receiver), block);
    REQUIRE(radio.content().size() == 64);
    CHECK(byteOf(radio, 1) == 31);
    CHECK(byteOf(radio, 3) == 0xFF); // silence
    CHECK(byteOf(radio, 32) == 0xCE);
    CHECK(byteOf(radio, 33) == 0xCE);
    CHECK(steamStream(Transport::bluetooth).rate == 1000);
    CHECK(pacingOf(onCable).interval.value == Approx(0.001875));
    CHECK(pacingOf(byReceiver).interval.value == Approx(0.003875));
    CHECK(pacingOf(onBluetooth).interval.value == Approx(0.031));
}

TEST_CASE("A Steam Deck is sent two levels in a feature report", "[devices]")
{
    const Report report = steamDeckReport({1.0, 0.5});
    CHECK(report.isFeature());
    std::vector<int> bytes;
    for (const std::byte each : report.content())
        bytes.push_back(std::to_integer<int>(each));
    std::vector<int> expected{0, 0xEB, 9, 0, 0, 0, 0xFF, 0xFF, 0x00, 0x80, 2, 0};
    expected.resize(65, 0);
    CHECK(bytes == expected);
    CHECK(steamDeckReport({std::nan(""), -1.0}) == steamDeckReport({}));
}

TEST_CASE("Samples are started, sent ahead, paced without drift, and ended", "[devices]")
{
    for (const ControllerModel& model : {onCable, byReceiver, onBluetooth})
    {
        const SteamStream stream = steamStream(model.transport);
        CAPTURE(stream.format);
        const test::PlayedReports played(model, humClip(1.0, 0.0, 1.0));
        REQUIRE(played.result);
        const auto& sent = played.sink.sent;
        CHECK(isSwitch(sent[0].report, 1, 2, 0));
        CHECK(isSwitch(sent[1].report, 1, 5, 0));
        CHECK(isSwitch(sent[2].report, 2, 2, stream.format));
        CHECK(isSwitch(sent[3].report, 2, 5, stream.format));
        const double start = sent[2].time;
        CHECK(start == Approx(0.010));
        const double interval = pacingOf(model).interval.value;
        const auto ahead = static_cast<std::size_t>(pacingOf(model).ahead);
        const std::size_t packets = sent.size() - 4 - 2 - 4;
        CHECK(static_cast<double>(packets) == Approx(1.0 / interval).margin(1.5));
        for (std::size_t n = 0; n < packets; ++n)
        {
            CAPTURE(n);
            CHECK(byteOf(sent[4 + n].report, 0) == 0x88);
            const double due = n > ahead ? interval * static_cast<double>(n - ahead) : 0.0;
            CHECK(sent[4 + n].time - start == Approx(due).margin(1e-9));
        }
        const std::size_t closing = sent.size() - 4;
        CHECK(sent[closing - 1].report == reportOf(model, PcmBlock{}, 0));
        CHECK(sent[closing - 2].time >= start + 1.0); // what was sent ahead has been played
        CHECK(isSwitch(sent[closing].report, 1, 2, stream.format));
        CHECK(isSwitch(sent[closing + 1].report, 1, 5, stream.format));
        CHECK(isSwitch(sent[closing + 2].report, 1, 2, 0));
        CHECK(isSwitch(sent[closing + 3].report, 1, 5, 0));
        CHECK(sent[closing + 2].time - sent[closing + 1].time == Approx(0.150));
        CHECK(played.result->leftOut == 0);

        for (const bool right : {false, true})
        {
            auto samples = samplesOf(sent, right);
            samples.resize(samples.size() * 3 / 4); // without the end
            CHECK(frequencyOf(samples, stream.rate) == Approx(100.0).epsilon(0.01));
            CHECK(peakOf(samples, samples.size() / 4, samples.size() / 2) == Approx(0.5).epsilon(0.08));
        }
    }
}

TEST_CASE("What a connection cannot carry is filtered out, not folded", "[devices]")
{
    const test::PlayedReports played(onBluetooth, humClip(1.0, 0.0, 1.0, 900.0)); // would come out at 100 Hz
    const auto samples = samplesOf(played.sink.sent, false);
    CHECK(peakOf(samples, 100, 900) < 0.03); // at its ends it clicks
}

TEST_CASE("After silence that was not sent, a Steam Controller is started anew and the sound keeps its time",
          "[devices]")
{
    const test::PlayedReports played(byReceiver, humClip(4.0, 3.0, 4.0));
    const auto& sent = played.sink.sent;
    const double interval = pacingOf(byReceiver).interval.value;
    const auto isOn = [](const test::SentReport& each)
    {
        return isSwitch(each.report, 2, 2, 8);
    };
    const auto again = std::find_if(sent.begin() + 4, sent.end(), isOn);
    REQUIRE(again != sent.end());
    CHECK(again[-1].time - sent[3].time < 0.35);
    const Report silence = reportOf(byReceiver, PcmBlock{}, 0);
    for (std::ptrdiff_t i = 2; i < 10; ++i)
        CHECK(again[i].report == silence);
    CHECK(again[10].report != silence);
    // The first of the eight starts to play when it comes.
    CHECK(again->time + 8 * interval - sent[3].time == Approx(3.0).margin(interval));
}

TEST_CASE("A report that comes late moves no other until the controller's memory is empty", "[devices]")
{
    InstantClock clock;
    test::ReportList sink(clock);
    sink.then = [&](std::size_t count)
    {
        if (count == 100)
            clock.pause(Seconds(0.020)); // five of eight
        if (count == 200)
            clock.pause(Seconds(0.100));
        return Result<void>();
    };
    const Clip clip = humClip(2.0, 0.0, 2.0);
    RumblePlayer player(byReceiver, ClipRumble(clip, {Seconds(0.0), Seconds(2.0)}, 0_dB, byReceiver), sink, clock);
    const auto result = player.finish();
    REQUIRE(result);
    CHECK(sink.sent[100].time == Approx(sink.sent[103].time)); // at once, one after the other
    const double interval = pacingOf(byReceiver).interval.value;
    CHECK(static_cast<double>(result->leftOut) == Approx(0.100 / interval - 8.0).margin(2.0));
}

TEST_CASE("A crash ends the samples of grips and trackpads, and the rumble of a Steam Deck", "[devices]")
{
    for (const StopReport& stop : stopReports(byReceiver))
    {
        CHECK(isSwitch(stop.report, 1, 2, 8));
        CHECK(isSwitch(stop.also, 1, 5, 8));
    }
    for (const StopReport& stop : stopReports({ControllerHaptics::steamDeck, Transport::usb}))
    {
        CHECK(stop.report == steamDeckReport({}));
        CHECK(stop.also.content().empty());
    }
}

TEST_CASE("A loop of samples goes on until it is stopped, which is silent at once", "[devices]")
{
    InstantClock clock;
    test::ReportList sink(clock);
    sink.then = [&](std::size_t count)
    {
        if (count == 1000)
            clock.interrupt();
        return Result<void>();
    };
    const Clip clip = humClip(0.5, 0.0, 0.5);
    RumblePlayer player(byReceiver, ClipRumble(clip, {Seconds(0.1), Seconds(0.4), true}, 0_dB, byReceiver), sink,
                        clock);
    REQUIRE(player.finish());
    REQUIRE(sink.sent.size() == 1000 + 2 + 4);
    CHECK(sink.sent[1000].report == reportOf(byReceiver, PcmBlock{}, 0));
    const auto samples = samplesOf(sink.sent, false);
    for (std::size_t at = 1000; at + 800 < 30000; at += 800)
        CHECK(peakOf(samples, at, at + 800) > 0.3);
}

#if defined(__linux__)
TEST_CASE("Of the nodes of a receiver those are used that send", "[devices]")
{
    const test::TempFolder folder;
    std::vector<std::string> nodes;
    for (const char* const name : {"a", "b", "c"})
    {
        nodes.push_back((folder / name).string());
        REQUIRE(::mkfifo(nodes.back().c_str(), 0600) == 0);
    }
    CHECK(sendingNodes(nodes) == nodes);
    const int end = ::open(nodes[1].c_str(), O_RDWR);
    REQUIRE(::write(end, "x", 1) == 1);
    CHECK(sendingNodes(nodes) == std::vector<std::string>{nodes[1]});
    ::close(end);
    CHECK(sendingNodes({(folder / "absent").string()}).size() == 1);
}
#endif
