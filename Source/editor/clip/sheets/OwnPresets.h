// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The user's presets in a menu: settings files, to be chosen, saved, renamed, deleted and loaded from elsewhere.

#include "document/SettingsPresets.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pacini::editor
{

class EditorView;

/// Items of a menu, and the questions behind them. [message]
class OwnPresets
{
public:
    static constexpr int firstId = 1000; ///< smaller ids of the menu are the owner's

    /// `wanted`: the folder of the presets; empty: none are kept.
    OwnPresets(EditorView& shown, std::filesystem::path wanted)
        : view(shown), keeps(!wanted.empty()), files(std::move(wanted))
    {
    }

    std::function<std::string()> settings; ///< the text of the settings file to save
    /// Takes a settings file; `name` is that of a preset, empty for another file.
    std::function<Result<void>(const std::filesystem::path& file, const juce::String& name)> load;
    std::function<void(const juce::String& name)> onSaved = {}; ///< or not: the menu is to be filled again
    /// A preset has another name, or none: it is deleted. The menu is to be filled again.
    std::function<void(const juce::String& old, const juce::String& name)> onRenamed = {};

    /// Adds the presets, and what saves and loads.
    void addTo(juce::ComboBox& menu);
    /// False where an item is not one of these. Its work may end later.
    bool choose(int id);
    /// Writes the settings as a preset, after a question where there is one of this name.
    void saveAs(const juce::String& name);
    /// Gives a preset another name.
    void rename(const juce::String& old, const juce::String& name);
    /// Deletes a preset's file.
    void remove(const juce::String& name);
    /// See `load`; what fails is told.
    void open(const std::filesystem::path& file, const juce::String& name = {});

private:
    static constexpr int saveId = firstId, loadId = firstId + 1, manageId = firstId + 2, firstOwn = 2 * firstId;

    void manage();
    void askForName();
    void askToRename(const juce::String& name);
    void askToRemove(const juce::String& name);
    void renamed(const Result<void>& done, const char* failure, const juce::String& old, const juce::String& name);
    void tell(const juce::String& title, const Error& error);
    void write(const juce::String& name, bool replace);

    EditorView& view;
    const bool keeps;
    const SettingsPresets files;
    std::vector<std::string> names; ///< in the menu
    std::shared_ptr<int> alive = std::make_shared<int>(0);
};

} // namespace pacini::editor
