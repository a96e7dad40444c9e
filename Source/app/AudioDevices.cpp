// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/AudioDevices.h"

#include "app/ChannelPlaces.h"
#include "app/OpenDevice.h"

#include <algorithm>

namespace pacini::app
{

AudioDevices::AudioDevices(plugin::PluginProcessor& wanted) : processor(wanted) {}

AudioDevices::~AudioDevices()
{
    manager.removeAudioCallback(this);
    manager.closeAudioDevice();
}

juce::String AudioDevices::open(const juce::XmlElement* saved, const juce::String& deviceType)
{
    auto error = openDevice(manager, maxChannels, maxChannels, saved, deviceType);
    manager.addAudioCallback(this);
    running = true;
    return error;
}

juce::StringArray AudioDevices::inputNames() const
{
    auto* device = manager.getCurrentAudioDevice();
    return device ? device->getInputChannelNames() : juce::StringArray();
}

juce::StringArray AudioDevices::outputNames() const
{
    auto* device = manager.getCurrentAudioDevice();
    return device ? device->getOutputChannelNames() : juce::StringArray();
}

Routing AudioDevices::routing() const noexcept
{
    Routing now;
    now.input = input.load(std::memory_order_relaxed);
    now.mainInput = mainInput.load(std::memory_order_relaxed);
    now.sidechainInput = sidechainInput.load(std::memory_order_relaxed);
    now.mainOutput = mainOutput.load(std::memory_order_relaxed);
    for (std::size_t c = 0; c < hapticOutputs.size(); ++c)
        now.hapticOutputs[c] = hapticOutputs[c].load(std::memory_order_relaxed);
    now.hapticChannels = hapticChannels;
    return now;
}

void AudioDevices::setRouting(const Routing& wanted)
{
    input.store(wanted.input, std::memory_order_relaxed);
    mainInput.store(wanted.mainInput, std::memory_order_relaxed);
    sidechainInput.store(wanted.sidechainInput, std::memory_order_relaxed);
    mainOutput.store(wanted.mainOutput, std::memory_order_relaxed);
    for (std::size_t c = 0; c < hapticOutputs.size(); ++c)
        hapticOutputs[c].store(wanted.hapticOutputs[c], std::memory_order_relaxed);
    setHapticChannels(std::clamp(wanted.hapticChannels, 1, static_cast<int>(plugin::maxHapticChannels)));
}

void AudioDevices::setHapticChannels(int count)
{
    if (count == hapticChannels)
        return;
    if (running)
        manager.removeAudioCallback(this);
    auto layout = processor.getBusesLayout();
    layout.outputBuses.getReference(1) = juce::AudioChannelSet::canonicalChannelSet(count);
    if (processor.setBusesLayout(layout))
        hapticChannels = count;
    if (running)
        manager.addAudioCallback(this); // which prepares the processor
}

Result<void> AudioDevices::play(const juce::File& wanted)
{
    auto loaded = loadSound(wanted.getFullPathName().toStdString(), processor.sampleRate());
    if (!loaded)
        return loaded.error();
    file = wanted;
    sounds->send(std::move(loaded).value());
    input.store(InputChoice::file, std::memory_order_relaxed);
    return {};
}

void AudioDevices::audioDeviceAboutToStart(juce::AudioIODevice* device)
{
    const double rate = device->getCurrentSampleRate();
    inputPlaces = channelPlaces(device->getActiveInputChannels());
    outputPlaces = channelPlaces(device->getActiveOutputChannels());
    test.prepare(rate);
    processor.setRateAndBufferSizeDetails(rate, pieceFrames);
    processor.prepareToPlay(rate, pieceFrames);
    // The file is played at the rate of its device.
    if (file != juce::File() && (!sound || sound->content.sampleRate != rate))
        if (auto loaded = loadSound(file.getFullPathName().toStdString(), rate))
            sounds->send(std::move(loaded).value());
}

void AudioDevices::audioDeviceStopped()
{
    processor.releaseResources();
}

void AudioDevices::takeSound() noexcept
{
    if (auto* node = sounds->receive())
    {
        sounds->giveBack(sound.release());
        sound.reset(node);
        position = 0;
    }
}

/// The three inputs of the plugin in the buffer.
void AudioDevices::fillInputs(const Routing& now, const float* const* in, int ins, int done, int frames) noexcept
{
    buffer.clear();
    const auto from = [&](int channel) -> const float*
    {
        if (channel < 0 || channel >= maxChannels)
            return nullptr;
        const int place = inputPlaces[static_cast<std::size_t>(channel)];
        return place >= 0 && place < ins ? in[place] : nullptr;
    };
    const auto copy = [&](const float* source, int to)
    {
        if (source)
            juce::FloatVectorOperations::copy(buffer.getWritePointer(to), source + done, frames);
    };
    switch (now.input)
    {
    case InputChoice::device:
    {
        const float* left = from(now.mainInput);
        const float* right = now.mainInput >= 0 ? from(now.mainInput + 1) : nullptr;
        copy(left, 0);
        copy(right ? right : left, 1);
        break;
    }
    case InputChoice::test:
        for (int i = 0; i < frames; ++i)
        {
            const float x = test.next();
            buffer.setSample(0, i, x);
            buffer.setSample(1, i, x);
        }
        break;
    case InputChoice::file:
        if (!sound || sound->content.frames() == 0)
            break;
        for (int i = 0; i < frames; ++i)
        {
            for (int c = 0; c < 2; ++c)
                buffer.setSample(c, i, sound->content.channels[static_cast<std::size_t>(c)][position]);
            position = position + 1 == sound->content.frames() ? 0 : position + 1;
        }
        break;
    }
    if (now.sidechainInput != now.mainInput && now.sidechainInput != now.mainInput + 1)
        copy(from(now.sidechainInput), 2);
}

void AudioDevices::audioDeviceIOCallbackWithContext(const float* const* in, int ins, float* const* out, int outs,
                                                    int frames, const juce::AudioIODeviceCallbackContext&)
{
    takeSound();
    const Routing now = routing();
    for (int c = 0; c < outs; ++c)
        if (out[c])
            juce::FloatVectorOperations::clear(out[c], frames);
    const auto outputOf = [&](int channel) -> float*
    {
        const int place = channel < 0 || channel >= maxChannels ? -1 : outputPlaces[static_cast<std::size_t>(channel)];
        return place >= 0 && place < outs ? out[place] : nullptr;
    };
    const auto add = [&](int from, int channel, int done, int n)
    {
        if (float* const to = outputOf(channel))
            juce::FloatVectorOperations::add(to + done, buffer.getReadPointer(from), n);
    };
    unsigned connected = 0;
    for (std::size_t c = 0; c < now.hapticOutputs.size(); ++c)
        connected |= outputOf(now.hapticOutputs[c]) != nullptr ? 1u << c : 0u;
    processor.setConnected(connected);
    for (int done = 0; done < frames; done += pieceFrames)
    {
        const int n = std::min(pieceFrames, frames - done);
        buffer.setSize(2 + std::max(now.hapticChannels, 1), n, false, false, true);
        fillInputs(now, in, ins, done, n);
        processor.processBlock(buffer, midi);
        if (now.mainOutput >= 0)
        {
            add(0, now.mainOutput, done, n);
            add(1, now.mainOutput + 1, done, n);
        }
        for (int c = 0; c < now.hapticChannels; ++c)
            add(2 + c, now.hapticOutputs[static_cast<std::size_t>(c)], done, n);
    }
}

} // namespace pacini::app
