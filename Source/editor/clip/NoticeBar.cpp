// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/NoticeBar.h"

#include "editor/Theme.h"

namespace pacini::editor
{

namespace
{
constexpr int shownFor = 6000; // ms
}

NoticeBar::NoticeBar()
{
    setTitle("Notice");
    setInterceptsMouseClicks(false, false);
}

void NoticeBar::show(const juce::String& text)
{
    words = text;
    setDescription(text);
    setVisible(true);
    startTimer(shownFor);
    juce::AccessibilityHandler::postAnnouncement(text, juce::AccessibilityHandler::AnnouncementPriority::medium);
    repaint();
}

void NoticeBar::timerCallback()
{
    stopTimer();
    setVisible(false);
}

void NoticeBar::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    const int width = std::min(getWidth(), usualFont().getStringWidth(words) + 4 * grid);
    const auto area = getLocalBounds().withSizeKeepingCentre(width, getHeight()).toFloat().reduced(0.5f);
    g.setColour(p.card);
    g.fillRoundedRectangle(area, 6.0f);
    g.setColour(p.accent);
    g.drawRoundedRectangle(area, 6.0f, 1.0f);
    g.setColour(p.text);
    g.setFont(usualFont());
    g.drawFittedText(words, area.toNearestInt().reduced(grid, 0), juce::Justification::centred, 1);
}

} // namespace pacini::editor
