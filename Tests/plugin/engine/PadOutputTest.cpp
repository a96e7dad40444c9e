// What a controller is sent that plays the plugin's drive.

#include "plugin/engine/PadOutput.h"

#include "devices/Levels.h"
#include "plugin/engine/FakePads.h"
#include "plugin/engine/Rig.h"
#include "support/HeapGuard.h"
#include "support/Paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

using namespace pacini;
using namespace pacini::test;
using plugin::PadOutput;
using plugin::ParameterId;

namespace
{
constexpr double hostRate = 48000.0;
constexpr std::size_t hostBlock = 256;

/// A tone that swells, breaks off and comes back.
std::vector<float> swells(double seconds, double fs = hostRate)
{
    std::vector<float> sound(static_cast<std::size_t>(seconds * fs));
    for (std::size_t i = 0; i < sound.size(); ++i)
    {
        const double t = static_cast<double>(i) / fs;
        const double level = std::fmod(t, 2.0) < 1.4 ? 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * t / 0.7) : 0.0;
        sound[i] = static_cast<float>(0.7 * level * std::sin(2.0 * std::numbers::pi * 90.0 * t));
    }
    return sound;
}

/// What was played of a sound, at the pace of its rate as a host does, and when.
struct Played
{
    std::vector<FakePad::Clock::time_point> times; ///< of blocks
    std::vector<float> drive;
};

Played playInTime(Rig& rig, const std::vector<float>& sound)
{
    Played played;
    const Channels stereo(2, sound);
    const auto begin = FakePad::Clock::now();
    auto out = rig.run(stereo, {}, {static_cast<int>(hostBlock)},
                       [&](std::size_t count)
                       {
                           const auto due = begin + std::chrono::duration_cast<FakePad::Clock::duration>(
                                                        std::chrono::duration<double>(
                                                            static_cast<double>(count * hostBlock) / rig.layout.rate));
                           std::this_thread::sleep_until(due);
                           played.times.push_back(FakePad::Clock::now());
                       });
    if (!out.haptic.empty())
        played.drive = std::move(out.haptic[0]);
    return played;
}

/// Levels in steps of 1 ms of a drive, at the times when it was played.
std::vector<double> levelsOf(const Played& played, double fs)
{
    std::vector<double> squares(static_cast<std::size_t>(1000.0 * static_cast<double>(played.drive.size()) / fs));
    for (std::size_t i = 0; i < played.drive.size(); ++i)
    {
        const auto late = std::chrono::duration<double>(played.times[i / hostBlock] - played.times[0]).count();
        const double t = late + static_cast<double>(i % hostBlock) / fs;
        const double x = static_cast<double>(played.drive[i]);
        if (const auto at = static_cast<std::size_t>(1000.0 * t); at < squares.size())
            squares[at] += 2000.0 * x * x / fs;
    }
    return smoothed(squares);
}

std::vector<double> levelsOf(const FakePad& pad, FakePad::Clock::time_point begin, std::size_t steps, double lag)
{
    std::vector<double> squares(steps);
    const auto sent = pad.sent();
    std::size_t next = 0;
    double square = 0.0;
    for (std::size_t i = 0; i < steps; ++i)
    {
        const double now = 0.001 * static_cast<double>(i) + lag;
        for (; next < sent.size() && std::chrono::duration<double>(sent[next].time - begin).count() <= now; ++next)
        {
            const devices::MotorLevels motors = toldLevels(pad.model(), sent[next].report);
            square = motors.strong * motors.strong + motors.weak * motors.weak;
        }
        squares[i] = square;
    }
    return smoothed(squares);
}

/// A sound device that asks for nothing by itself.
class FakePort final : public live::SoundPort
{
public:
    explicit FakePort(std::vector<float>& into) : played(into) {}

