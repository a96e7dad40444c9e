// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Side panel: tabs with the pages beside the clip.

#include <juce_gui_basics/juce_gui_basics.h>

#include <memory>

namespace pacini::editor
{

class EditorView;

class SidePanel final : public juce::TabbedComponent
{
public:
    explicit SidePanel(EditorView& view);

    /// Pages that are too high for the window scroll.
    void addPage(const juce::String& name, std::unique_ptr<juce::Component> content);
};

} // namespace pacini::editor
