// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/ToolStrip.h"

#include "editor/Controls.h"
#include "editor/Fonts.h"

namespace pacini::editor
{

ToolStrip::ToolStrip(EditorModel& project, ViewState& sight)
    : model(project), viewState(sight), drawButton("Draw"), snapButton("Snap"), versionButton("A")
{
    setTitle("Tools");
    const auto prepare = [this](juce::ToggleButton& button, const juce::String& title, const juce::String& help,
                                std::function<void()> click)
    {
        prepareButton(button, help, std::move(click));
        button.setTitle(title);
        button.setClickingTogglesState(false);
        button.setWantsKeyboardFocus(true);
        addAndMakeVisible(button);
    };
    prepare(drawButton, "Draw", "Drag in a lane to draw its curve (D; hold to draw temporarily)",
            [this] { viewState.setDrawing(!viewState.isDrawing()); });
    prepare(snapButton, "Snap", "Dragging snaps to events, markers, playhead or ruler lines (N)",
            [this]
            {
                SnapTargets wanted = viewState.snapTargets();
                wanted.on = !wanted.on;
                viewState.setSnapTargets(wanted);
            });
    prepare(versionButton, "Version A", "Shows and plays version A (C)",
            [this] { model.setComparing(!model.isComparing()); });
    subscriptions.on({&viewState.lookChanged, &model.contentChanged, &model.versionChanged}, [this] { showState(); });
    showState();
}

void ToolStrip::showState()
{
    drawButton.setToggleState(viewState.isDrawing(), juce::dontSendNotification);
    snapButton.setToggleState(viewState.snapTargets().on, juce::dontSendNotification);
    versionButton.setToggleState(model.isComparing(), juce::dontSendNotification);
    versionButton.setEnabled(model.keptVersion() != nullptr);
}

void ToolStrip::resized()
{
    auto area = getLocalBounds().reduced(3);
    versionButton.setBounds(area.removeFromRight(24));
    area.removeFromRight(3);
    // By their texts, which differ in length.
    const int draw = smallFont().getStringWidth(drawButton.getButtonText());
    const int snap = smallFont().getStringWidth(snapButton.getButtonText());
    const int room = area.getWidth() - 3 - draw - snap;
    drawButton.setBounds(area.removeFromLeft(draw + room / 2));
    snapButton.setBounds(area.withTrimmedLeft(3));
}

} // namespace pacini::editor
