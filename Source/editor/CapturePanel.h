// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The last seconds of the sound as a clip: one button, and something to drag out or to save.

#include "editor/CaptureJob.h"
#include "editor/ClipChip.h"
#include "editor/LiveSource.h"
#include "editor/Refreshed.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <memory>

namespace pacini::editor
{

class CapturePanel final : public juce::Component
{
public:
    explicit CapturePanel(LiveSource& heard);

    std::function<void(const Clip&)> onEdit; ///< opens the clip in an editor; null: there is none

    void resized() override;

private:
    void captureNow();
    void take(Result<Clip> clip);
    void chooseFile();
    void save(const juce::File& chosen);
    void say(const juce::String& text, bool wrong);

    LiveSource& source;
    juce::ComboBox length;
    juce::TextButton button, editButton, saveButton;
    ClipChip chip;
    juce::Label message;
    std::optional<Clip> clip;
    juce::File file; ///< of the clip, to be dragged
    std::unique_ptr<juce::FileChooser> chooser;
    int captures = 0;
    CaptureJob job; // ends first
};

} // namespace pacini::editor
