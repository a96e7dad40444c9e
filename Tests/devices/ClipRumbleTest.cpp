#include "devices/ClipRumble.h"

#include "devices/DecodeRumble.h"
#include "devices/WaveformDevice.h"
#include "support/Catch.h"
#include "support/ShippedProfile.h"

#include <pacini/synthesis/RenderScene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
constexpr PlayRange wholeClip{Seconds(0.0), Seconds(1.0), false};

// 1 s of a steady tone of 150 Hz, and events where they are asked for.
Clip steadyClip(double amplitude, std::vector<Transient> events = {})
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands.push_back({100.0, 150.0, 200.0, 0, {{0.0, amplitude}, {1.0, amplitude}}, {}});
    clip.transients = std::move(events);
    return clip;
}

template <typename State>
std::vector<State> statesOf(const Clip& clip, const ControllerModel& model, const PlayRange& range = wholeClip,
                            std::int64_t most = 1000, Decibels intensity = 0_dB)
{
    ClipRumble rumble(clip, range, intensity, model);
    std::vector<State> states;
    while (static_cast<std::int64_t>(states.size()) < most)
    {
        const auto state = rumble.at(static_cast<std::int64_t>(states.size()));
        if (!state)
            break;
        states.push_back(std::get<State>(*state));
    }
    return states;
}

double levelOf(const MotorLevels& motors)
{
    return std::hypot(motors.strong, motors.weak);
}

constexpr ControllerModel dualShock{ControllerHaptics::dualShock4, Transport::usb};                  // 10 ms
constexpr ControllerModel touchpad{ControllerHaptics::waveforms, Transport::usb, standardTrigger()}; // 20 ms

// The packets in which an event is triggered.
std::vector<std::size_t> eventsOf(const std::vector<WaveformState>& states)
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < states.size(); ++i)
        if (states[i].waveform == Waveform::event && states[i].begins)
            found.push_back(i);
    return found;
}
} // namespace

TEST_CASE("The envelope of a clip decides how strongly a controller plays, whatever its bands are", "[devices]")
{
    for (const double bands : {0.05, 0.8})
        for (const double envelope : {0.02, 0.3, 0.9})
        {
            CAPTURE(bands, envelope);
            Clip clip = steadyClip(bands);
            clip.envelope = {{0.0, envelope}, {1.0, envelope}};
            CHECK(levelOf(statesOf<MotorLevels>(clip, dualShock)[50]) == Approx(envelope).epsilon(0.15));
            const auto sides = statesOf<SidesRumble>(clip, {ControllerHaptics::hdRumble, Transport::bluetooth});
            const RumbleTones tones = decodeRumble(sides[33].left).value();
            CHECK(std::hypot(tones.low.amplitude, tones.high.amplitude) == Approx(envelope).epsilon(0.15));
            CHECK(tones.low.frequency.value == Approx(150.0).epsilon(0.05));
        }
}

TEST_CASE("Noise is felt, on a clip of nothing else too", "[devices]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.noise.push_back({80.0, 300.0, {{0.0, 0.3}, {1.0, 0.3}}});
    const auto states = statesOf<MotorLevels>(clip, dualShock);
    double sum = 0.0;
    for (const MotorLevels& each : states)
        sum += levelOf(each) * levelOf(each) / static_cast<double>(states.size());
    CHECK(std::sqrt(sum) == Approx(0.3 * std::numbers::sqrt2).epsilon(0.2));
}

