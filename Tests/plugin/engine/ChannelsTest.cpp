// Several actuators on one sound: gain, delay, place and translation of each haptic channel.

#include "plugin/engine/Rig.h"
#include "support/HeapGuard.h"
#include "support/Paths.h"

#include <numeric>

using namespace pacini;
using namespace pacini::test;
using plugin::channelParameter;
using plugin::ChannelSetting;
using plugin::PanChoice;
using plugin::ParameterId;

namespace
{
constexpr std::size_t frames = 24000;

RigLayout channelsOf(int haptic, int main = 2)
{
    RigLayout layout;
    layout.haptic = haptic;
    layout.main = main;
    return layout;
}

void set(Rig& rig, std::size_t channel, ChannelSetting setting, double value)
{
    rig.set(channelParameter(channel, setting), value);
}

void set(Rig& rig, PanChoice pan)
{
    rig.set(ParameterId::pan, static_cast<double>(pan));
}

/// From half of a sound on, when everything has come to rest.
double restingEnergy(const std::vector<float>& x)
{
    return energy({x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2), x.end()});
}
} // namespace

TEST_CASE("Unless something is set every haptic channel carries the drive, sample for sample")
{
    const auto in = liveSounds(2, frames, 11);
    Rig one, eight(channelsOf(8));
    const auto expected = one.run(in);
    const auto out = eight.run(in);
    for (const auto& channel : out.haptic)
        CHECK(channel == expected.haptic[0]);
    CHECK(out.main == expected.main);
}

TEST_CASE("Channels have a gain and a delay of their own")
{
    const auto in = liveSounds(2, frames, 12);
    Rig rig(channelsOf(3));
    set(rig, 1, ChannelSetting::gain, -6.0);
    set(rig, 1, ChannelSetting::delay, 10.0);
    set(rig, 2, ChannelSetting::gain, -60.0);
    rig.plugin.reset();
    const auto out = rig.run(in);
    const auto late = delayed(out.haptic[0], 480);
    const float gain = std::pow(10.0f, -6.0f / 20.0f);
    for (std::size_t i = 0; i < frames; ++i)
        REQUIRE(out.haptic[1][i] == Approx(gain * late[i]).margin(1e-6));
    CHECK(energy(out.haptic[2]) == 0.0);
}

TEST_CASE("A position moves the touch between the two nearest actuators and keeps its power")
{
    const auto in = liveSounds(2, frames, 13);
    Rig plain;
    const double whole = restingEnergy(plain.run(in).haptic[0]);
    for (const double position : {0.0, 0.2, 0.5, 0.8, 1.0})
    {
        CAPTURE(position);
        Rig rig(channelsOf(3));
        set(rig, PanChoice::position);
        rig.set(ParameterId::position, position);
        const auto out = rig.run(in);
        double sum = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
        {
            const double distance = std::abs(2.0 * position - static_cast<double>(c));
            const double share = distance < 1.0 ? std::pow(std::cos(0.5 * std::numbers::pi * distance), 2.0) : 0.0;
            CHECK(restingEnergy(out.haptic[c]) == Approx(share * whole).epsilon(1e-4).margin(1e-9 * whole));
            sum += restingEnergy(out.haptic[c]);
        }
        CHECK(sum == Approx(whole).epsilon(1e-4));
    }
}

TEST_CASE("Places that are set count instead of the order of the channels")
{
    const auto in = liveSounds(2, frames, 14);
    Rig rig(channelsOf(3));
    set(rig, PanChoice::position);
    rig.set(ParameterId::places, 1.0);
    set(rig, 0, ChannelSetting::place, 0.9);
    set(rig, 1, ChannelSetting::place, 0.1);
    set(rig, 2, ChannelSetting::place, 0.5);
    rig.set(ParameterId::position, 0.02); // before the first place
    const auto left = rig.run(in);
    CHECK(restingEnergy(left.haptic[1]) > 0.0);
    CHECK(restingEnergy(left.haptic[0]) == 0.0);
    CHECK(restingEnergy(left.haptic[2]) == 0.0);
    rig.set(ParameterId::position, 0.7); // half-way from the third to the first
    const auto right = rig.run(in);
    CHECK(restingEnergy(right.haptic[0]) == Approx(restingEnergy(right.haptic[2])).epsilon(1e-3));
    CHECK(restingEnergy(right.haptic[1]) == 0.0);
}

