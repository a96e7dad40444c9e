// SPDX-License-Identifier: GPL-3.0-or-later

// Where everything stands in the plugin's window.

#include "plugin/PluginWindow.h"

namespace pacini::plugin
{

namespace
{
using editor::grid;

constexpr int rowHeight = 3 * grid + 2;
constexpr int topCard = 28 * grid;
} // namespace

void PluginWindow::resized()
{
    cards.clear();
    const auto card = [this](juce::Rectangle<int> area, const juce::String& name)
    {
        cards.push_back({area, name});
        return editor::insideOfCard(area);
    };
    if (clipView)
        clipView->setBounds(getLocalBounds().withTrimmedTop(headerHeight));
    auto area = getLocalBounds().reduced(grid);
    placeHeader(area.removeFromTop(4 * grid).reduced(grid, 0));
    area.removeFromTop(grid);

    auto footer = area.removeFromBottom(5 * grid).reduced(grid, grid).withTrimmedBottom(-grid / 2);
    status.setBounds(footer.removeFromRight(footer.getWidth() * 2 / 5));
    capture.setBounds(footer.withTrimmedRight(2 * grid));

    auto lower = area.removeFromBottom(19 * grid);
    area.removeFromBottom(grid);

    auto left = area.removeFromLeft(31 * grid);
    area.removeFromLeft(grid);
    auto right = area.removeFromRight(31 * grid);
    area.removeFromRight(grid);
    bands.setBounds(card(area, "Bands"));
    const auto row = [](juce::Rectangle<int>& from)
    {
        const auto taken = from.removeFromTop(rowHeight);
        from.removeFromTop(grid);
        return taken;
    };

    auto sound = card(left.removeFromTop(topCard), "Sound");
    left.removeFromTop(grid);
    sourceChoice->setBounds(row(sound));
    sourceMix->setBounds(row(sound));
    inputGain->setBounds(row(sound));
    sound.removeFromTop(grid);
    inputMeter.setBounds(row(sound));
    lamp.setBounds(left.withHeight(4 * grid).withTrimmedRight(2 * grid).removeFromRight(3 * grid));
    placeKnobs(card(left, "Events"), {sensitivity.get(), sharpness.get()});

    auto touch = card(right.removeFromTop(topCard), "Touch");
    right.removeFromTop(grid);
    outputMode->setBounds(row(touch));
    outputChannel->setBounds(row(touch));
    touch.removeFromTop(grid);
    outputMeter.setBounds(row(touch));
    reductionMeter.setBounds(row(touch));
    feltMeter.setBounds(row(touch));
    placeKnobs(card(right, "Gate"), {gateThreshold.get(), gateRelease.get()});

    auto roles = card(lower.removeFromLeft(lower.getWidth() / 2 - grid / 2), "What is felt");
    lower.removeFromLeft(grid);
    for (std::size_t i = 0; i < roleLevels.size(); ++i)
    {
        auto line = roles.removeFromTop(roles.getHeight() / static_cast<int>(roleLevels.size() - i))
                        .withSizeKeepingCentre(roles.getWidth(), rowHeight);
        roleMutes[i]->setBounds(line.removeFromRight(7 * grid));
        line.removeFromRight(grid);
        roleLevels[i]->setBounds(line);
    }
    placeKnobs(card(lower, "Character"),
               {intensity.get(), brightness.get(), transposition.get(), direct.get(), attack.get(), release.get()});

    processor.setWindowSize(getWidth(), getHeight());
}

void PluginWindow::placeHeader(juce::Rectangle<int> area)
{
    area = area.withSizeKeepingCentre(area.getWidth(), rowHeight);
    area.removeFromLeft(10 * grid);
    themeButton.setBounds(area.removeFromRight(7 * grid));
    area.removeFromRight(grid);
    bypassToggle->setBounds(area.removeFromRight(9 * grid));
    area.removeFromRight(grid);
    clipsButton.setBounds(area.removeFromRight(8 * grid));
    area.removeFromRight(2 * grid);
    loadButton.setBounds(area.removeFromRight(9 * grid));
    area.removeFromRight(grid);
    actuator->setBounds(area.removeFromRight(area.getWidth() / 2).withTrimmedLeft(grid));
    programChoice.setBounds(area);
}

void PluginWindow::placeKnobs(juce::Rectangle<int> area, std::initializer_list<editor::ParameterSlider*> knobs)
{
    int left = static_cast<int>(knobs.size());
    for (editor::ParameterSlider* knob : knobs)
        knob->setBounds(area.removeFromLeft(area.getWidth() / left--));
}

} // namespace pacini::plugin