TEST_CASE("The drive that a device plays is that of render for the actuator too, and of a person's", "[devices]")
{
    Clip clip = steadyClip(0.02, {{0.3, 0.8, 0.5}}); // far weaker than what actuators of 20 dB show
    Profile personal = test::shippedProfile("lra-175");
    personal.range.dynamicRange = 20.0;
    for (const Profile& profile :
         {test::shippedProfile("l5-wristband"), test::shippedProfile("quest-controller"), personal})
    {
        CAPTURE(profile.name, profile.range.dynamicRange);
        const auto rendered = renderScene(sceneOf(clip), &profile, {});
        REQUIRE(rendered);
        std::vector<float> drive(rendered->samples.size());
        const std::array<std::span<float>, 1> out{drive};
        clipDrive(clip, wholeClip, 0_dB, 48000.0, &profile)(out);
        double error = 0.0, power = 0.0;
        for (std::size_t i = 0; i < drive.size(); ++i)
        {
            error += std::pow(static_cast<double>(drive[i]) - static_cast<double>(rendered->samples[i]), 2.0);
            power += std::pow(static_cast<double>(rendered->samples[i]), 2.0);
        }
        CHECK(power > 0.0);
        CHECK(error < 1e-6 * power);
    }
    ClipRumble weak(clip, wholeClip, 0_dB, dualShock), raised(clip, wholeClip, 0_dB, dualShock, &personal);
    double before = 0.0, after = 0.0;
    for (std::int64_t packet = 0; packet < 80; ++packet)
    {
        const auto one = weak.at(packet), other = raised.at(packet);
        REQUIRE((one && other));
        if (packet < 50)
            continue; // the event
        before = std::max(before, levelOf(std::get<MotorLevels>(*one)));
        after = std::max(after, levelOf(std::get<MotorLevels>(*other)));
    }
    CHECK(after > 2.0 * before);
}

TEST_CASE("A part of a clip starts and ends where it is told to", "[devices]")
{
    Clip clip = steadyClip(1.0);
    clip.bands[0].amplitude = {{0.0, 0.0}, {1.0, 1.0}};
    const auto states = statesOf<MotorLevels>(clip, dualShock, {Seconds(0.2), Seconds(0.4), false});
    CHECK(levelOf(states[2]) == Approx(0.225).epsilon(0.1));
    CHECK(levelOf(states[18]) == Approx(0.385).epsilon(0.1));
    CHECK(states.size() >= 20);
    CHECK(states.size() <= 26);
}

TEST_CASE("A loop goes on where it starts, with its events each time", "[devices]")
{
    const Clip clip = steadyClip(0.0, {{0.1, 1.0, 0.5}, {0.6, 1.0, 0.5}});
    const auto states = statesOf<WaveformState>(clip, touchpad, {Seconds(0.0), Seconds(1.0), true}, 150);
    CHECK(eventsOf(states) == std::vector<std::size_t>{5, 30, 55, 80, 105, 130});
}

TEST_CASE("Every event is triggered once, in the packet that starts nearest to it, also on top of a rumble",
          "[devices]")
{
    for (const double bands : {0.0, 0.5})
    {
        std::vector<Transient> roll;
        for (const double time : {0.1, 0.149, 0.151, 0.3, 0.4, 0.42, 0.5})
            roll.push_back({time, 0.7, 0.5});
        const auto states = statesOf<WaveformState>(steadyClip(bands, roll), touchpad);
        CHECK(eventsOf(states) == std::vector<std::size_t>{5, 7, 8, 15, 20, 21, 25});
        CHECK(states[15].intensity > 0.4);
    }
    CHECK(eventsOf(statesOf<WaveformState>(steadyClip(0.5), touchpad)).empty());
}

TEST_CASE("Events of packets that were left out come in the next", "[devices]")
{
    ClipRumble rumble(steadyClip(0.0, {{0.1, 1.0, 0.5}, {0.11, 1.0, 0.5}}), wholeClip, 0_dB, touchpad);
    static_cast<void>(rumble.at(0));
    const auto late = std::get<WaveformState>(rumble.at(20).value());
    CHECK(late.waveform == Waveform::event);
    CHECK(late.begins);
    CHECK(late.intensity > 0.3);
    CHECK_FALSE(std::get<WaveformState>(rumble.at(21).value()).begins);
}

