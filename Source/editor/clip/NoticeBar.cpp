// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/NoticeBar.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
constexpr int shownFor = 6000, shownWithButtonFor = 15000, advisedFor = 30000; // ms
constexpr int folderWidth = 18 * grid;
} // namespace

NoticeBar::NoticeBar()
{
    setTitle("Notice");
    setInterceptsMouseClicks(false, true);
    setAlwaysOnTop(true);
    folderButton.setButtonText("Show in folder");
    folderButton.setTitle("Show in folder");
    prepareButton(folderButton, "Shows the file in the file manager", [this] { written.revealToUser(); });
    addChildComponent(folderButton);
}

void NoticeBar::show(const juce::String& text)
{
    folderButton.setVisible(false);
    tell(text, shownFor);
}

void NoticeBar::showAdvice(const juce::String& text)
{
    folderButton.setVisible(false);
    tell(text, advisedFor);
}

void NoticeBar::showWritten(const std::vector<std::filesystem::path>& files)
{
    if (files.empty())
        return;
    written = juce::File(pathText(files.front()));
    folderButton.setVisible(true);
    tell(files.size() == 1 ? tr("Written: {0}", {pathText(files.front().filename())})
                           : tr("{0} files written to {1}", {juce::String(static_cast<int>(files.size())),
                                                             pathText(files.front().parent_path().filename())}),
         shownWithButtonFor);
}

void NoticeBar::tell(const juce::String& text, int milliseconds)
{
    words = text;
    setDescription(text);
    setVisible(true);
    resized();
    startTimer(milliseconds);
    juce::AccessibilityHandler::postAnnouncement(text, juce::AccessibilityHandler::AnnouncementPriority::medium);
    repaint();
}

void NoticeBar::timerCallback()
{
    stopTimer();
    setVisible(false);
}

juce::Rectangle<int> NoticeBar::box() const
{
    const int wanted =
        usualFont().getStringWidth(words) + 4 * grid + (folderButton.isVisible() ? folderWidth + grid : 0);
    return getLocalBounds().withSizeKeepingCentre(std::min(getWidth(), wanted), getHeight());
}

void NoticeBar::resized()
{
    folderButton.setBounds(box().reduced(grid / 2).removeFromRight(folderWidth));
}

void NoticeBar::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    auto area = box();
    g.setColour(p.card);
    g.fillRoundedRectangle(area.toFloat().reduced(0.5f), 6.0f);
    g.setColour(p.accent);
    g.drawRoundedRectangle(area.toFloat().reduced(0.5f), 6.0f, 1.0f);
    if (folderButton.isVisible())
        area.removeFromRight(folderWidth + grid);
    g.setColour(p.text);
    g.setFont(usualFont());
    g.drawFittedText(words, area.reduced(grid, 0), juce::Justification::centred, 1);
}

} // namespace pacini::editor
