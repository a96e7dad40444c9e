// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/EditorWindow.h"

#include "app/WindowPlace.h"
#include "app/editor/DevicesSheet.h"
#include "app/editor/MeasureDevice.h"
#include "app/editor/PhoneSheet.h"
#include "editor/Text.h"
#include "editor/Translation.h"

#include <algorithm>

namespace pacini::app
{

namespace
{
constexpr int leastWidth = 880, leastHeight = 560;
constexpr const char* maximisedMark = "max ";

/// The shipped profile of what a controller has; empty: none is known.
const char* profileFor(devices::ControllerHaptics haptics)
{
    switch (haptics)
    {
    case devices::ControllerHaptics::hdRumble:
        return "joycon-hd-rumble";
    case devices::ControllerHaptics::dualSense:
        return "dualsense-voice-coil";
    case devices::ControllerHaptics::dualShock4:
    case devices::ControllerHaptics::xbox:
        return "erm-coin";
    case devices::ControllerHaptics::waveforms:
    case devices::ControllerHaptics::steamController:
    case devices::ControllerHaptics::steamDeck:
        break;
    }
    return "";
}
} // namespace

EditorWindow::EditorWindow(editor::Session& session, PreviewDevices& wanted, editor::HostServices around)
    : DocumentWindow("Pacini Editor", juce::Colours::black, DocumentWindow::allButtons),
      rig(wanted),
      controllers(session.model, session.clipSelection, session.transport),
      phones(session.model, session.transport),
      taps(session.tapping, session.transport),
      content(session, completed(std::move(around)))
{
    setUsingNativeTitleBar(true);
    setContentNonOwned(&content, false);
    setResizable(true, false);
    setResizeLimits(leastWidth, leastHeight, 6000, 4000);
    content.onTitleChanged = [this]
    {
        setName(content.title());
    };
    setName(content.title());
}

editor::HostServices EditorWindow::completed(editor::HostServices around)
{
    around.quit = []
    {
        juce::JUCEApplication::getInstance()->systemRequestedQuit();
    };
    around.showDevices = [this]
    {
        showDevices();
    };
    around.feelOnPhone = [this]
    {
        feelOnPhone();
    };
    around.reconnect = [this]
    {
        return rig.reconnect();
    };
    around.playsElsewhere = [this]
    {
        return controllers.chosen().has_value() || phones.server() != nullptr;
    };
    around.outputNames = [this]
    {
        return rig.outputNames();
    };
    around.foundDevices = [this]
    {
        return found();
    };
    around.measureRig = std::make_shared<MeasureDevice>(rig.devices(), &rig.hapticOutputs());
    return around;
}

std::vector<editor::FoundDevice> EditorWindow::found()
{
    std::vector<editor::FoundDevice> list;
    const auto connected = ControllerOutput::connected();
    for (const devices::Controller& each : connected ? *connected : std::vector<devices::Controller>())
    {
        editor::FoundDevice device;
        device.name = each.name.empty() ? editor::tr("Game controller") : editor::toText(each.name);
        device.profile = profileFor(each.haptics);
        device.chosen = controllers.chosen() && controllers.chosen()->path == each.path;
        device.choose = [this, each]
        {
            return controllers.choose(each);
        };
        list.push_back(std::move(device));
    }
    return list;
}

EditorWindow::~EditorWindow()
{
    clearContentComponent();
}

void EditorWindow::closeButtonPressed()
{
    juce::JUCEApplication::getInstance()->systemRequestedQuit();
}

void EditorWindow::open(const juce::String& state)
{
    constexpr int usualWidth = 1280, usualHeight = 800;
    centreWithSize(usualWidth, usualHeight);
    const auto& displays = juce::Desktop::getInstance().getDisplays();
    const bool known = state.isNotEmpty() && restoreWindowStateFromString(state.trimCharactersAtStart(maximisedMark));
    if (!known)
        centreWithSize(usualWidth, usualHeight);
    if (const auto* display = displays.getDisplayForRect(getBounds()))
    {
        const auto screen = display->userArea;
        // The least size gives way to a screen that is even less.
        setResizeLimits(std::min(leastWidth, screen.getWidth()),
                        std::min(leastHeight, screen.getHeight() - usualTitleBar), 6000, 4000);
        if (!isFullScreen())
            setBounds(insideOf(screen, getBounds()));
    }
    setVisible(true);
    if (state.startsWith(maximisedMark))
        setFullScreen(true);
}

juce::String EditorWindow::state()
{
    // Window managers that maximise do not tell JUCE.
    const auto* display = juce::Desktop::getInstance().getDisplays().getDisplayForRect(getBounds());
    const bool maximised = isFullScreen() || (display != nullptr && fills(display->userArea, getBounds()));
    return (maximised ? juce::String(maximisedMark) : juce::String()) +
           getWindowStateAsString().trimCharactersAtStart("fs ");
}

void EditorWindow::showDevices()
{
    auto sheet = std::make_unique<DevicesSheet>(rig, controllers);
    sheet->onHapticOutputs = [this]
    {
        content.doCommand(editor::hapticOutputs);
    };
    content.showSheet(std::move(sheet));
}

void EditorWindow::feelOnPhone()
{
    const auto started = phones.start();
    if (!started)
    {
        content.session().model.onError(editor::tr("Phones cannot be let in"), editor::toText(started.error().text()));
        return;
    }
    content.showSheet(std::make_unique<PhoneSheet>(phones));
}

} // namespace pacini::app
