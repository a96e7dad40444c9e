// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Component that shows a clip and can be dragged out of the window.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>

namespace pacini::editor
{

/// Writes a clip as JSON into a folder for temporary files, under its name. Errors: those of writeClip().
[[nodiscard]] Result<juce::File> writeForDragging(const Clip& clip);

/// Name, length and envelope of a clip. It is dragged to a folder, or into a program that takes files.
class ClipChip final : public juce::Component, public juce::SettableTooltipClient
{
public:
    ClipChip();

    /// `file` is asked for when a drag begins; one that does not exist is not dragged.
    void show(const Clip& clip, std::function<juce::File()> file);

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseDrag(const juce::MouseEvent& event) override;

private:
    std::function<juce::File()> makeFile;
    bool begun = false; ///< in this gesture
    juce::String text;
    juce::Path curve; // of the envelope, within 0 to 1
};

} // namespace pacini::editor
