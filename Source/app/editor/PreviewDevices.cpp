// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/PreviewDevices.h"

#include "app/OpenDevice.h"

#include <pacini/foundation/DspBlock.h>

#include <algorithm>
#include <span>
#include <thread>

namespace pacini::app
{

PreviewDevices::PreviewDevices(ClipPlayer& wanted) : player(wanted) {}

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

void PreviewDevices::setOutputs(PreviewOutputs wanted) noexcept
{
    soundOutput.store(wanted.sound, std::memory_order_relaxed);
    hapticOutput.store(wanted.haptic, std::memory_order_relaxed);
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
    hapticLevel.prepare(now);
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
        const PreviewOutputs now = outputs();
        // Sound and touch share the last channel rather than that one is lost.
        const int haptic = now.haptic < 0 ? -1 : std::min(now.haptic, outs - 1);
        for (int done = 0; done < frames; done += pieceFrames)
        {
            const int n = std::min(pieceFrames, frames - done);
            const auto channel = [&](int c)
            {
                return std::span<float>(buffer.getWritePointer(c), static_cast<std::size_t>(n));
            };
            const std::array<std::span<float>, 2> sound{channel(1), channel(2)};
            const std::array<std::span<float>, 1> touch{channel(0)};
            player.process(touch[0], sound);
            soundLevel.process(sound);
            hapticLevel.process(touch);
            const auto add = [&](int from, int to)
            {
                if (to >= 0 && to < outs && out[to] != nullptr)
                    juce::FloatVectorOperations::add(out[to] + done, buffer.getReadPointer(from), n);
            };
            add(0, haptic);
            if (now.sound >= 0)
            {
                add(1, now.sound);
                add(2, now.sound + 1);
            }
        }
    }
    inside.store(false);
}

} // namespace pacini::app
