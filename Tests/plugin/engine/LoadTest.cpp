// How much time the plugin takes: `pacini_plugin_tests [.bench]`. Figures, no checks.

#include "plugin/engine/Rig.h"

#include <pacini/realtime/Translator.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

using namespace pacini;
using namespace pacini::test;
using plugin::ParameterId;

namespace
{
using Clock = std::chrono::steady_clock;

double microseconds(Clock::duration span)
{
    return std::chrono::duration<double, std::micro>(span).count();
}
} // namespace

TEST_CASE("A hundred instances at 48 kHz in blocks of 256 on one core", "[.bench]")
{
    constexpr int frames = 256;
    constexpr double blockTime = 1e6 * frames / 48000.0; // microseconds
    for (const auto& [name, profile] :
         {std::pair("flat drive", 0), std::pair("L5 wristband", 1), std::pair("LRA 175 Hz", 3)})
    {
        std::vector<std::unique_ptr<Rig>> rigs;
        for (int i = 0; i < 100; ++i)
        {
            rigs.push_back(std::make_unique<Rig>());
            rigs.back()->set(ParameterId::profile, profile);
            rigs.back()->plugin.prepareToPlay(48000.0, frames);
        }
        const auto sound = liveSounds(2, 48000, 3);
        juce::MidiBuffer midi;
        juce::AudioBuffer<float> buffer(3, frames);
        std::vector<double> all, one;
        for (int block = 0; block < 5 * 187; ++block)
        {
            const auto begin = Clock::now();
            for (const auto& rig : rigs)
            {
                for (int c = 0; c < 2; ++c)
                    buffer.copyFrom(c, 0, sound[static_cast<std::size_t>(c)].data() + (block % 187) * frames, frames);
                const auto before = Clock::now();
                rig->plugin.processBlock(buffer, midi);
                one.push_back(microseconds(Clock::now() - before));
            }
            all.push_back(microseconds(Clock::now() - begin));
        }
        std::sort(all.begin(), all.end());
        std::sort(one.begin(), one.end());
        const auto at = [](const std::vector<double>& sorted, double share)
        {
            return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
        };
        std::printf("%-14s 100 instances: median %6.0f us, p99 %6.0f us of %.0f us a block (%.1f %% of one core); one: "
                    "median %.2f us, p99 %.2f us (%.3f %%)\n",
                    name, at(all, 0.5), at(all, 0.99), blockTime, 100.0 * at(all, 0.5) / blockTime, at(one, 0.5),
                    at(one, 0.99), 100.0 * at(one, 0.5) / blockTime);
    }
    Rig rig;
    std::printf("latency %d frames at 48 kHz, %.2f ms\n", rig.plugin.getLatencySamples(),
                rig.plugin.getLatencySamples() / 48.0);
}

TEST_CASE("What the plugin adds to its translator", "[.bench]")
{
    constexpr int frames = 256;
    const auto sound = liveSound(48000, 3);
    double plain = 1e9, wrapped = 1e9;
    for (int repeat = 0; repeat < 20; ++repeat)
    {
        Translator translator;
        translator.prepare({48000.0, frames});
        std::vector<float> drive(frames);
        auto begin = Clock::now();
        for (std::size_t i = 0; i + frames <= sound.size(); i += frames)
            translator.process(std::span(sound).subspan(i, frames), drive);
        plain = std::min(plain, microseconds(Clock::now() - begin));

        Rig rig;
        juce::AudioBuffer<float> buffer(3, frames);
        juce::MidiBuffer midi;
        Clock::duration span{};
        for (std::size_t i = 0; i + frames <= sound.size(); i += frames)
        {
            buffer.copyFrom(0, 0, sound.data() + i, frames);
            buffer.copyFrom(1, 0, sound.data() + i, frames);
            begin = Clock::now();
            rig.plugin.processBlock(buffer, midi);
            span += Clock::now() - begin;
        }
        wrapped = std::min(wrapped, microseconds(span));
    }
    const double blocks = 48000.0 / frames;
    std::printf("a block of 256: translator %.2f us, plugin %.2f us\n", plain / blocks, wrapped / blocks);
}

TEST_CASE("What each further haptic channel takes", "[.bench]")
{
    constexpr int frames = 256;
    const auto sound = liveSounds(2, 48000, 3);
    const auto share = [&](int channels, int actuators, bool moving)
    {
        RigLayout layout;
        layout.haptic = channels;
        Rig rig(layout);
        for (int c = 1; c < actuators; ++c)
            rig.set(plugin::channelParameter(static_cast<std::size_t>(c), plugin::ChannelSetting::actuator), 1.0 + c);
        rig.set(ParameterId::pan, moving ? 1.0 : 0.0);
        rig.set(ParameterId::panLaw, 2.0);
        rig.plugin.prepareToPlay(48000.0, frames);
        juce::AudioBuffer<float> buffer(2 + std::max(channels, 1), frames);
        juce::MidiBuffer midi;
        double least = 1e9;
        for (int repeat = 0; repeat < 40; ++repeat)
        {
            Clock::duration span{};
            for (int block = 0; block < 187; ++block)
            {
                rig.set(ParameterId::position, 0.5 + 0.4 * std::sin(0.05 * block));
                for (int c = 0; c < 2; ++c)
                    buffer.copyFrom(c, 0, sound[static_cast<std::size_t>(c)].data() + block * frames, frames);
                const auto begin = Clock::now();
                rig.plugin.processBlock(buffer, midi);
                span += Clock::now() - begin;
            }
            least = std::min(least, microseconds(span));
        }
        return 100.0 * least / (1e6 * 187 * frames / 48000.0); // % of one core
    };
    const double one = share(1, 1, false);
    std::printf("one channel %.4f %% of one core; each further one: carries the same %.4f %%, moves by level and delay "
                "%.4f %%, with an actuator of its own %.4f %%\n",
                one, (share(8, 1, false) - one) / 7.0, (share(8, 1, true) - one) / 7.0,
                (share(8, 8, false) - one) / 7.0);
}

TEST_CASE("What a plugin takes in silence", "[.bench]")
{
    constexpr int frames = 256;
    const auto sound = liveSounds(2, 48000, 3);
    Rig rig;
    juce::AudioBuffer<float> buffer(3, frames);
    juce::MidiBuffer midi;
    const auto second = [&](bool silent)
    {
        Clock::duration span{};
        for (int block = 0; block < 187; ++block)
        {
            buffer.clear();
            for (int c = 0; c < 2 && !silent; ++c)
                buffer.copyFrom(c, 0, sound[static_cast<std::size_t>(c)].data() + block * frames, frames);
            const auto begin = Clock::now();
            rig.plugin.processBlock(buffer, midi);
            span += Clock::now() - begin;
        }
        return microseconds(span) / 187.0;
    };
    double plays = 1e9, justSilent = 1e9, atRest = 1e9;
    for (int repeat = 0; repeat < 20; ++repeat)
    {
        plays = std::min(plays, second(false));
        justSilent = std::min(justSilent, (second(true), second(true))); // before it rests
        (void)second(true);
        atRest = std::min(atRest, second(true));
    }
    std::printf("a block of 256: sound %.2f us, silence of a second %.2f us (%.3f of sound), of three seconds %.3f us "
                "(%.3f)\n",
                plays, justSilent, justSilent / plays, atRest, atRest / plays);
}
