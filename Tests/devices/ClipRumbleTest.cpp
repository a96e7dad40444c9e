#include "devices/ClipRumble.h"

#include "devices/DecodeRumble.h"
#include "devices/WaveformDevice.h"
#include "support/Catch.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
// 1 s of a steady tone of 200 Hz at 0.5, and events where they are asked for.
Clip steadyClip(std::vector<Transient> events = {}, double amplitude = 0.5)
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands.push_back({150.0, 200.0, 250.0, 0, {{0.0, amplitude}, {1.0, amplitude}}, {}});
    clip.transients = std::move(events);
    return clip;
}

constexpr PlayRange wholeClip{Seconds(0.0), Seconds(1.0), false};

// The packets that begin an event, of the first `count`.
std::vector<std::int64_t> packetsWithEvents(ClipPackets& packets, std::int64_t count)
{
    std::vector<std::int64_t> found;
    for (std::int64_t packet = 0; packet < count; ++packet)
        if (packets.at(packet).event)
            found.push_back(packet);
    return found;
}

const SidesRumble& sidesOf(const std::optional<RumbleState>& state)
{
    return std::get<SidesRumble>(*state);
}

const MotorLevels& motorsOf(const std::optional<RumbleState>& state)
{
    return std::get<MotorLevels>(*state);
}

const WaveformState& waveformOf(const std::optional<RumbleState>& state)
{
    return std::get<WaveformState>(*state);
}

// The first states that a device of waveforms plays.
std::vector<WaveformState> waveformsOf(const Clip& clip, const WaveformTrigger& trigger, std::int64_t count)
{
    ClipRumble rumble(clip, wholeClip, 0_dB, {ControllerHaptics::waveforms, Transport::usb, trigger});
    std::vector<WaveformState> states;
    for (std::int64_t packet = 0; packet < count; ++packet)
        states.push_back(waveformOf(rumble.at(packet)));
    return states;
}
} // namespace

TEST_CASE("A clip's bands are as long as the clip, the last packet in proportion", "[devices]")
{
    ClipPackets packets(steadyClip(), wholeClip, 2.0, 15_ms);
    CHECK(packets.count() == 68); // 66.7 packets, and one for an event at the very end
    CHECK(packets.at(0).bands[0].amplitude == Approx(1.0));
    CHECK(packets.at(65).bands[0].amplitude == Approx(1.0));
    CHECK(packets.at(66).bands[0].amplitude == Approx(std::sqrt(2.0 / 3.0)).epsilon(1e-6)); // 10 ms of 15
    CHECK(packets.at(67).bands[0].amplitude == 0.0);
}

TEST_CASE("A part of a clip starts and ends where it is told to", "[devices]")
{
    Clip clip = steadyClip({{0.1, 1.0, 0.5}, {0.3, 1.0, 0.5}, {0.5, 1.0, 0.5}});
    clip.bands[0].amplitude = {{0.0, 0.0}, {1.0, 1.0}};
    ClipPackets packets(clip, {Seconds(0.2), Seconds(0.4), false}, 1.0, 10_ms);
    CHECK(packets.at(0).bands[0].amplitude == Approx(0.205).epsilon(1e-3));
    CHECK(packets.at(19).bands[0].amplitude == Approx(0.395).epsilon(1e-3));
    CHECK(packets.at(21).bands[0].amplitude == 0.0);
    ClipPackets again(clip, {Seconds(0.2), Seconds(0.4), false}, 1.0, 10_ms);
    CHECK(packetsWithEvents(again, 40) == std::vector<std::int64_t>{10});
}

TEST_CASE("Every event is played once, in the packet that starts nearest to it", "[devices]")
{
    const std::vector<Transient> events{{0.0, 1.0, 0.0}, {0.0221, 1.0, 0.0}, {0.3, 1.0, 1.0}, {1.0, 1.0, 1.0}};
    ClipPackets packets(steadyClip(events), wholeClip, 1.0, 15_ms);
    CHECK(packetsWithEvents(packets, 80) == std::vector<std::int64_t>{0, 1, 20, 67});

    // Those of packets that were left out come in the next.
    ClipPackets late(steadyClip(events), wholeClip, 1.0, 15_ms);
    static_cast<void>(late.at(0));
    CHECK(late.at(30).event);
    CHECK_FALSE(late.at(31).event);
}

