// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Main view of the clip editor as one component: for a window of its own, or for that of a plugin.

#include "document/measure/MeasureRig.h"
#include "editor/SpokenStatus.h"
#include "editor/Theme.h"
#include "editor/clip/NoticeBar.h"
#include "editor/clip/ProjectFiles.h"
#include "editor/clip/SideDivider.h"
#include "editor/clip/StartPage.h"
#include "editor/clip/StatusBar.h"
#include "editor/clip/Toolbar.h"
#include "editor/clip/WorkBar.h"
#include "editor/clip/commands/HeldSwitch.h"
#include "editor/clip/commands/Menus.h"
#include "editor/clip/lanes/ClipView.h"
#include "editor/clip/panels/MeterPanel.h"
#include "editor/clip/panels/SidePanel.h"
#include "editor/clip/session/Session.h"
#include "editor/clip/sheets/ExportSheet.h"
#include "editor/clip/sheets/Sheet.h"
#include "editor/clip/sheets/SheetOver.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pacini::editor
{

/// Services of the program or plugin around an editor; menus omit missing services.
struct HostServices
{
    std::vector<std::filesystem::path> demoSounds;               ///< those of the library too
    std::function<void()> quit;                                  ///< null: the host closes the window
    std::function<void()> showDevices;                           ///< null: the host has the devices
    std::function<juce::StringArray()> outputNames = {};         ///< of the device; null: the host has one output
    std::function<std::vector<FoundDevice>()> foundDevices = {}; ///< for the start page; null: nobody looks
    std::shared_ptr<MeasureRig> measureRig = {};                 ///< null: only simulated actuators can be measured
    std::filesystem::path profileFolder = {};                    ///< where measured profiles are written at first
    std::filesystem::path presetFolder = {};          ///< of the user's analysis presets; empty: none are kept
    std::filesystem::path outputPresetFolder = {};    ///< of those of haptic outputs
    std::filesystem::path characterPresetFolder = {}; ///< of those of the live controls
    juce::String language = {};                       ///< code of the chosen one; empty: that of the system
    std::function<void(const juce::String&)> chooseLanguage = {};    ///< from the next start on; null: not here
    std::function<void(const std::filesystem::path&)> runStudy = {}; ///< of that file; null: not here
    std::function<void()> feelOnPhone = {};                          ///< lets a phone in; null: not here
    std::function<bool()> reconnect = {};      ///< opens a sound device, if there is one; null: the host has devices
    std::function<bool()> playsElsewhere = {}; ///< see HapticOutputs
    juce::String version = {};                 ///< of the program; empty: not told
};

/// Layout, look and sheets; the menus implement the commands.
class EditorView final : public juce::Component, public juce::FileDragAndDropTarget, private juce::FocusChangeListener
{
public:
    EditorView(Session& shared, HostServices around);
    ~EditorView() override;

    std::function<void()> onTitleChanged; ///< see title()
    ExportMemory lastExport;              ///< kept by the program

    /// "name - changed".
    [[nodiscard]] juce::String title() const;
    void setDark(bool dark);
    [[nodiscard]] bool isDark() const noexcept { return look.isDark(); }
    /// 0.75 to 2. Where the window has no room for it, all is drawn as large as fits.
    void setScale(double wanted);
    [[nodiscard]] double scale() const noexcept { return scaleNow; }
    [[nodiscard]] double shownScale() const noexcept;

    static constexpr int usualSideWidth = 248; ///< also the least
    /// Points; at most half the window, less than the least: the usual width.
    void setSideWidth(int wanted);
    [[nodiscard]] int sideWidth() const noexcept { return sideWidthNow; }
    void showSide(bool wanted);
    [[nodiscard]] bool isSideShown() const noexcept { return sideShown; }

    void showSheet(std::unique_ptr<Sheet> wanted);
    /// Shows it when the sheets before it are closed: no question is lost behind another.
    void showMessage(std::unique_ptr<Sheet> wanted);
    [[nodiscard]] Sheet* sheet() const noexcept { return sheetNow.get(); }
    /// Shows a question at once, in front of a sheet that is open.
    void ask(std::unique_ptr<Sheet> question);
    [[nodiscard]] Sheet* question() const noexcept { return over.sheet() != nullptr ? over.sheet() : sheet(); }
    /// Gives the keyboard to what is in front.
    void takeFocus();
    /// Gives it to the next part of the window (1), or the one before (-1).
    void focusPart(int direction);
    /// That of a component or of what it lies in, beside it or at the pointer; false where there is none.
    bool showContextMenu(juce::Component* of, bool atPointer);

    bool keyPressed(const juce::KeyPress& key) override;
    void mouseDown(const juce::MouseEvent& event) override;

    static constexpr int drawKeyCode = 'd';
    /// Drawing on or off; by its key, which may be held, see HeldSwitch.
    void switchDrawing();
    bool keyStateChanged(bool isKeyDown) override;

    /// False when it cannot be done now.
    bool doCommand(Command command) { return menuList.perform(command); }

    [[nodiscard]] const HostServices& hostServices() const noexcept { return host; }
    [[nodiscard]] Session& session() noexcept { return open; }
    [[nodiscard]] ProjectFiles& files() noexcept { return fileQuestions; }
    [[nodiscard]] Menus& menus() noexcept { return menuList; }
    [[nodiscard]] ClipView& clipView() noexcept { return clipPart; }
    [[nodiscard]] SidePanel& sidePanel() noexcept { return side; }
    [[nodiscard]] StartPage& startPage() noexcept { return start; }
    [[nodiscard]] StatusBar& statusBar() noexcept { return status; }

    void paint(juce::Graphics& g) override;
    void resized() override;

    /// Scrolls what has the keyboard into view; not while a mouse button is down, which would move what it holds.
    static void scrollIntoView(juce::Component& focused);

private:
    void globalFocusChanged(juce::Component* focused) override;
    void returnFocus();
    void showOpenedScene();
    void tellNowhere();
    void reconnect();
    void speak(const juce::String& text);
    void speakStatus();
    bool isInterestedInFileDrag(const juce::StringArray&) override { return true; }
    void fileDragEnter(const juce::StringArray&, int, int) override { start.setDropping(true); }
    void fileDragExit(const juce::StringArray&) override { start.setDropping(false); }
    void filesDropped(const juce::StringArray& files, int x, int y) override;

    void connectParts();   ///< what they ask for is done
    void connectSession(); ///< what it tells is shown
    void arrange();

    Session& open;
    const HostServices host;
    Look look;
    double scaleNow = 1.0;
    int sideWidthNow = usualSideWidth;
    bool sideShown = true;
    ProjectFiles fileQuestions{*this};
    Menus menuList{*this};
    juce::Component body; ///< everything, scaled
    juce::MenuBarComponent menuBar;
    Toolbar toolbar;
    ClipView clipPart;
    SidePanel side;
    SideDivider divider;
    MeterPanel meters;
    StartPage start;
    StatusBar status;
    WorkBar workBar;
    NoticeBar notice;
    SheetOver over{body};
    std::unique_ptr<Sheet> sheetNow;
    SafePointer<juce::Component> focusedBefore;  ///< the sheet
    std::deque<std::unique_ptr<Sheet>> messages; ///< that wait
    HeldSwitch drawKey;
    SpokenStatus speaker;
    juce::String spokenPlace; ///< what plays where, as it was said
    std::optional<bool> spokenPlaying;
    juce::TooltipWindow tooltips{&body, 600};
    Subscriptions subscriptions;
};

} // namespace pacini::editor
