// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/EditorWindow.h"

#include "app/editor/DevicesSheet.h"
#include "app/editor/MeasureDevice.h"

namespace pacini::app
{

EditorWindow::EditorWindow(editor::Session& session, PreviewDevices& wanted, editor::HostServices around)
    : DocumentWindow("Pacini Editor", juce::Colours::black, DocumentWindow::allButtons),
      rig(wanted),
      controllers(session.model, session.clipSelection, session.transport),
      content(session, completed(std::move(around)))
{
    setUsingNativeTitleBar(true);
    setContentNonOwned(&content, false);
    setResizable(true, false);
    setResizeLimits(880, 560, 6000, 4000);
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
    around.outputNames = [this]
    {
        return rig.outputNames();
    };
    around.measureRig = std::make_shared<MeasureDevice>(rig.devices());
    return around;
}

EditorWindow::~EditorWindow()
{
    clearContentComponent();
}

void EditorWindow::closeButtonPressed()
{
    juce::JUCEApplication::getInstance()->systemRequestedQuit();
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

} // namespace pacini::app
