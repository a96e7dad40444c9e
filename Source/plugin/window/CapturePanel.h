// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Capture panel: the last seconds of the sound as a clip, to drag out, edit or save.

#include "editor/CaptureJob.h"
#include "editor/ClipChip.h"
#include "editor/clip/NoticeBar.h"
#include "editor/clip/sheets/SheetOver.h"
#include "plugin/engine/PluginProcessor.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <memory>

namespace pacini::plugin
{

class CapturePanel final : public juce::Component
{
public:
    explicit CapturePanel(PluginProcessor& heard);

    std::function<void(const editor::CapturedClip&)> onEdit; ///< opens the clip in an editor; null: there is none

    void resized() override;

    /// Saves the captured clip, after a question if the file exists; packed or JSON by its extension.
    void save(const juce::File& chosen);

private:
    void captureNow();
    void take(Result<editor::CapturedClip> made);
    void chooseFile();
    void say(const juce::String& text, bool wrong);

    PluginProcessor& source;
    juce::ComboBox length;
    juce::TextButton button, editButton, saveButton;
    juce::ToggleButton keepButton;
    editor::ClipChip chip;
    juce::Label message;
    std::optional<editor::CapturedClip> captured;
    juce::File file; ///< of the clip, to be dragged
    std::unique_ptr<juce::FileChooser> chooser;
    editor::NoticeBar notice;
    std::unique_ptr<editor::SheetOver> question;
    int captures = 0;
    editor::CaptureJob job; // ends first
};

} // namespace pacini::plugin