TEST_CASE("Motors are held up for an event for 30 ms", "[devices]")
{
    const auto states = statesOf<MotorLevels>(steadyClip(0.0, {{0.3, 0.8, 1.0}}), dualShock);
    std::size_t held = 0;
    for (const MotorLevels& each : states)
        held += levelOf(each) > 0.25 ? 1u : 0u;
    CHECK(held >= 3);
    CHECK(held <= 4);
    CHECK(states[30].weak > states[30].strong); // a crisp one
}

TEST_CASE("What a clip plays fades out and ends", "[devices]")
{
    for (const auto haptics : {ControllerHaptics::hdRumble, ControllerHaptics::dualSense, ControllerHaptics::waveforms,
                               ControllerHaptics::steamController})
    {
        CAPTURE(static_cast<int>(haptics));
        const ControllerModel model{haptics, Transport::usb, standardTrigger()};
        ClipRumble rumble(steadyClip(0.5, {{1.0, 1.0, 1.0}}), wholeClip, 20_dB, model);
        std::int64_t packet = 0;
        while (rumble.at(packet))
            REQUIRE(++packet < 1000);
        CHECK(static_cast<double>(packet) * pacingOf(model).interval.value > 1.0);
        CHECK(static_cast<double>(packet) * pacingOf(model).interval.value < 1.15);
    }
}

TEST_CASE("On waveforms an event has its own time, then what lasts goes on", "[devices]")
{
    ControllerModel model = touchpad;
    model.trigger.eventTime = 45_ms; // ends within the third packet
    const auto states = statesOf<WaveformState>(steadyClip(0.2, {{0.5, 1.0, 1.0}}), model);
    for (std::size_t packet = 1; packet < 40; ++packet)
    {
        CAPTURE(packet);
        const bool isEvent = packet >= 25 && packet < 28;
        CHECK(states[packet].waveform == (isEvent ? Waveform::event : Waveform::rumble)); // 150 Hz
        CHECK(states[packet].begins == (packet == 25));
        if (!isEvent)
            CHECK(states[packet].intensity == Approx(0.2).epsilon(0.15));
    }
    CHECK(states[25].intensity > 0.4);
}

TEST_CASE("High bands buzz, low ones rumble, and both together are as intense as their energy", "[devices]")
{
    Clip clip = steadyClip(0.3);
    clip.bands.push_back({350.0, 400.0, 450.0, 0, {{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.4}, {1.0, 0.4}}, {}});
    const auto states = statesOf<WaveformState>(clip, touchpad);
    CHECK(states[20].waveform == Waveform::rumble);
    CHECK(states[20].intensity == Approx(0.3).epsilon(0.05));
    CHECK(states[40].waveform == Waveform::buzz);
    CHECK(states[40].intensity == Approx(0.5).epsilon(0.05));
}

TEST_CASE("A lasting waveform that ends is triggered again before it has ended", "[devices]")
{
    ControllerModel model = touchpad;
    model.trigger.rumbleTime = 50_ms;
    model.trigger.event = 0;
    const auto states = statesOf<WaveformState>(steadyClip(0.5), model);
    for (std::size_t packet = 0; packet < 10; ++packet)
        CHECK(states[packet].begins == (packet % 2 == 0)); // every 40 ms
}

TEST_CASE("A device without lasting waveforms plays events only, one without events short pieces", "[devices]")
{
    const Clip clip = steadyClip(0.1, {{0.5, 1.0, 0.0}});
    ControllerModel clicks = touchpad;
    clicks.trigger.buzz = clicks.trigger.rumble = 0;
    const auto clicked = statesOf<WaveformState>(clip, clicks);
    ControllerModel rumbles = touchpad;
    rumbles.trigger.event = 0;
    const auto rumbled = statesOf<WaveformState>(clip, rumbles);
    for (std::size_t packet = 1; packet < 40; ++packet)
    {
        CAPTURE(packet);
        CHECK(clicked[packet].waveform == (packet == 25 ? Waveform::event : Waveform::stop));
        CHECK(rumbled[packet].waveform == Waveform::rumble);
        const bool isHeld = packet == 25 || packet == 26; // 30 ms
        CHECK((rumbled[packet].intensity > 0.4) == isHeld);
    }
}
