#pragma once

// A host for one plugin, as small as can be.

#include "plugin/engine/PluginProcessor.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

namespace pacini::test
{

using Channels = std::vector<std::vector<float>>;

struct RigLayout
{
    double rate = 48000.0;
    int main = 2, sidechain = 1, haptic = 1; ///< channels; 0: the bus is off
};

inline juce::AudioChannelSet channelSet(int channels)
{
    return channels == 0 ? juce::AudioChannelSet::disabled() : juce::AudioChannelSet::canonicalChannelSet(channels);
}

inline juce::AudioProcessor::BusesLayout busesLayout(const RigLayout& layout)
{
    juce::AudioProcessor::BusesLayout buses;
    buses.inputBuses = {channelSet(layout.main), channelSet(layout.sidechain)};
    buses.outputBuses = {channelSet(layout.main), channelSet(layout.haptic)};
    return buses;
}

/// `Plugin`: the processor, with or without its window.
template <typename Plugin>
class RigOf
{
public:
    struct Output
    {
        Channels main, haptic;
        bool operator==(const Output&) const = default;
    };

    explicit RigOf(const RigLayout& wanted = {}, int announcedBlock = 512) : layout(wanted)
    {
        if constexpr (requires { plugin.setUserFolder(juce::File()); })
            plugin.setUserFolder(juce::File(juce::String((home / "user").string())));
        REQUIRE(plugin.setBusesLayout(busesLayout(layout)));
        plugin.setRateAndBufferSizeDetails(layout.rate, announcedBlock);
        plugin.prepareToPlay(layout.rate, announcedBlock);
    }

    void set(plugin::ParameterId id, double value) { plugin.parameter(id).setPlainNotifyingHost(value); }

    /// Processes everything in blocks of `sizes` in turn; `before` is called with the number of each block.
    Output run(const Channels& main, const Channels& sidechain = {}, std::vector<int> sizes = {512},
               const std::function<void(std::size_t)>& before = {})
    {
        const std::size_t frames = main.empty() ? sidechain[0].size() : main[0].size();
        Output out;
        out.main.assign(static_cast<std::size_t>(layout.main), std::vector<float>(frames));
        out.haptic.assign(static_cast<std::size_t>(layout.haptic), std::vector<float>(frames));
        const int channels = std::max(layout.main + layout.sidechain, layout.main + layout.haptic);
        juce::MidiBuffer midi;
        std::size_t done = 0;
        for (std::size_t count = 0; done < frames; ++count)
        {
            const auto n = std::min(static_cast<std::size_t>(sizes[count % sizes.size()]), frames - done);
            juce::AudioBuffer<float> buffer(channels, static_cast<int>(n));
            buffer.clear();
            for (std::size_t c = 0; c < main.size(); ++c)
                std::copy_n(main[c].begin() + static_cast<std::ptrdiff_t>(done), n,
                            buffer.getWritePointer(static_cast<int>(c)));
            for (std::size_t c = 0; c < sidechain.size(); ++c)
                std::copy_n(sidechain[c].begin() + static_cast<std::ptrdiff_t>(done), n,
                            buffer.getWritePointer(layout.main + static_cast<int>(c)));
            if (before)
                before(count);
            plugin.processBlock(buffer, midi);
            for (std::size_t c = 0; c < out.main.size(); ++c)
                std::copy_n(buffer.getReadPointer(static_cast<int>(c)), n,
                            out.main[c].begin() + static_cast<std::ptrdiff_t>(done));
            for (std::size_t c = 0; c < out.haptic.size(); ++c)
                std::copy_n(buffer.getReadPointer(layout.main + static_cast<int>(c)), n,
                            out.haptic[c].begin() + static_cast<std::ptrdiff_t>(done));
            done += n;
        }
        return out;
    }

    TempFolder home; ///< of the user
    Plugin plugin;
    RigLayout layout;
};

using Rig = RigOf<plugin::PluginProcessor>;

/// A tone with clicks and noise: something for every part of the translator.
inline std::vector<float> liveSound(std::size_t frames, std::uint64_t seed, double rate = 48000.0)
{
    Random random(seed);
    std::vector<float> x(frames);
    for (std::size_t i = 0; i < frames; ++i)
    {
        const double t = static_cast<double>(i) / rate;
        const double click = std::exp(-200.0 * std::fmod(t, 0.11));
        x[i] = static_cast<float>(0.3 * std::sin(2.0 * std::numbers::pi * 70.0 * t) +
                                  0.2 * std::sin(2.0 * std::numbers::pi * 240.0 * t) +
                                  (0.05 + 0.4 * click) * random.uniform(-1.0, 1.0));
    }
    return x;
}

inline Channels liveSounds(std::size_t channels, std::size_t frames, std::uint64_t seed)
{
    Channels sounds;
    for (std::size_t c = 0; c < channels; ++c)
        sounds.push_back(liveSound(frames, seed + c));
    return sounds;
}

inline std::vector<float> delayed(const std::vector<float>& x, std::size_t frames)
{
    std::vector<float> y(x.size(), 0.0f);
    for (std::size_t i = frames; i < x.size(); ++i)
        y[i] = x[i - frames];
    return y;
}

inline double energy(const std::vector<float>& x)
{
    double sum = 0.0;
    for (const float v : x)
        sum += static_cast<double>(v) * static_cast<double>(v);
    return sum;
}

inline std::vector<float> meanOf(const std::vector<float>& a, const std::vector<float>& b)
{
    std::vector<float> mean(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        mean[i] = 0.5f * (a[i] + b[i]);
    return mean;
}

} // namespace pacini::test
