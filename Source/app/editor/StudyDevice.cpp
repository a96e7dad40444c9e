// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/StudyDevice.h"

#include "app/OpenDevice.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace pacini::app
{

StudyDevice::StudyDevice(juce::AudioDeviceManager& wanted) : manager(wanted)
{
    manager.addAudioCallback(this);
}

StudyDevice::~StudyDevice()
{
    manager.removeAudioCallback(this);
}

int StudyDevice::sampleRate() const
{
    auto* open = manager.getCurrentAudioDevice();
    return open == nullptr ? 0 : static_cast<int>(std::lround(open->getCurrentSampleRate()));
}

void StudyDevice::recover()
{
    stalled = false;
    manager.restartLastAudioDevice();
    // The list of devices may be older than the device that has come back.
    constexpr int mostChannels = 256;
    if (manager.getCurrentAudioDevice() == nullptr)
        if (const auto error = openDevice(manager, 0, mostChannels, nullptr, manager.getCurrentAudioDeviceType());
            error.isNotEmpty())
            juce::Logger::writeToLog("Pacini: no sound device: " + error);
}

void StudyDevice::play(study::TrialSound trial)
{
    if (stalled)
        recover();
    lastFrame = 0;
    lastMoved = juce::Time::getMillisecondCounterHiRes();
    playback.play(std::move(trial));
}

study::PlaybackReport StudyDevice::report() const
{
    auto report = playback.report();
    const double now = juce::Time::getMillisecondCounterHiRes();
    if (report.frame != std::exchange(lastFrame, report.frame))
        lastMoved = now;
    // Without a device, or with one that asks for nothing any more, nobody plays on: the trial is lost, and is
    // repeated.
    constexpr double longestPause = 2000.0; // ms
    stalled = stalled || (report.playing && now - lastMoved > longestPause);
    if (report.playing && (stalled || manager.getCurrentAudioDevice() == nullptr))
    {
        report.playing = false;
        ++report.dropouts;
    }
    return report;
}

juce::StringArray StudyDevice::outputNames() const
{
    juce::StringArray names;
    if (auto* open = manager.getCurrentAudioDevice())
    {
        const auto all = open->getOutputChannelNames();
        const auto active = open->getActiveOutputChannels();
        for (int c = 0; c < all.size(); ++c)
            if (active[c])
                names.add(juce::String(c + 1) + "  " + all[c]);
    }
    return names;
}

void StudyDevice::wire(int sound, int touch, int actuators) noexcept
{
    soundChannel.store(sound);
    touchChannel.store(touch);
    touchChannels.store(std::clamp(actuators, 1, study::mostActuators));
}

void StudyDevice::audioDeviceAboutToStart(juce::AudioIODevice* started)
{
    playback.prepare(started->getCurrentSampleRate());
    device.store(started);
    overruns = std::max(0, started->getXRunCount());
}

void StudyDevice::audioDeviceIOCallbackWithContext(const float* const*, int, float* const* out, int outs, int frames,
                                                   const juce::AudioIODeviceCallbackContext&)
{
    if (auto* running = device.load())
        if (const int count = running->getXRunCount(); count > overruns)
        {
            overruns = count;
            playback.drop();
        }
    const int sound = soundChannel.load(), touch = touchChannel.load(), actuators = touchChannels.load();
    for (int done = 0; done < frames;)
    {
        const int count = std::min(frames - done, pieceFrames);
        const auto size = static_cast<std::size_t>(count);
        std::array<std::span<float>, study::mostActuators> touches;
        for (std::size_t a = 0; a < touches.size(); ++a)
            touches[a] = std::span(pieces[2 + a]).first(size);
        playback.process(std::span(pieces[0]).first(size), std::span(pieces[1]).first(size), touches);
        for (int c = 0; c < outs; ++c)
        {
            if (out[c] == nullptr)
                continue;
            // The actuator gets nothing but the touch, whatever else is said to be there.
            const float* from = c >= touch && c < touch + actuators
                                    ? pieces[2 + static_cast<std::size_t>(c - touch)].data()
                                : c == sound     ? pieces[0].data()
                                : c == sound + 1 ? pieces[1].data()
                                                 : nullptr;
            if (from != nullptr)
                juce::FloatVectorOperations::copy(out[c] + done, from, count);
            else
                juce::FloatVectorOperations::clear(out[c] + done, count);
        }
        done += count;
    }
}

} // namespace pacini::app