TEST_CASE("A loop goes on where it starts, with its events each time", "[devices]")
{
    Clip clip = steadyClip({{0.0, 1.0, 0.5}, {0.5, 1.0, 0.5}, {1.0, 1.0, 0.5}});
    clip.bands[0].amplitude = {{0.0, 0.0}, {1.0, 1.0}};
    const PlayRange range{Seconds(0.0), Seconds(1.0), true};
    ClipPackets packets(clip, range, 1.0, 10_ms);
    CHECK_FALSE(packets.count());
    CHECK(packetsWithEvents(packets, 275) == std::vector<std::int64_t>{0, 50, 100, 150, 200, 250});
    CHECK(packets.at(1025).bands[0].amplitude == Approx(0.255).epsilon(1e-3));
}

TEST_CASE("An event has the pulse of the decoder and does not play the energy of the bands twice", "[devices]")
{
    ClipPackets dull(steadyClip({{0.5, 0.8, 0.0}}), wholeClip, 0.5, 15_ms);
    static_cast<void>(dull.at(0));
    const auto event = dull.at(33).event;
    REQUIRE(event);
    CHECK(event->tone.frequency.value == Approx(100.0));
    CHECK(event->tone.amplitude == Approx(0.4));

    Clip clip = steadyClip({{0.5, 0.5, 1.0}, {0.6, 1.0, 1.0}});
    clip.envelope = {{0.0, 0.3}, {1.0, 0.3}}; // bands reach twice as much, 0.6
    ClipPackets masked(clip, wholeClip, 1.0, 15_ms);
    const auto first = masked.at(35).event;
    REQUIRE(first);
    CHECK(first->tone.amplitude == 0.0);
    CHECK(first->level == 0.5);
    const auto second = masked.at(45).event;
    REQUIRE(second);
    CHECK(second->tone.frequency.value == Approx(280.0));
    CHECK(second->tone.amplitude == Approx(0.8)); // 0.6, 0.8, 1
    CHECK(second->level == 1.0);

    // Of two in one packet, the one that the bands do not reach.
    clip.transients = {{0.5, 0.58, 0.0}, {0.505, 0.6, 0.5}, {0.51, 0.65, 1.0}};
    const auto strongest = ClipPackets(clip, wholeClip, 1.0, 30_ms).at(20).event;
    REQUIRE(strongest);
    CHECK(strongest->sharpness == 1.0);
}

TEST_CASE("A pulse joins the carrier that it is nearest to and is over with its packet", "[devices]")
{
    ClipRumble rumble(steadyClip({{0.3, 0.9, 1.0}}, 0.25), wholeClip, 0_dB, {ControllerHaptics::hdRumble});
    RumbleTones before{}, with{}, after{};
    for (std::int64_t packet = 0; packet <= 21; ++packet)
    {
        const auto tones = decodeRumble(sidesOf(rumble.at(packet)).left);
        REQUIRE(tones);
        (packet < 20 ? before : packet == 20 ? with : after) = *tones;
    }
    CHECK(before.high.amplitude == 0.0);
    CHECK(before.low.amplitude == Approx(0.25).epsilon(0.02));
    CHECK(with.high.frequency.value == Approx(280.0).epsilon(0.011)); // half a step of 2.2 %
    // 0.9 and 0.25 are more than an actuator bears: both shrink alike.
    CHECK(with.high.amplitude == Approx(0.9 / 1.15).epsilon(0.02));
    CHECK(with.low.amplitude == Approx(0.25 / 1.15).epsilon(0.02));
    CHECK(after == before);
}

TEST_CASE("Motors share energy at the border of the carriers and are held up for an event", "[devices]")
{
    const std::vector<RumbleTone> bands{{100_Hz, 0.3}, {200_Hz, 0.4}, {300_Hz, 0.6}, {900_Hz, 0.9}, {50_Hz, NAN}};
    CHECK(devices::motorsOf(bands).strong == Approx(0.5));
    CHECK(devices::motorsOf(bands).weak == Approx(1.0));

    ClipRumble rumble(steadyClip({{0.32, 0.8, 0.36}}, 0.1), wholeClip, 0_dB, {ControllerHaptics::xbox});
    for (std::int64_t packet = 0; packet < 24; ++packet)
    {
        const MotorLevels levels = motorsOf(rumble.at(packet));
        CAPTURE(packet);
        const bool held = packet == 20 || packet == 21; // 32 ms from 0.32 s on
        CHECK(levels.strong == Approx(held ? 0.8 * 0.8 : 0.1));
        CHECK(levels.weak == Approx(held ? 0.8 * 0.6 : 0.0));
    }
}

