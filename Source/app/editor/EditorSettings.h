// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Stored settings of the editor, kept from one run to the next.

#include "app/editor/PreviewDevices.h"
#include "editor/clip/EditorView.h"

#include <juce_data_structures/juce_data_structures.h>

#include <memory>

namespace pacini::app
{

/// Kept in a file of the user's. [message]
class EditorSettings
{
public:
    explicit EditorSettings(const juce::File& folder);

    /// Whether the editor has never run before.
    [[nodiscard]] bool isFirstRun() { return file.getAllProperties().size() == 0; }

    [[nodiscard]] std::unique_ptr<juce::XmlElement> devices() const { return file.getXmlValue("devices"); }
    [[nodiscard]] juce::String language() const { return file.getValue("language", "en"); }
    void keepLanguage(const juce::String& code) { file.setValue("language", code); }
    [[nodiscard]] juce::String window() const { return file.getValue("window"); }
    void apply(PreviewDevices& rig, editor::HapticOutputs& outputs) const;
    void apply(editor::EditorView& view) const;

    void keep(PreviewDevices& rig, editor::EditorView& view, const juce::String& windowState);

private:
    juce::PropertiesFile file;
};

} // namespace pacini::app
