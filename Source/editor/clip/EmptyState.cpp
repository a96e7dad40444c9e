// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EmptyState.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
constexpr std::size_t maxDemos = 4;
constexpr std::size_t maxRecent = 4;
constexpr int rowHeight = 4 * grid;

juce::String shownName(const std::filesystem::path& file)
{
    return pathText(file.stem()).replaceCharacter('_', ' ');
}
} // namespace

EmptyState::EmptyState(EditorModel& project, std::vector<std::filesystem::path> demoSounds)
    : model(project), demos(std::move(demoSounds)), openButton(toText("Open…"))
{
    setTitle("No clip yet");
    prepareButton(openButton, "Opens sounds, clips and projects (Ctrl+O)", [this] { onOpen(); });
    addAndMakeVisible(openButton);
    subscriptions.on({&model.projectChanged}, [this] { fill(); });
    fill();
}

void EmptyState::fill()
{
    const auto make = [this](std::vector<std::unique_ptr<juce::TextButton>>& list, const std::filesystem::path& file,
                             const juce::String& help)
    {
        auto button = std::make_unique<juce::TextButton>(shownName(file));
        prepareButton(*button, tr(help, {pathText(file)}), [this, file] { onFile(file); });
        addAndMakeVisible(*button);
        list.push_back(std::move(button));
    };
    demoButtons.clear();
    recentButtons.clear();
    for (std::size_t i = 0; i < std::min(demos.size(), maxDemos); ++i)
        make(demoButtons, demos[i], "Opens the demo sound {0}");
    for (const auto& file : model.recentFiles().files())
        if (recentButtons.size() < maxRecent && RecentFiles::exists(file))
            make(recentButtons, file, "Opens the project {0}");
    resized();
    repaint();
}

void EmptyState::setDropping(bool dropping)
{
    dropNow = dropping;
    repaint();
}

juce::Rectangle<int> EmptyState::field() const
{
    return getLocalBounds().withSizeKeepingCentre(std::min(720, getWidth() - 4 * grid),
                                                  std::min(recentButtons.empty() ? 288 : 408, getHeight() - 4 * grid));
}

void EmptyState::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.background);
    const auto area = field();
    g.setColour(dropNow ? p.accent.withAlpha(0.15f) : p.card);
    g.fillRoundedRectangle(area.toFloat(), 10.0f);
    juce::Path outline, dashes;
    outline.addRoundedRectangle(area.toFloat().reduced(1.0f), 10.0f);
    const float lengths[] = {8.0f, 6.0f};
    juce::PathStrokeType(1.5f).createDashedStroke(dashes, outline, lengths, 2);
    g.setColour(dropNow ? p.accent : p.line);
    g.fillPath(dashes);
    auto text = area.reduced(4 * grid).removeFromTop(9 * grid);
    g.setColour(p.text);
    g.setFont(titleFont());
    g.drawText(tr("Drop a sound or a clip here"), text.removeFromTop(4 * grid), juce::Justification::centred);
    g.setColour(p.dim);
    g.setFont(usualFont());
    g.drawFittedText(tr("Pacini turns it into curves and events that you can reshape, feel and export."),
                     text.removeFromTop(3 * grid), juce::Justification::centred, 1);
    g.setFont(smallFont());
    const auto heading = [&](const std::vector<std::unique_ptr<juce::TextButton>>& list, const juce::String& words)
    {
        if (!list.empty())
            g.drawText(
                tr(words),
                list.front()->getBounds().withWidth(area.getWidth()).translated(0, -3 * grid).withHeight(2 * grid),
                juce::Justification::centredLeft);
    };
    heading(demoButtons, "Demo sounds");
    heading(recentButtons, "Recent projects");
}

void EmptyState::resized()
{
    auto area = field().reduced(4 * grid).withTrimmedTop(9 * grid);
    auto row = area.removeFromTop(rowHeight + grid);
    openButton.setBounds(row.withSizeKeepingCentre(20 * grid, rowHeight));
    const auto grid4 = [&](std::vector<std::unique_ptr<juce::TextButton>>& list)
    {
        if (list.empty())
            return;
        area.removeFromTop(4 * grid);
        for (std::size_t i = 0; i < list.size(); i += 2)
        {
            auto line = area.removeFromTop(rowHeight);
            const int half = (line.getWidth() - grid) / 2;
            list[i]->setBounds(line.removeFromLeft(half));
            line.removeFromLeft(grid);
            if (i + 1 < list.size())
                list[i + 1]->setBounds(line);
            area.removeFromTop(grid / 2);
        }
    };
    grid4(demoButtons);
    grid4(recentButtons);
}

} // namespace pacini::editor