    [[nodiscard]] double sampleRate() const override { return hostRate; }
    [[nodiscard]] std::size_t blockFrames() const override { return 128; }
    [[nodiscard]] Result<void> take(live::SoundTaker) override { return Error{ErrorCode::io, "", "is no input"}; }
    [[nodiscard]] Result<void> play(live::SoundMaker maker) override
    {
        running = true;
        thread = std::thread(
            [this, make = std::move(maker)]
            {
                std::array<float, 128> frames{};
                for (auto due = FakePad::Clock::now(); running; due += std::chrono::microseconds(2667))
                {
                    std::this_thread::sleep_until(due);
                    make(frames);
                    played.insert(played.end(), frames.begin(), frames.end());
                }
            });
        return {};
    }
    void stop() override
    {
        running = false;
        if (thread.joinable())
            thread.join();
    }
    ~FakePort() override { FakePort::stop(); }
    [[nodiscard]] bool isRunning() override { return running; }
    [[nodiscard]] std::uint64_t blocks() const override { return 0; }
    [[nodiscard]] std::uint64_t interruptions() const override { return 0; }

private:
    std::vector<float>& played;
    std::atomic<bool> running{false};
    std::thread thread;
};

std::string sessionOf(plugin::PluginProcessor& plugin)
{
    juce::MemoryBlock content;
    plugin.getStateInformation(content);
    return {static_cast<const char*>(content.getData()), content.getSize()};
}
} // namespace

TEST_CASE("A controller: the level that it is sent follows the drive that the haptic output has")
{
    for (const double fs : {48000.0, 44100.0, 96000.0})
    {
        FakePad pad;
        Rig rig({.rate = fs});
        rig.plugin.pad().setAccess(accessTo({&pad}));
        rig.plugin.pad().choose("Wireless Controller");
        REQUIRE(becomes([&] { return rig.plugin.pad().status().plays; }));
        pad.clear();
        const auto played = playInTime(rig, swells(4.0, fs));
        const auto drive = levelsOf(played, fs);
        // It comes with its block, for the next packet: later than it is made, and never by more than this.
        double best = -1.0, bestLag = 0.0;
        for (double lag = 0.0; lag < 0.040; lag += 0.002)
            if (const double alike = correlation(drive, levelsOf(pad, played.times[0], drive.size(), lag));
                alike > best)
            {
                best = alike;
                bestLag = lag;
            }
        CAPTURE(fs, best, bestLag);
        CHECK(best >= 0.95);
        const auto sent = levelsOf(pad, played.times[0], drive.size(), bestLag);
        CHECK(*std::max_element(sent.begin(), sent.end()) ==
              Approx(*std::max_element(drive.begin(), drive.end())).epsilon(0.26)); // 2 dB
    }
}

TEST_CASE("A controller: nothing is sent, held or started when nobody chose one")
{
    FakePad pad;
    Rig rig;
    int listed = 0;
    auto access = accessTo({&pad});
    access.list = [&listed, list = access.list]
    {
        ++listed;
        return list();
    };
    rig.plugin.pad().setAccess(access);
    CHECK(rig.plugin.pad().drive() == nullptr);
    (void)rig.run(Channels(2, swells(0.5)));
    CHECK(rig.plugin.pad().drive() == nullptr);
    CHECK(rig.plugin.pad().status() == PadOutput::Status{});
    CHECK(listed == 0);
    CHECK(pad.sent().empty());
}

TEST_CASE("A controller: the sound is the same with one as without")
{
    FakePad pad;
    Rig with, without;
    with.plugin.pad().setAccess(accessTo({&pad}));
    with.plugin.pad().choose("Wireless Controller");
    REQUIRE(becomes([&] { return with.plugin.pad().status().plays; }));
    const auto in = liveSounds(2, 48000, 11);
    CHECK(with.run(in) == without.run(in));
}

TEST_CASE("A controller: it makes no heap traffic on the audio thread, connected, unplugged and chosen anew")
{
    FakePad pad;
    Rig rig;
    rig.plugin.pad().setAccess(accessTo({&pad}));
    rig.plugin.pad().choose("Wireless Controller");
    REQUIRE(becomes([&] { return rig.plugin.pad().status().plays; }));
    juce::AudioBuffer<float> buffer(3, 256);
    juce::MidiBuffer midi;
    const auto sound = liveSound(256, 3);
    std::size_t traffic = 0;
    const auto play = [&](int blocks)
    {
        for (int i = 0; i < blocks; ++i)
        {
            for (int c = 0; c < 3; ++c)
                buffer.copyFrom(c, 0, sound.data(), 256);
            const HeapGuard guard;
            rig.plugin.processBlock(buffer, midi);
            traffic += guard.traffic();
        }
    };
    play(2000); // more than its queue holds
    pad.isPlugged = false;
    REQUIRE(becomes([&] { return !rig.plugin.pad().status().plays; }));
    play(500);
    pad.isPlugged = true;
    REQUIRE(becomes([&] { return rig.plugin.pad().status().plays; }));
    play(500);
    rig.plugin.pad().choose({});
    play(500);
    CHECK(traffic == 0);
}

