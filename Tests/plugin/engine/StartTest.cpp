// Where playback starts, and how the actuator was set, decides nothing.

#include "plugin/engine/Rig.h"

using namespace pacini;
using namespace pacini::test;
using plugin::ParameterId;

namespace
{
constexpr double lra = 3.0;

/// Two tones that one actuator plays on one frequency, from `start` ms on.
std::vector<float> twoTones(std::size_t frames, double start)
{
    std::vector<float> x(frames);
    for (std::size_t i = 0; i < frames; ++i)
    {
        const double turn = 2.0 * std::numbers::pi * (static_cast<double>(i) / 48000.0 + 0.001 * start);
        x[i] = static_cast<float>(0.3 * std::sin(80.0 * turn) + 0.2 * std::sin(190.0 * turn));
    }
    return x;
}
} // namespace

TEST_CASE("The level of two tones on an LRA does not depend on where playback starts")
{
    double weakest = 1e9, strongest = 0.0;
    for (int start = 0; start < 10; ++start)
    {
        Rig rig({.main = 1, .sidechain = 0});
        rig.set(ParameterId::profile, lra);
        rig.set(ParameterId::strength, 0.4);
        rig.plugin.prepareToPlay(48000.0, 512);
        const auto drive = rig.run({twoTones(96000, start)}).haptic[0];
        const double power = energy({drive.begin() + 48000, drive.end()});
        weakest = std::min(weakest, power);
        strongest = std::max(strongest, power);
    }
    CAPTURE(weakest, strongest);
    CHECK(10.0 * std::log10(strongest / weakest) < 0.5);
}

TEST_CASE("The drive is the same, sample for sample, however the actuator was set before it plays")
{
    const Channels sound{twoTones(48000, 0.0)};
    const RigLayout mono{.main = 1, .sidechain = 0};
    const auto choose = [](Rig& rig)
    {
        rig.set(ParameterId::profile, lra);
        rig.set(ParameterId::strength, 0.4);
    };
    Rig prepared(mono);
    choose(prepared);
    prepared.plugin.prepareToPlay(48000.0, 512);
    const auto expected = prepared.run(sound);
    juce::MemoryBlock state;
    prepared.plugin.getStateInformation(state);

    Rig offline(mono); // by automation of the first block
    offline.plugin.setNonRealtime(true);
    choose(offline);
    CHECK(offline.run(sound) == expected);

    Rig reloaded(mono); // after it was prepared
    reloaded.plugin.setStateInformation(state.getData(), static_cast<int>(state.getSize()));
    CHECK(reloaded.run(sound, {}, {64}) == expected);

    Rig again(mono); // that has played something else
    (void)again.run(sound);
    choose(again);
    again.plugin.getStateInformation(state); // as the worker does in time
    again.plugin.reset();
    CHECK(again.run(sound, {}, {333}) == expected);

    Rig early(mono);
    early.plugin.setStateInformation(state.getData(), static_cast<int>(state.getSize()));
    early.plugin.prepareToPlay(48000.0, 512);
    early.plugin.setNonRealtime(true);
    CHECK(early.run(sound, {}, {4096}) == expected);
}
