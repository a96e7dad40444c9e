// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/PreviewDevices.h"

#include "app/OpenDevice.h"

#include <pacini/foundation/DspBlock.h>

#include <algorithm>
#include <span>
#include <thread>

namespace pacini::app
{

PreviewDevices::PreviewDevices(ClipPlayer& wanted, const editor::HapticOutputs& hapticOutputs)
    : player(wanted), haptic(hapticOutputs)
{
    subscriptions.on({&haptic.changed}, [this] { follow(); });
    follow();
}

void PreviewDevices::follow()
{
    const auto& outputs = haptic.outputs();
    for (std::size_t i = 0; i < mostHaptic; ++i)
    {
        const bool there = i < outputs.size();
        hapticChannels[i].store(there ? outputs[i].channel : -1, std::memory_order_relaxed);
        if (!there)
            continue;
        hapticLevels[i].setLevel(juce::Decibels::decibelsToGain(outputs[i].gain, editor::HapticOutputs::leastGain));
        hapticLevels[i].setDelay(outputs[i].delay);
    }
}

PreviewDevices::~PreviewDevices()
{
    cancelPendingUpdate();
    manager.removeAudioCallback(this);
    manager.closeAudioDevice();
}

juce::String PreviewDevices::open(const juce::XmlElement* saved, const juce::String& deviceType)
{
    const auto error = openDevice(manager, 0, maxChannels, saved, deviceType);
    manager.addAudioCallback(this);
    return error;
}

juce::StringArray PreviewDevices::outputNames() const
{
    auto* device = manager.getCurrentAudioDevice();
    return device != nullptr ? device->getOutputChannelNames() : juce::StringArray();
}

void PreviewDevices::audioDeviceAboutToStart(juce::AudioIODevice* device)
{
    rate.store(device->getCurrentSampleRate());
    running.store(false);
    // The player belongs to the message thread; some devices start on their own.
    triggerAsyncUpdate();
}

void PreviewDevices::handleAsyncUpdate()
{
    running.store(false);
    while (inside.load())
        std::this_thread::yield();
    const double now = rate.load();
    if (!isPlayableRate(now))
        return; // silence rather than another pitch
    player.prepare(now);
    soundLevel.prepare(now);
    for (editor::OutputTrim& level : hapticLevels)
        level.prepare(now);
    running.store(true);
}

void PreviewDevices::audioDeviceIOCallbackWithContext(const float* const*, int, float* const* out, int outs, int frames,
                                                      const juce::AudioIODeviceCallbackContext&)
{
    for (int c = 0; c < outs; ++c)
        if (out[c] != nullptr)
            juce::FloatVectorOperations::clear(out[c], frames);
    inside.store(true);
    if (running.load())
    {
        const int firstSound = soundOutput();
        std::array<int, mostHaptic> to{};
        for (std::size_t i = 0; i < mostHaptic; ++i)
        {
            // Sound and touch share the last channel rather than that one is lost; two drives never share one, since
            // each is within the limits of its actuator and their sum need not be.
            to[i] = std::min(hapticChannels[i].load(std::memory_order_relaxed), outs - 1);
            if (std::find(to.begin(), to.begin() + static_cast<std::ptrdiff_t>(i), to[i]) !=
                to.begin() + static_cast<std::ptrdiff_t>(i))
                to[i] = -1;
        }
        for (int done = 0; done < frames; done += pieceFrames)
        {
            const int n = std::min(pieceFrames, frames - done);
            const auto channel = [&](int c)
            {
                return std::span<float>(buffer.getWritePointer(c), static_cast<std::size_t>(n));
            };
            const std::array<std::span<float>, 2> sound{channel(0), channel(1)};
            std::array<std::span<float>, mostHaptic> touch;
            for (std::size_t i = 0; i < mostHaptic; ++i)
                touch[i] = channel(2 + static_cast<int>(i));
            player.process(touch, sound);
            soundLevel.process(sound);
            for (std::size_t i = 0; i < mostHaptic; ++i)
                if (to[i] >= 0)
                    hapticLevels[i].process(std::span(touch).subspan(i, 1));
            const auto add = [&](int from, int output)
            {
                if (output >= 0 && output < outs && out[output] != nullptr)
                    juce::FloatVectorOperations::add(out[output] + done, buffer.getReadPointer(from), n);
            };
            for (std::size_t i = 0; i < mostHaptic; ++i)
                add(2 + static_cast<int>(i), to[i]);
            if (firstSound >= 0)
            {
                add(0, firstSound);
                add(1, firstSound + 1);
            }
        }
    }
    inside.store(false);
}

} // namespace pacini::app
