// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/TapInput.h"

#include <algorithm>
#include <utility>

namespace pacini::app
{

namespace
{
constexpr int devicePoll = 2000; // ms between looks for what has been connected
} // namespace

TapInput::TapInput(editor::Tapping& wanted, const editor::Transport& playing, std::filesystem::path folder)
    : tapping(wanted),
      transport(playing),
      joysticks(std::make_unique<JoystickReader>(std::move(folder),
                                                 [this](const JoystickPress& press)
                                                 {
                                                     if (press.button >= 0)
                                                         tap(editor::usualEvent.amplitude);
                                                 }))
{
    startTimer(devicePoll);
}

TapInput::~TapInput()
{
    stopTimer();
    inputs.clear();
    joysticks.reset();
    cancelPendingUpdate();
}

void TapInput::tap(double level)
{
    {
        const std::lock_guard lock(mutex);
        waiting.push_back(level);
    }
    triggerAsyncUpdate();
}

void TapInput::handleAsyncUpdate()
{
    std::vector<double> levels;
    {
        const std::lock_guard lock(mutex);
        levels.swap(waiting);
    }
    if (!transport.isPlaying() || !(inBackground || juce::Process::isForegroundProcess()))
        return;
    for (const double level : levels)
        tapping.tap(level);
}

void TapInput::handleIncomingMidiMessage(juce::MidiInput*, const juce::MidiMessage& message)
{
    if (message.isNoteOn())
        tap(std::max(1.0 / 127.0, static_cast<double>(message.getFloatVelocity())));
}

/// Opens what is new, and closes what is gone.
void TapInput::timerCallback()
{
#if JUCE_LINUX
    if (std::error_code error; !std::filesystem::exists("/dev/snd/seq", error))
        return; // the system's library would say so again and again
#endif
    const auto devices = juce::MidiInput::getAvailableDevices();
    std::erase_if(inputs, [&](const auto& input) { return !devices.contains(input->getDeviceInfo()); });
    for (const auto& device : devices)
        if (std::none_of(inputs.begin(), inputs.end(),
                         [&](const auto& input) { return input->getDeviceInfo() == device; }))
            if (auto input = juce::MidiInput::openDevice(device.identifier, this))
            {
                input->start();
                inputs.push_back(std::move(input));
            }
}

} // namespace pacini::app