TEST_CASE("A controller: offline and in bypass it is sent silence, and it falls silent when no block comes any more")
{
    FakePad pad;
    Rig rig;
    rig.plugin.pad().setAccess(accessTo({&pad}));
    rig.plugin.pad().choose("Wireless Controller");
    REQUIRE(becomes([&] { return rig.plugin.pad().status().plays; }));
    rig.plugin.setNonRealtime(true);
    (void)playInTime(rig, swells(1.0));
    CHECK(pad.felt() == 0);
    rig.plugin.setNonRealtime(false);
    rig.set(ParameterId::bypass, 1.0);
    (void)playInTime(rig, std::vector<float>(4800));
    pad.clear();
    (void)playInTime(rig, swells(1.0));
    CHECK(pad.felt() == 0);
    rig.set(ParameterId::bypass, 0.0);
    (void)playInTime(rig, swells(0.5));
    CHECK(pad.felt() > 5);
    CHECK(becomes([&] { return pad.isSilent(pad.sent().back().report); }, 1.0));
}

TEST_CASE(
    "A controller: it plays also where the haptic output is off, and shows in the meter where no output is connected")
{
    FakePad pad;
    Rig rig({.haptic = 0});
    rig.plugin.pad().setAccess(accessTo({&pad}));
    rig.plugin.setConnected(0);
    (void)rig.run(Channels(2, swells(0.5)));
    CHECK(rig.plugin.takePeak(0) == 0.0f);
    rig.plugin.pad().choose("Wireless Controller");
    REQUIRE(becomes([&] { return rig.plugin.pad().status().plays; }));
    (void)playInTime(rig, swells(0.7));
    CHECK(pad.felt() > 10);
    CHECK(rig.plugin.takePeak(0) > 0.1f);
}

