// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Choice of the sound device at start-up: of the kind asked for, else the saved one, else the system's.

#include <juce_audio_devices/juce_audio_devices.h>

namespace pacini::app
{

/// Opens the default device of a kind such as "JACK"; without a kind the saved device, or else the system's. Returns an
/// error text, empty on success. [message]
inline juce::String openDevice(juce::AudioDeviceManager& manager, int maxInputs, int maxOutputs,
                               const juce::XmlElement* saved, const juce::String& deviceType)
{
    if (deviceType.isEmpty())
        return manager.initialise(maxInputs, maxOutputs, saved, true);
    manager.getAvailableDeviceTypes();
    manager.setCurrentAudioDeviceType(deviceType, true);
    juce::AudioDeviceManager::AudioDeviceSetup setup;
    if (auto* type = manager.getCurrentDeviceTypeObject())
    {
        type->scanForDevices();
        if (maxInputs > 0)
            setup.inputDeviceName = type->getDeviceNames(true)[type->getDefaultDeviceIndex(true)];
        setup.outputDeviceName = type->getDeviceNames(false)[type->getDefaultDeviceIndex(false)];
    }
    return manager.initialise(maxInputs, maxOutputs, nullptr, false, {}, &setup);
}

} // namespace pacini::app
