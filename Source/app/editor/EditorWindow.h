// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The window of the editor.

#include "app/editor/ControllerOutput.h"
#include "app/editor/PreviewRig.h"
#include "editor/clip/EditorView.h"

#include <juce_audio_utils/juce_audio_utils.h>

#include <filesystem>
#include <vector>

namespace pacini::app
{

class EditorWindow final : public juce::DocumentWindow
{
public:
    EditorWindow(editor::Session& session, PreviewRig& rig, std::vector<std::filesystem::path> demos,
                 std::filesystem::path profileFolder);
    ~EditorWindow() override;

    [[nodiscard]] editor::EditorView& view() noexcept { return content; }
    void closeButtonPressed() override;
    void focusGained(FocusChangeType) override { content.takeFocus(); }

private:
    void showDevices();

    PreviewRig& rig;
    ControllerOutput controllers;
    editor::EditorView content;
};

} // namespace pacini::app
