// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Windows of a study: the participant's, and the experimenter's beside it.

#include "app/editor/JoystickReader.h"
#include "app/editor/MeasureDevice.h"
#include "app/editor/StudyDevice.h"
#include "editor/study/StudyPage.h"

#include <juce_audio_utils/juce_audio_utils.h>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace pacini::app
{

class StudyWindow final : public juce::DocumentWindow, private juce::AsyncUpdater
{
public:
    /// `dark`: the theme of the program; none: the system's. Calls `whenClosed` once, later, from the message loop.
    StudyWindow(editor::StudyPlace place, juce::AudioDeviceManager& devices, std::vector<NamedProfile> profiles,
                std::string program, std::optional<bool> dark, std::function<void()> whenClosed);
    ~StudyWindow() override;

    [[nodiscard]] editor::StudyPage& page() noexcept { return *content; }
    void closeButtonPressed() override;
    void visibilityChanged() override;
    void focusGained(FocusChangeType) override { content->grabKeyboardFocus(); }
    bool keyPressed(const juce::KeyPress& key) override;

private:
    class Monitor;

    void showDevices();
    void showMonitor(bool shown);
    void press(const JoystickPress& pressed);
    void handleAsyncUpdate() override;

    juce::AudioDeviceManager& manager;
    StudyDevice device;
    MeasureDevice rig;
    std::unique_ptr<editor::StudyPage> content;
    std::unique_ptr<Monitor> monitor; ///< null while it is not shown
    std::function<void()> closed;
    std::mutex mutex; ///< guards waiting items
    std::vector<editor::Control> waiting;
    std::unique_ptr<JoystickReader> joysticks;
};

} // namespace pacini::app
