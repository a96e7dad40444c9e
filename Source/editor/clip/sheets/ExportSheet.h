// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Export dialog: which clips, in what format, with what losses, and where to.

#include "document/ClipExport.h"
#include "editor/clip/session/Actuators.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/sheets/Sheet.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <memory>

namespace pacini::editor
{

class ExportSheet final : public Sheet
{
public:
    ExportSheet(const EditorModel& project, const Actuators& profiles);

private:
    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override { return &target; }
    void formatChanged();
    void chooseUsualEvents();
    void showLosses();
    void browse();
    void run();
    [[nodiscard]] const ClipFormat& chosenFormat() const;
    [[nodiscard]] ExportChoice choice() const;

    const EditorModel& model;
    const Actuators& actuators;
    juce::Label formatLabel, rateLabel, eventsLabel, targetLabel, lossLabel;
    juce::ComboBox format, rate, events;
    juce::ToggleButton all;
    juce::TextEditor target, losses;
    juce::TextButton browseButton;
    std::unique_ptr<juce::FileChooser> chooser;
    int asked = 0; ///< counts what losses were asked for
    Jobs jobs;
};

} // namespace pacini::editor