TEST_CASE("A controller: unplugging, coming back elsewhere and what it cannot play are told")
{
    FakePad pad;
    pad.lesser = "has no sound device here";
    Rig rig;
    rig.plugin.pad().setAccess(accessTo({&pad}));
    pad.isPlugged = false;
    rig.plugin.pad().choose("Wireless Controller");
    const auto status = [&]
    {
        return rig.plugin.pad().status();
    };
    REQUIRE(becomes([&] { return !status().trouble.empty(); }));
    CHECK(status().trouble == "is not connected; it plays as soon as it is");
    CHECK_FALSE(status().plays);
    pad.isPlugged = true;
    REQUIRE(becomes([&] { return status().plays && !status().lesser.empty(); }));
    CHECK(status().trouble.empty());
    CHECK(status().lesser == "has no sound device here");
    pad.isPlugged = false;
    REQUIRE(becomes([&] { return !status().plays; }));
    CHECK(status().lesser.empty());
    CHECK_FALSE(status().trouble.empty());
    const std::string unplugged = status().trouble;
    pad.isMute = true;
    pad.isPlugged = true;
    REQUIRE(becomes([&] { return status().trouble != unplugged; }));
    for (int i = 0; i < 200; ++i) // it is opened time and again
    {
        CHECK_FALSE(status().plays);
        CHECK(status().trouble == "does not answer any more; was it unplugged or switched off?");
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    pad.isPlugged = pad.isMute = false;
    pad.controller.path = "/dev/fake1";
    pad.isPlugged = true;
    REQUIRE(becomes([&] { return status().plays; }));
    pad.clear();
    (void)playInTime(rig, swells(0.7));
    CHECK(pad.felt() > 10);
    CHECK(pad.armed == 0); // the signals are the host's
}

TEST_CASE("A controller: a second instance is told that it is in use, and plays when the first lets go")
{
    FakePad pad;
    Rig first, second;
    for (Rig* rig : {&first, &second})
    {
        rig->plugin.pad().setAccess(accessTo({&pad}));
        rig->plugin.pad().choose("Wireless Controller");
        REQUIRE(
            becomes([&] { return rig->plugin.pad().status().plays || !rig->plugin.pad().status().trouble.empty(); }));
    }
    REQUIRE(becomes([&] { return first.plugin.pad().status().plays; }));
    REQUIRE(becomes([&] { return !second.plugin.pad().status().trouble.empty(); }));
    CHECK(second.plugin.pad().status().trouble == "is in use by another program; end that first");
    first.plugin.pad().choose({});
    CHECK(becomes([&] { return second.plugin.pad().status().plays; }));
    CHECK(becomes([&] { return second.plugin.pad().status().trouble.empty(); }));
    CHECK(first.plugin.pad().status() == PadOutput::Status{});
}

TEST_CASE("A controller: of two with one name that plays whose path was chosen")
{
    FakePad one("Pad", "/dev/fake0"), two("Pad", "/dev/fake1");
    Rig rig;
    rig.plugin.pad().setAccess(accessTo({&one, &two}));
    rig.plugin.pad().choose("Pad", "/dev/fake1");
    REQUIRE(becomes([&] { return rig.plugin.pad().status().plays; }));
    CHECK(two.isOpen);
    CHECK(rig.plugin.pad().isChosen(two.controller));
    CHECK_FALSE(rig.plugin.pad().isChosen(one.controller));
    rig.plugin.pad().choose("Pad", "/dev/fake0");
    CHECK(becomes([&] { return one.isOpen && !two.isOpen; }));
    rig.plugin.pad().choose({});
    CHECK(becomes([&] { return !one.isOpen; }));
}

TEST_CASE("A controller: another sample rate of the host is followed")
{
    FakePad pad;
    Rig rig;
    rig.plugin.pad().setAccess(accessTo({&pad}));
    rig.plugin.pad().choose("Wireless Controller");
    REQUIRE(becomes([&] { return rig.plugin.pad().status().plays; }));
    rig.layout.rate = 96000.0;
    rig.plugin.setRateAndBufferSizeDetails(96000.0, 512);
    rig.plugin.prepareToPlay(96000.0, 512);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    REQUIRE(becomes([&] { return rig.plugin.pad().status().plays; }));
    pad.clear();
    (void)playInTime(rig, swells(0.7, 96000.0));
    CHECK(pad.felt() > 10);
}

TEST_CASE("A controller: one with a sound device is played its drive as samples")
{
    FakePad pad("DualSense Wireless Controller", "/dev/fake0", devices::ControllerHaptics::dualSense);
    std::vector<float> heard;
    Rig rig;
    auto access = accessTo({&pad});
    access.open = [&, open = access.open](const devices::Controller& wanted)
    {
        auto opened = open(wanted);
        if (opened)
        {
            opened->controller.path = testFolder().string(); // it is there
            opened->sound = std::make_unique<FakePort>(heard);
        }
        return opened;
    };
    rig.plugin.pad().setAccess(access);
    rig.plugin.pad().choose("DualSense Wireless Controller");
    REQUIRE(becomes([&] { return rig.plugin.pad().status().plays; }));
    const auto played = playInTime(rig, swells(2.0));
    rig.plugin.pad().choose({});
    REQUIRE(becomes([&] { return !pad.isOpen; }));
    // Both clocks are that of the machine: the same samples, some time later.
    const double sent = energy(heard), made = energy(played.drive);
    CAPTURE(sent, made);
    CHECK(sent > 0.7 * made);
    CHECK(sent < 1.4 * made);
    CHECK(pad.felt() == 0);
}

TEST_CASE("A controller: a state keeps its name, and a state without one lets it go")
{
    FakePad pad;
    Rig first, second;
    const std::string without = sessionOf(first.plugin);
    CHECK(without.find("controller") == std::string::npos);
    for (Rig* rig : {&first, &second})
        rig->plugin.pad().setAccess(accessTo({&pad}));
    first.plugin.pad().choose("Wireless Controller", "/dev/fake0");
    const std::string with = sessionOf(first.plugin);
    first.plugin.pad().choose({});
    CHECK(sessionOf(first.plugin) == without);
    REQUIRE(second.plugin.restoreState(with));
    REQUIRE(becomes([&] { return second.plugin.pad().status().plays; }));
    CHECK(sessionOf(second.plugin) == with);
    pad.clear();
    REQUIRE(second.plugin.restoreState(with)); // as a host does at each of its own steps
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    CHECK(pad.isOpen);
    REQUIRE(second.plugin.restoreState(without));
    CHECK(becomes([&] { return !pad.isOpen; }));
    CHECK(second.plugin.note().isEmpty());
}