TEST_CASE("Delay panning makes the farther actuator later, by 10 ms over the row")
{
    const auto in = liveSounds(2, frames, 15);
    Rig rig(channelsOf(2));
    set(rig, PanChoice::position);
    rig.set(ParameterId::panLaw, 1.0);
    rig.set(ParameterId::position, 0.0);
    rig.plugin.reset();
    rig.run(in, {}, {512}); // the position glides here from the middle
    const auto out = rig.run(in);
    const auto late = delayed(out.haptic[0], 480);
    for (std::size_t i = frames / 2; i < frames; ++i)
        REQUIRE(out.haptic[1][i] == Approx(late[i]).margin(1e-5));
}

TEST_CASE("The panorama of the sound moves the touch")
{
    const auto mono = liveSound(frames, 16);
    for (const double place : {0.0, 0.25, 0.5, 1.0})
    {
        CAPTURE(place);
        Channels in(2, mono);
        for (float& x : in[0])
            x *= static_cast<float>(std::cos(0.5 * std::numbers::pi * place));
        for (float& x : in[1])
            x *= static_cast<float>(std::sin(0.5 * std::numbers::pi * place));
        Rig rig(channelsOf(2));
        set(rig, PanChoice::panorama);
        const auto out = rig.run(in);
        const double left = restingEnergy(out.haptic[0]), right = restingEnergy(out.haptic[1]);
        CHECK(std::atan2(std::sqrt(right), std::sqrt(left)) * 2.0 / std::numbers::pi == Approx(place).margin(0.002));
    }
}

TEST_CASE("A channel with an actuator of its own plays what a plugin for that actuator would")
{
    const auto in = liveSounds(2, frames, 17);
    Rig lra, mixed(channelsOf(4));
    lra.set(ParameterId::profile, 3.0);
    lra.plugin.prepareToPlay(48000.0, 512);
    const auto flat = Rig().run(in);
    const auto expected = lra.run(in);
    set(mixed, 1, ChannelSetting::actuator, 4.0); // slot 3
    set(mixed, 3, ChannelSetting::actuator, 4.0);
    mixed.plugin.prepareToPlay(48000.0, 512);
    const auto out = mixed.run(in);
    CHECK(out.haptic[0] == flat.haptic[0]);
    CHECK(out.haptic[1] == expected.haptic[0]);
    CHECK(out.haptic[2] == flat.haptic[0]);
    CHECK(out.haptic[3] == expected.haptic[0]);
    CHECK(mixed.plugin.actuatorName(1) == lra.plugin.actuatorName(0));
    CHECK(mixed.plugin.actuatorName(2) == mixed.plugin.actuatorName(0));
}

TEST_CASE("Where drives take the place of the sound its channels are the row")
{
    const auto in = liveSounds(2, frames, 18);
    Rig rig;
    rig.set(ParameterId::outputMode, static_cast<double>(plugin::OutputMode::replaceMain));
    set(rig, PanChoice::position);
    rig.set(ParameterId::position, 1.0);
    const auto out = rig.run(in);
    CHECK(restingEnergy(out.main[0]) == 0.0);
    CHECK(restingEnergy(out.main[1]) > 0.0);
}

TEST_CASE("Several drives are added to the channels behind the sound, for hosts without a haptic output")
{
    auto in = liveSounds(4, frames, 22);
    std::fill(in[2].begin(), in[2].end(), 0.0f);
    std::fill(in[3].begin(), in[3].end(), 0.0f);
    Rig rig(channelsOf(1, 4));
    rig.set(ParameterId::outputMode, static_cast<double>(plugin::OutputMode::addToChannel));
    rig.set(ParameterId::outputChannel, 3.0);
    rig.set(ParameterId::outputCount, 2.0);
    set(rig, 1, ChannelSetting::delay, 5.0);
    rig.plugin.reset();
    const auto out = rig.run(in);
    CHECK(out.main[2] == out.haptic[0]);
    const auto late = delayed(out.main[2], 240);
    for (std::size_t i = 0; i < frames; ++i)
        REQUIRE(out.main[3][i] == Approx(late[i]).margin(1e-6));
    const auto latency = static_cast<std::size_t>(rig.plugin.getLatencySamples());
    CHECK(out.main[0] == delayed(in[0], latency));
}

