// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The whole clip editor as one component: for a window of its own, or for that of a plugin.

#include "editor/Theme.h"
#include "editor/clip/ClipView.h"
#include "editor/clip/Commands.h"
#include "editor/clip/EmptyState.h"
#include "editor/clip/Inspector.h"
#include "editor/clip/Session.h"
#include "editor/clip/Sheet.h"
#include "editor/clip/Toolbar.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace pacini::editor
{

class EditorView final : public juce::Component,
                         public juce::FileDragAndDropTarget,
                         private juce::MenuBarModel,
                         private juce::ApplicationCommandTarget,
                         private Session::Listener
{
public:
    EditorView(Session& shared, std::vector<std::filesystem::path> demoSounds);
    ~EditorView() override;

    std::function<void()> onQuit;
    std::function<void()> onDevices;      ///< null: the host has the devices
    std::function<void()> onTitleChanged; ///< see title()
    std::function<void()> onLookChanged;

    /// "name - changed".
    [[nodiscard]] juce::String title() const;
    void setDark(bool dark);
    [[nodiscard]] bool isDark() const noexcept { return look.isDark(); }
    /// 0.75 to 2.
    void setScale(double wanted);
    [[nodiscard]] double scale() const noexcept { return scaleNow; }

    /// Does `next` when the project is saved, or need not be; asks the user if so. Not at all when the user says no.
    void whenSaved(std::function<void()> next);
    /// Offers what an earlier run has left.
    void offerRecovery();
    void showSheet(std::unique_ptr<Sheet> wanted);
    /// Gives the keyboard to what is in front.
    void takeFocus();
    [[nodiscard]] Sheet* sheet() const noexcept { return sheetNow.get(); }

    void open(const std::vector<std::filesystem::path>& files);
    bool doCommand(Command command);
    [[nodiscard]] ClipView& clipView() noexcept { return clipPart; }

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    juce::StringArray getMenuBarNames() override;
    juce::PopupMenu getMenuForIndex(int index, const juce::String& name) override;
    void menuItemSelected(int id, int index) override;

    ApplicationCommandTarget* getNextCommandTarget() override { return nullptr; }
    void getAllCommands(juce::Array<juce::CommandID>& ids) override;
    void getCommandInfo(juce::CommandID id, juce::ApplicationCommandInfo& info) override;
    bool perform(const InvocationInfo& info) override;

    bool isInterestedInFileDrag(const juce::StringArray&) override { return true; }
    void fileDragEnter(const juce::StringArray&, int, int) override { empty.setDropping(true); }
    void fileDragExit(const juce::StringArray&) override { empty.setDropping(false); }
    void filesDropped(const juce::StringArray& files, int x, int y) override;

    void sessionChanged(unsigned changes) override;
    void arrange();
    void choose(const juce::String& title, bool saving, std::function<void(const juce::File&)> chosen);
    void saveThen(std::function<void()> next);
    void askName(std::function<void()> next);
    void selectAll();
    void playCommand(Command command);
    [[nodiscard]] bool canDo(Command command) const;
    [[nodiscard]] bool isOn(Command command) const;

    Session& session;
    Look look;
    double scaleNow = 1.0;
    std::vector<std::filesystem::path> demos;
    juce::ApplicationCommandManager commands;
    juce::Component body; ///< everything, scaled
    juce::MenuBarComponent menuBar;
    Toolbar toolbar;
    ClipView clipPart;
    Inspector inspector;
    EmptyState empty;
    std::unique_ptr<Sheet> sheetNow;
    std::unique_ptr<juce::FileChooser> chooser;
    juce::TooltipWindow tooltips{&body, 600};
};

} // namespace pacini::editor
