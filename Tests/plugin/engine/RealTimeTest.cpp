// Nothing on the audio thread touches the heap, whatever happens around it.

#include "plugin/engine/Rig.h"
#include "support/HeapGuard.h"

#include <juce_events/juce_events.h>

#include <atomic>
#include <thread>

using namespace pacini;
using namespace pacini::test;
using plugin::ParameterId;

namespace
{
/// Processes blocks and counts the heap traffic of their thread; `before` counts too.
std::size_t trafficOf(plugin::PluginProcessor& plugin, int blocks, const std::function<void(int)>& before)
{
    juce::AudioBuffer<float> buffer(3, 256);
    juce::MidiBuffer midi;
    const auto sound = liveSound(256, 3);
    std::size_t traffic = 0;
    for (int block = 0; block < blocks; ++block)
    {
        for (int c = 0; c < 3; ++c)
            buffer.copyFrom(c, 0, sound.data(), 256);
        const HeapGuard guard;
        before(block);
        plugin.processBlock(buffer, midi);
        traffic += guard.traffic();
    }
    return traffic;
}
} // namespace

TEST_CASE("Processing makes no heap traffic, nor does automation of every parameter in every block")
{
    Rig rig;
    Random random(3);
    CHECK(trafficOf(rig.plugin, 100, [](int) {}) == 0);
    CHECK(trafficOf(rig.plugin, 500,
                    [&](int)
                    {
                        for (const auto& row : plugin::parameterTable)
                            rig.plugin.parameter(row.parameter).setValue(static_cast<float>(random.uniform()));
                    }) == 0);
    CHECK(trafficOf(rig.plugin, 10, [&](int) { rig.plugin.reset(); }) == 0);
}

TEST_CASE("Automation of everything in every block stays finite and within full drive")
{
    Rig rig;
    Random random(5);
    const auto in = liveSounds(2, 96000, 5);
    const auto out = rig.run(in, {in[0]}, {64},
                             [&](std::size_t)
                             {
                                 for (const auto& row : plugin::parameterTable)
                                     rig.plugin.parameter(row.parameter).setValue(static_cast<float>(random.uniform()));
                             });
    for (const float y : out.haptic[0])
        REQUIRE(std::abs(y) <= 1.0f);
    for (const float y : out.main[0])
        REQUIRE(std::isfinite(y));
}

TEST_CASE("Other actuators and states that come while sound plays make no heap traffic on the audio thread")
{
    const juce::ScopedJuceInitialiser_GUI messages;
    Rig rig, other;
    other.set(ParameterId::profile, 5.0);
    other.set(ParameterId::rumbleLevel, -9.0);
    juce::MemoryBlock state;
    other.plugin.getStateInformation(state);

    std::atomic<bool> playing{true};
    std::atomic<int> blocks{0};
    std::size_t traffic = 0;
    std::thread audio(
        [&]
        {
            while (playing)
            {
                traffic += trafficOf(rig.plugin, 1, [](int) {});
                ++blocks;
            }
        });
    juce::MemoryBlock saved;
    for (int i = 0; i < 60; ++i)
    {
        if (i % 3 == 0)
            rig.plugin.setStateInformation(state.getData(), static_cast<int>(state.getSize()));
        else
            rig.set(ParameterId::profile, i % 12);
        rig.plugin.getStateInformation(saved);
        const int seen = blocks;
        while (blocks < seen + 3)
            std::this_thread::yield();
    }
    playing = false;
    audio.join();
    CHECK(blocks > 180);
    CHECK(traffic == 0);
}

TEST_CASE("State can be saved from a background thread while sound plays and parameters move")
{
    const juce::ScopedJuceInitialiser_GUI messages;
    Rig rig;
    std::atomic<bool> running{true};
    std::thread audio(
        [&]
        {
            while (running)
                (void)trafficOf(rig.plugin, 1, [](int) {});
        });
    constexpr std::size_t wantedSaves = 20;
    std::atomic<std::size_t> saves{0}, spoilt{0};
    std::thread saver(
        [&]
        {
            while (running)
            {
                juce::MemoryBlock block;
                rig.plugin.getStateInformation(block);
                const auto read = plugin::readState({static_cast<const char*>(block.getData()), block.getSize()});
                ++(read.ok() ? saves : spoilt);
            }
        });
    Random random(9);
    for (int i = 0; i < 300 || (saves + spoilt < wantedSaves && i < 100000); ++i)
        for (const auto& row : plugin::parameterTable)
            rig.plugin.parameter(row.parameter).setValueNotifyingHost(static_cast<float>(random.uniform()));
    running = false;
    audio.join();
    saver.join();
    CHECK(saves >= wantedSaves);
    CHECK(spoilt == 0);
}

TEST_CASE("An actuator chosen by automation is taken without anybody's help")
{
    Rig rig;
    CHECK(rig.plugin.actuatorName() == "Flat drive");
    rig.plugin.parameter(ParameterId::profile).setValue(1.0f / 31.0f);
    for (int i = 0; i < 500 && rig.plugin.actuatorName() == "Flat drive"; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK(rig.plugin.actuatorName() == "L5 wristband");
}