TEST_CASE("An event that the bands reach is still a click, and holds motors up; HD rumble has it already", "[devices]")
{
    Clip clip = steadyClip({{0.32, 0.5, 0.36}}, 0.1);
    clip.envelope = {{0.0, 0.3}, {1.0, 0.3}};
    const auto atEvent = [&](const ControllerModel& model)
    {
        ClipRumble rumble(clip, wholeClip, 0_dB, model);
        const double packet = std::round(0.32 / pacingOf(model).interval.value);
        std::optional<RumbleState> state;
        for (std::int64_t n = 0; n <= static_cast<std::int64_t>(packet); ++n)
            state = rumble.at(n);
        return state;
    };
    CHECK(motorsOf(atEvent({ControllerHaptics::xbox})).strong == Approx(0.5 * 0.8));
    const WaveformState clicked =
        waveformOf(atEvent({ControllerHaptics::waveforms, Transport::usb, standardTrigger()}));
    CHECK(clicked == WaveformState{devices::Waveform::event, 0.5, true});
    const auto tones = decodeRumble(sidesOf(atEvent({ControllerHaptics::hdRumble})).left);
    REQUIRE(tones);
    CHECK(tones->high.amplitude == 0.0);
}

TEST_CASE("What a clip plays fades out and ends", "[devices]")
{
    for (const auto haptics : {ControllerHaptics::hdRumble, ControllerHaptics::dualSense, ControllerHaptics::waveforms})
    {
        ClipRumble rumble(steadyClip({{1.0, 1.0, 1.0}}), wholeClip, 20_dB,
                          {haptics, Transport::usb, standardTrigger()});
        const Seconds interval = pacingOf({haptics}).interval;
        std::int64_t packet = 0;
        std::optional<RumbleState> last;
        while (const auto state = rumble.at(packet))
        {
            last = state;
            ++packet;
            REQUIRE(packet < 1000);
        }
        CHECK(static_cast<double>(packet) * interval.value > 1.0);
        CHECK(static_cast<double>(packet) * interval.value < 1.1);
        CHECK(last != silentState(haptics));
    }
}

TEST_CASE("On waveforms an event has its own time, then what lasts goes on", "[devices]")
{
    WaveformTrigger trigger = standardTrigger();
    trigger.eventTime = 45_ms; // ends within the third packet
    const auto states = waveformsOf(steadyClip({{0.2, 0.8, 1.0}, {0.22, 0.9, 1.0}}, 0.25), trigger, 20);
    for (std::size_t packet = 0; packet < states.size(); ++packet)
    {
        CAPTURE(packet);
        const bool isEvent = packet >= 10 && packet < 14;
        CHECK(states[packet].waveform == (isEvent ? devices::Waveform::event : devices::Waveform::rumble)); // 200 Hz
        CHECK(states[packet].begins == (packet == 10 || packet == 11));
        CHECK(states[packet].intensity == Approx(packet == 10 ? 0.8 : isEvent ? 0.9 : 0.25));
    }
}

TEST_CASE("High bands buzz, low ones rumble, and both together are as intense as their energy", "[devices]")
{
    Clip clip = steadyClip({}, 0.3);
    clip.bands.push_back({350.0, 400.0, 450.0, 0, {{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.4}, {1.0, 0.4}}, {}});
    const auto states = waveformsOf(clip, standardTrigger(), 45);
    CHECK(states[10] == WaveformState{devices::Waveform::rumble, states[10].intensity, false});
    CHECK(states[10].intensity == Approx(0.3));
    CHECK(states[40].waveform == devices::Waveform::buzz);
    CHECK(states[40].intensity == Approx(0.5));
}

TEST_CASE("A lasting waveform that ends is triggered again before it has ended", "[devices]")
{
    WaveformTrigger trigger = standardTrigger();
    trigger.rumbleTime = 50_ms;
    const auto states = waveformsOf(steadyClip(), trigger, 10);
    for (std::size_t packet = 0; packet < states.size(); ++packet)
        CHECK(states[packet].begins == (packet % 2 == 0)); // every 40 ms
}

TEST_CASE("A device without lasting waveforms plays events only, one without events short pieces", "[devices]")
{
    const Clip clip = steadyClip({{0.2, 1.0, 0.0}}, 0.1);
    WaveformTrigger clicks = standardTrigger();
    clicks.buzz = clicks.rumble = 0;
    const auto clicked = waveformsOf(clip, clicks, 20);
    WaveformTrigger rumbles = standardTrigger();
    rumbles.event = 0;
    const auto rumbled = waveformsOf(clip, rumbles, 20);
    for (std::size_t packet = 0; packet < 20; ++packet)
    {
        CAPTURE(packet);
        CHECK(clicked[packet].waveform == (packet == 10 ? devices::Waveform::event : devices::Waveform::stop));
        CHECK(rumbled[packet].waveform == devices::Waveform::rumble);
        const bool isHeld = packet == 10 || packet == 11; // 30 ms
        CHECK(rumbled[packet].intensity == Approx(isHeld ? 1.0 : 0.1));
    }
}
