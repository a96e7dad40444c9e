// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Main window of the editor.

#include "app/editor/ControllerOutput.h"
#include "app/editor/PhoneOutput.h"
#include "app/editor/PreviewDevices.h"
#include "app/editor/TapInput.h"
#include "editor/Theme.h"
#include "editor/clip/EditorView.h"

#include <juce_audio_utils/juce_audio_utils.h>

#include <filesystem>
#include <vector>

namespace pacini::app
{

class EditorWindow final : public juce::DocumentWindow
{
public:
    /// `around` without the parts that the window provides: a way to quit, devices, a measuring rig.
    EditorWindow(editor::Session& session, PreviewDevices& rig, editor::HostServices around);
    ~EditorWindow() override;

    /// Shows the window where `state` says, inside the screen there is now; without one, in the middle.
    void open(const juce::String& state);
    /// For open().
    [[nodiscard]] juce::String state();

    [[nodiscard]] editor::EditorView& view() noexcept { return content; }
    void closeButtonPressed() override;
    void focusGained(FocusChangeType) override { content.takeFocus(); }

private:
    [[nodiscard]] editor::HostServices completed(editor::HostServices around);
    [[nodiscard]] std::vector<editor::FoundDevice> found();
    void showDevices();
    void feelOnPhone();

    PreviewDevices& rig;
    ControllerOutput controllers;
    PhoneOutput phones;
    TapInput taps;
    editor::EditorView content;
    editor::DefaultLook defaultLook{content.getLookAndFeel()};
};

} // namespace pacini::app
