// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/ToolStrip.h"

namespace pacini::editor
{

ToolStrip::ToolStrip(Session& shared) : session(shared), drawButton("Draw"), snapButton("Snap"), versionButton("A")
{
    setTitle("Tools");
    const auto prepare = [this](juce::ToggleButton& button, const juce::String& title, const juce::String& help)
    {
        button.setTitle(title);
        button.setTooltip(help);
        button.setClickingTogglesState(false);
        button.setWantsKeyboardFocus(true);
        addAndMakeVisible(button);
    };
    prepare(drawButton, "Draw", "A drag in a lane draws its curve (D; held: as long as it is held)");
    prepare(snapButton, "Snap", "Dragging snaps to transients, markers, playhead or ruler lines (N)");
    prepare(versionButton, "Version A", "Shows and plays the version that was kept as A in the clip menu (C)");
    drawButton.onClick = [this]
    {
        session.setDrawing(!session.isDrawing());
    };
    snapButton.onClick = [this]
    {
        SnapTargets wanted = session.snapTargets();
        wanted.on = !wanted.on;
        session.setSnapTargets(wanted);
    };
    versionButton.onClick = [this]
    {
        session.setComparing(!session.isComparing());
    };
    session.listeners.add(this);
    showState();
}

ToolStrip::~ToolStrip()
{
    session.listeners.remove(this);
}

void ToolStrip::sessionChanged(unsigned changes)
{
    if ((changes & (Session::look | Session::playback | Session::content | Session::project)) != 0)
        showState();
}

void ToolStrip::showState()
{
    drawButton.setToggleState(session.isDrawing(), juce::dontSendNotification);
    snapButton.setToggleState(session.snapTargets().on, juce::dontSendNotification);
    versionButton.setToggleState(session.isComparing(), juce::dontSendNotification);
    versionButton.setEnabled(session.keptVersion() != nullptr);
}

void ToolStrip::resized()
{
    auto area = getLocalBounds().reduced(3);
    versionButton.setBounds(area.removeFromRight(24));
    area.removeFromRight(3);
    const int half = (area.getWidth() - 3) / 2;
    drawButton.setBounds(area.removeFromLeft(half));
    snapButton.setBounds(area.removeFromRight(half));
}

} // namespace pacini::editor
