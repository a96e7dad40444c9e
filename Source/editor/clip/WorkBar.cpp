// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/WorkBar.h"

#include "editor/Controls.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
constexpr int ticksPerSecond = 20;
constexpr int barHeight = 4;
} // namespace

WorkBar::WorkBar(const EditorModel& project, ProjectSounds& projectSounds, const ViewState& sight)
    : model(project), sounds(projectSounds), viewState(sight), stopButton("Stop")
{
    setTitle("Progress");
    stopButton.setTitle("Cancel import");
    prepareButton(stopButton, "Cancels opening and analysis of the remaining files (Escape)",
                  [this] { sounds.stopWork(); });
    addAndMakeVisible(stopButton);
    subscriptions.on({&sounds.workChanged}, [this] { follow(); });
    follow();
}

std::unique_ptr<juce::AccessibilityHandler> WorkBar::createAccessibilityHandler()
{
    return std::make_unique<juce::AccessibilityHandler>(*this, juce::AccessibilityRole::group);
}

void WorkBar::follow()
{
    if (!sounds.workNow())
    {
        stopTimer();
        setVisible(false);
        ticks = 0;
        return;
    }
    // A sound that waits for its curves must say so at once.
    if (model.isShowingUnanalysed())
        timerCallback();
    if (!isTimerRunning())
        startTimerHz(ticksPerSecond);
}

void WorkBar::timerCallback()
{
    const auto now = sounds.workNow();
    if (!now || (++ticks < 3 && !model.isShowingUnanalysed()))
        return;
    if (!isVisible() || shown.text != now->text)
        setDescription(now->text);
    setVisible(true);
    const bool moves = now->progress < 0.0 && !viewState.viewOptions().reducedMotion;
    if (moves || shown != *now)
        repaint();
    shown = *now;
}

juce::Rectangle<int> WorkBar::bar() const
{
    return getLocalBounds().reduced(2 * grid, grid).removeFromBottom(barHeight);
}

void WorkBar::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    const auto area = getLocalBounds().toFloat().reduced(0.5f);
    g.setColour(p.card);
    g.fillRoundedRectangle(area, 6.0f);
    g.setColour(p.line);
    g.drawRoundedRectangle(area, 6.0f, 1.0f);
    g.setColour(p.text);
    g.setFont(usualFont());
    juce::String words = shown.text;
    if (shown.progress >= 0.0)
        words = tr("{0}, {1} %", {words, juce::String(juce::roundToInt(100.0 * shown.progress))});
    g.drawFittedText(
        words,
        getLocalBounds().reduced(2 * grid, grid).withTrimmedBottom(barHeight + 2).withRight(stopButton.getX() - grid),
        juce::Justification::centredLeft, 1);
    const auto whole = bar().toFloat();
    g.setColour(p.well);
    g.fillRoundedRectangle(whole, 2.0f);
    g.setColour(p.accent);
    // How far reading is nobody knows: a piece runs along.
    const float share = whole.getWidth() / 4.0f;
    const float place = viewState.viewOptions().reducedMotion
                            ? 0.5f
                            : static_cast<float>(ticks % ticksPerSecond) / static_cast<float>(ticksPerSecond);
    g.fillRoundedRectangle(shown.progress >= 0.0
                               ? whole.withWidth(whole.getWidth() * static_cast<float>(std::min(1.0, shown.progress)))
                               : whole.withWidth(share).translated(place * (whole.getWidth() - share), 0.0f),
                           2.0f);
}

void WorkBar::resized()
{
    auto area = getLocalBounds().reduced(2 * grid, 6).withTrimmedBottom(barHeight + 4);
    stopButton.setBounds(area.removeFromRight(8 * grid));
}

} // namespace pacini::editor
