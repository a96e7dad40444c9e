// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/PreviewDevices.h"

#include "app/OpenDevice.h"

#include <pacini/foundation/DspBlock.h>

#include <algorithm>
#include <span>
#include <thread>
#include <utility>

namespace pacini::app
{

namespace
{
constexpr int watchInterval = 250, silentInterval = 20;         // ms
constexpr juce::uint32 longestGap = 2000;                       // ms without a callback, longer than any device's block
constexpr juce::uint32 firstSearch = 1000, latestSearch = 6000; // ms from one to the next, which gets longer

juce::uint32 now()
{
    return juce::Time::getMillisecondCounter();
}
} // namespace

PreviewDevices::PreviewDevices(ClipPlayer& wanted, editor::HapticOutputs& hapticOutputs)
    : player(wanted), haptic(hapticOutputs)
{
    subscriptions.on({&haptic.changed}, [this] { follow(); });
    follow();
}

void PreviewDevices::follow()
{
    auto* device = manager.getCurrentAudioDevice();
    const auto placeOf = [device](int channel)
    {
        return device == nullptr || channel < 0 || channel >= mostDeviceChannels
                   ? -1
                   : channelPlaces(device->getActiveOutputChannels())[static_cast<std::size_t>(channel)];
    };
    const auto& outputs = haptic.outputs();
    for (std::size_t i = 0; i < mostHaptic; ++i)
    {
        hapticPlaces[i].store(placeOf(haptic.channelOf(i)), std::memory_order_relaxed);
        if (i >= outputs.size())
            continue;
        hapticLevels[i].setLevel(juce::Decibels::decibelsToGain(outputs[i].gain, editor::HapticOutputs::leastGain));
        hapticLevels[i].setDelay(outputs[i].delay);
    }
    soundPlaces[0].store(placeOf(soundChannel), std::memory_order_relaxed);
    soundPlaces[1].store(soundChannel < 0 ? -1 : placeOf(soundChannel + 1), std::memory_order_relaxed);
}

PreviewDevices::~PreviewDevices()
{
    stopTimer();
    manager.removeChangeListener(this);
    cancelPendingUpdate();
    manager.removeAudioCallback(this);
    manager.closeAudioDevice();
}

juce::String PreviewDevices::open(const juce::XmlElement* saved, const juce::String& deviceType)
{
    savedState = saved != nullptr ? std::make_unique<juce::XmlElement>(*saved) : nullptr;
    wantedType = deviceType;
    const auto error = openDevice(manager, 0, mostDeviceChannels, saved, deviceType);
    manager.addAudioCallback(this);
    manager.addChangeListener(this);
    begun = true;
    chosenNone = userChoseNone();
    searchInterval = firstSearch;
    look();
    startTimer(watchInterval);
    return error;
}

juce::StringArray PreviewDevices::outputNames() const
{
    auto* device = manager.getCurrentAudioDevice();
    return device != nullptr ? device->getOutputChannelNames() : juce::StringArray();
}

void PreviewDevices::setSoundOutput(int first)
{
    soundChannel = first;
    follow();
    if (begun)
        look();
}

// Whether there is a device.

bool PreviewDevices::isAlive() const
{
    auto* device = manager.getCurrentAudioDevice();
    return device != nullptr && device->isOpen() && device->isPlaying() && now() - lastCall.load() < longestGap;
}

/// Not so when what was chosen cannot be opened: JUCE keeps its name then.
bool PreviewDevices::userChoseNone() const
{
    const auto chosen = manager.createStateXml();
    return chosen != nullptr && manager.getCurrentAudioDevice() == nullptr &&
           chosen->getStringAttribute("audioOutputDeviceName").isEmpty() &&
           chosen->getStringAttribute("audioDeviceName").isEmpty();
}

/// Follows what has become of the device.
void PreviewDevices::look()
{
    const bool alive = isAlive();
    auto* device = manager.getCurrentAudioDevice();
    if (alive)
    {
        lastSetup = manager.getAudioDeviceSetup();
        lastType = manager.getCurrentAudioDeviceType();
        chosenNone = false;
        searchInterval = firstSearch;
    }
    const bool changed = std::exchange(there, alive) != alive;
    if (changed && !alive)
    {
        // Another kind of device, even one of which there is none, was turned to by somebody.
        chosenNone = userChoseNone() || (lastType.isNotEmpty() && manager.getCurrentAudioDeviceType() != lastType);
        if (device != nullptr)
            manager.closeAudioDevice(); // it is dead: what is found later is opened anew
        lastSearch = now();
    }
    haptic.setDevice(alive ? channelsOn(device->getActiveOutputChannels(), device->getOutputChannelNames().size())
                           : std::vector<bool>(),
                     soundChannel);
    follow();
    if (!changed)
        return;
    if (!alive)
        player.stop();
    if (const auto& tell = alive ? onFound : onLost)
        tell();
}

void PreviewDevices::timerCallback()
{
    look();
    if (isLookingForDevice() && now() - lastSearch > searchInterval)
    {
        searchInterval = std::min(2 * searchInterval, latestSearch);
        if (openLost())
            look();
    }
    if (!there)
        playSilently();
    const int interval = !there && player.isPlaying() ? silentInterval : watchInterval;
    if (getTimerInterval() != interval)
        startTimer(interval);
}

bool PreviewDevices::reconnect()
{
    chosenNone = false;
    if (!there && !openLost())
    {
        for (auto* type : manager.getAvailableDeviceTypes())
            type->scanForDevices();
        (void)openDevice(manager, 0, mostDeviceChannels, nullptr, {});
    }
    look();
    return there;
}

/// Opens the device that ran, if it is there; where none has yet, one as open() would.
bool PreviewDevices::openLost()
{
    lastSearch = now();
    const bool never = lastSetup.outputDeviceName.isEmpty();
    const auto typeName = never ? manager.getCurrentAudioDeviceType() : lastType;
    for (auto* type : manager.getAvailableDeviceTypes())
    {
        if (type->getTypeName() != typeName)
            continue;
        type->scanForDevices();
        const auto names = type->getDeviceNames(false);
        if (never && !names.isEmpty())
            (void)openDevice(manager, 0, mostDeviceChannels, savedState.get(), wantedType);
        if (!never && names.contains(lastSetup.outputDeviceName))
        {
            manager.setCurrentAudioDeviceType(typeName, true);
            const auto setup = lastSetup; // opening tells, and what is told changes it
            (void)manager.setAudioDeviceSetup(setup, true);
        }
    }
    return isAlive();
}

/// What would be in the callbacks since the last call.
void PreviewDevices::playSilently()
{
    const auto before = std::exchange(lastSilence, now());
    if (!player.isPlaying() || running.load())
        return;
    auto frames = static_cast<int>(rate.load() * 0.001 * std::min<juce::uint32>(lastSilence - before, 200));
    while (frames > 0)
    {
        const auto n = static_cast<std::size_t>(std::min(frames, pieceFrames));
        std::array<std::span<float>, mostHaptic> touch;
        for (std::size_t i = 0; i < mostHaptic; ++i)
            touch[i] = {buffer.getWritePointer(2 + static_cast<int>(i)), n};
        const std::array<std::span<float>, 2> sound{std::span(buffer.getWritePointer(0), n),
                                                    std::span(buffer.getWritePointer(1), n)};
        player.process(touch, sound);
        frames -= static_cast<int>(n);
    }
}

// The device.

void PreviewDevices::audioDeviceAboutToStart(juce::AudioIODevice* device)
{
    rate.store(device->getCurrentSampleRate());
    lastCall.store(now());
    running.store(false);
    // The player belongs to the message thread; some devices start on their own.
    triggerAsyncUpdate();
}

void PreviewDevices::handleAsyncUpdate()
{
    running.store(false);
    while (inside.load())
        std::this_thread::yield();
    const double wanted = rate.load();
    if (!isPlayableRate(wanted))
        return; // silence rather than another pitch
    player.prepare(wanted);
    soundLevel.prepare(wanted);
    for (editor::OutputTrim& level : hapticLevels)
        level.prepare(wanted);
    look();
    running.store(true);
}

void PreviewDevices::audioDeviceIOCallbackWithContext(const float* const*, int, float* const* out, int outs, int frames,
                                                      const juce::AudioIODeviceCallbackContext&)
{
    lastCall.store(now(), std::memory_order_relaxed);
    for (int c = 0; c < outs; ++c)
        if (out[c] != nullptr)
            juce::FloatVectorOperations::clear(out[c], frames);
    inside.store(true);
    if (running.load())
    {
        const std::array<int, 2> soundTo{soundPlaces[0].load(std::memory_order_relaxed),
                                         soundPlaces[1].load(std::memory_order_relaxed)};
        std::array<int, mostHaptic> to{};
        for (std::size_t i = 0; i < mostHaptic; ++i)
            to[i] = hapticPlaces[i].load(std::memory_order_relaxed);
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
            add(0, soundTo[0]);
            add(1, soundTo[1]);
        }
    }
    inside.store(false);
}

} // namespace pacini::app