TEST_CASE("Blocks leave no trace in moving channels")
{
    const auto in = liveSounds(2, frames, 19);
    const auto run = [&](const std::vector<int>& sizes)
    {
        Rig rig(channelsOf(5));
        set(rig, PanChoice::panorama);
        rig.set(ParameterId::panLaw, 2.0);
        set(rig, 2, ChannelSetting::actuator, 2.0);
        set(rig, 3, ChannelSetting::delay, 7.3);
        rig.plugin.prepareToPlay(48000.0, 512);
        return rig.run(in, {}, sizes);
    };
    const auto expected = run({512});
    CHECK(run({1}) == expected);
    CHECK(run({7, 480, 1, 33}) == expected);
    CHECK(run({24000}) == expected);
}

TEST_CASE("Automation of all channels makes no heap traffic, no jumps above full drive and no end")
{
    Rig rig(channelsOf(8));
    Random random(20);
    const auto in = liveSounds(2, 96000, 20);
    std::size_t traffic = 0;
    const auto out = rig.run(in, {}, {64},
                             [&](std::size_t)
                             {
                                 const HeapGuard guard;
                                 for (const auto& row : plugin::parameterTable)
                                     rig.plugin.parameter(row.parameter).setValue(static_cast<float>(random.uniform()));
                                 traffic += guard.traffic();
                             });
    CHECK(traffic == 0);
    // The cubic through four samples may pass them by a little.
    for (const auto& channel : out.haptic)
        for (const float y : channel)
            REQUIRE(std::abs(y) <= 1.0f);
}

TEST_CASE("Another actuator of a channel fades in: no sample jumps more than the signals do")
{
    std::vector<float> tone(96000);
    for (std::size_t i = 0; i < tone.size(); ++i)
        tone[i] = static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * 60.0 * static_cast<double>(i) / 48000.0));
    Rig rig(channelsOf(2));
    const auto out = rig.run({tone, tone}, {}, {480},
                             [&](std::size_t block)
                             {
                                 if (block == 100)
                                     set(rig, 1, ChannelSetting::actuator, 2.0);
                                 if (block == 150)
                                     set(rig, 1, ChannelSetting::actuator, 0.0);
                                 juce::MemoryBlock state; // as the worker does in time
                                 rig.plugin.getStateInformation(state);
                             });
    float jump = 0.0f;
    for (std::size_t i = 24000; i < tone.size(); ++i)
        jump = std::max(jump, std::abs(out.haptic[1][i] - out.haptic[1][i - 1]));
    CHECK(jump < 0.02f);
    const std::vector<float> end(out.haptic[1].end() - 4800, out.haptic[1].end());
    CHECK(end == std::vector<float>(out.haptic[0].end() - 4800, out.haptic[0].end()));
}

TEST_CASE("Sessions keep the actuators of all channels, as they were")
{
    const auto in = liveSounds(2, frames, 21);
    Rig saved(channelsOf(3));
    set(saved, 1, ChannelSetting::actuator, 4.0);
    REQUIRE(saved.plugin.loadActuator(juce::File((sourceFolder() / "profiles/l5-wristband.json").string()), 2));
    set(saved, 2, ChannelSetting::gain, -3.0);
    saved.plugin.prepareToPlay(48000.0, 512);
    juce::MemoryBlock state;
    saved.plugin.getStateInformation(state);
    Rig loaded(channelsOf(3));
    loaded.plugin.setStateInformation(state.getData(), static_cast<int>(state.getSize()));
    CHECK(loaded.plugin.note().isEmpty());
    CHECK(loaded.plugin.values() == saved.plugin.values());
    loaded.plugin.prepareToPlay(48000.0, 512);
    CHECK(loaded.run(in).haptic == saved.run(in).haptic);
    CHECK(loaded.plugin.actuatorName(2) == saved.plugin.actuatorName(2));
}
