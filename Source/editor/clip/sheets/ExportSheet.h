// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Export dialog: which clips, in what format, with what losses, and where to.

#include "document/ClipExport.h"
#include "editor/clip/session/Actuators.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/sheets/LossTable.h"
#include "editor/clip/sheets/Sheet.h"
#include "editor/clip/sheets/SheetOver.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pacini::editor
{

/// Choices of an export that the next one starts from.
struct ExportMemory
{
    std::string format;            ///< its name; empty or unknown: the first one
    int sampleRate = 0;            ///< Hz; 0: as the sound
    std::filesystem::path folder;  ///< empty: that of the project
    std::vector<std::string> also; ///< names of further formats
    bool written = false;          ///< something was, since the program began
};

class ExportSheet final : public Sheet
{
public:
    /// `last` outlives it; what was exported is written there.
    ExportSheet(const EditorModel& project, const Actuators& profiles, ExportMemory& last);

    /// A loss was chosen, of the clip with that id; the sheet is closed before.
    std::function<void(int clip, double time, double duration)> onPlace;

    /// Whether the clips are written in this format too. The format of the box always is.
    void setAlso(const std::string& format, bool wanted);

private:
    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override { return &target; }
    void prepareFormat();
    void prepareTarget();
    void formatChanged();
    void chooseUsualEvents();
    void followExtension();
    void showLosses();
    void fit();
    [[nodiscard]] int wordsHeight() const;
    void browse();
    void run();
    using Clips = std::vector<std::shared_ptr<const Clip>>;
    /// Those that would be written, with their ids.
    [[nodiscard]] std::vector<std::pair<int, std::shared_ptr<const Clip>>> chosenClips() const;
    /// What the chosen formats keep, each by its name where there are several.
    [[nodiscard]] juce::String keptText() const;
    void write(const Clips& clips, const std::vector<ExportChoice>& wanted);
    void chooseAlso();
    void showAlso();
    void remember();
    [[nodiscard]] bool anySamples() const;
    [[nodiscard]] std::vector<ExportChoice> choices() const;
    void sayBusy();
    /// `written`: files that were before.
    void fail(const Error& error, std::size_t written = 0);
    [[nodiscard]] const ClipFormat& chosenFormat() const;
    [[nodiscard]] ExportChoice choice() const;

    const EditorModel& model;
    const Actuators& actuators;
    ExportMemory& memory;
    juce::Label formatLabel, rateLabel, eventsLabel, targetLabel, lossLabel;
    juce::ComboBox format, rate, events;
    juce::ToggleButton all;
    juce::TextEditor target, losses;
    juce::TextButton browseButton, alsoButton;
    std::vector<std::string> also; ///< in the order of the menu
    LossTable table;
    std::unique_ptr<juce::FileChooser> chooser;
    int asked = 0; ///< counts what losses were asked for
    SheetOver question{*this};
    Jobs jobs;
};

} // namespace pacini::editor
