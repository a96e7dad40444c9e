// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Export dialog: which clips, in what format, with what losses, and where to.

#include "document/ClipExport.h"
#include "editor/clip/session/Actuators.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/sheets/Sheet.h"
#include "editor/clip/sheets/SheetOver.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace pacini::editor
{

/// Choices of an export that the next one starts from.
struct ExportMemory
{
    std::string format;           ///< its name; empty or unknown: the first one
    int sampleRate = 0;           ///< Hz; 0: as the sound
    std::filesystem::path folder; ///< empty: that of the project
};

class ExportSheet final : public Sheet
{
public:
    /// `last` outlives it; what was exported is written there.
    ExportSheet(const EditorModel& project, const Actuators& profiles, ExportMemory& last);

private:
    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override { return &target; }
    void formatChanged();
    void chooseUsualEvents();
    void followExtension();
    void showLosses();
    void browse();
    void run();
    using Clips = std::vector<std::shared_ptr<const Clip>>;
    void write(const Clips& clips, const ExportChoice& wanted);
    void sayBusy();
    void fail(const Error& error);
    [[nodiscard]] const ClipFormat& chosenFormat() const;
    [[nodiscard]] ExportChoice choice() const;

    const EditorModel& model;
    const Actuators& actuators;
    ExportMemory& memory;
    juce::Label formatLabel, rateLabel, eventsLabel, targetLabel, lossLabel;
    juce::ComboBox format, rate, events;
    juce::ToggleButton all;
    juce::TextEditor target, losses;
    juce::TextButton browseButton;
    std::unique_ptr<juce::FileChooser> chooser;
    int asked = 0; ///< counts what losses were asked for
    SheetOver question{*this};
    Jobs jobs;
};

} // namespace pacini::editor
