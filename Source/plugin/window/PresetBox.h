// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Menu of the presets: the shipped ones, the user's own, saving and deleting.

#include "document/SettingsPresets.h"
#include "editor/clip/sheets/SheetOver.h"
#include "plugin/window/Plugin.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>

namespace pacini::plugin
{

class PresetBox final : public juce::ComboBox
{
public:
    /// Questions are shown over `window`.
    PresetBox(Plugin& shown, std::function<void(std::unique_ptr<editor::Sheet>)> onAsk);

    /// Looks at the preset in use, with a mark where its values were changed since.
    void refresh();
    /// Reads the user's presets again.
    void reload();
    void showPopup() override;
    /// Arrows go from preset to preset, and to none of the actions below them.
    bool keyPressed(const juce::KeyPress& key) override;

    /// Asks for a name, and before another preset is replaced.
    void save();
    /// The user's preset in use, after a question.
    void remove();

private:
    static constexpr int userIds = 1000, brokenIds = 5000, saveId = 9001, deleteId = 9002;

    struct Shown
    {
        int id = 0;
        bool altered = false;
        bool operator==(const Shown&) const = default;
    };
    [[nodiscard]] Shown now() const;
    [[nodiscard]] juce::String nameOf(int id) const;
    void choose(int id);
    void write(const juce::String& name, bool replace);
    void tell(const juce::String& title, const Error& error);

    Plugin& processor;
    std::function<void(std::unique_ptr<editor::Sheet>)> ask;
    SettingsPresets files;
    PresetListing listing;
    Shown shown;
};

} // namespace pacini::plugin
