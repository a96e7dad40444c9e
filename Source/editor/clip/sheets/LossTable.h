// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Table of what an export loses: each kind of loss once, how often, and where it is worst.

#include "editor/List.h"
#include "io/formats/ClipFormat.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <string>
#include <vector>

namespace pacini::editor
{

/// Losses that say the same but for their numbers.
struct LossGroup
{
    FormatLoss worst; ///< by its error; its message is shown
    std::size_t count = 0;
};

/// In the order in which the first of each came.
[[nodiscard]] std::vector<LossGroup> groupedLosses(const std::vector<FormatLoss>& losses);

/// A click or Return on a row shows its place in the clip.
class LossTable final : public juce::Component, private juce::ListBoxModel
{
public:
    LossTable();
    ~LossTable() override;

    /// The losses of one clip in one format; `title` is empty where there is only one of both.
    struct Part
    {
        juce::String title;
        std::vector<FormatLoss> losses;
        int clip = 0; ///< its id
    };
    void show(const std::vector<Part>& parts);
    [[nodiscard]] bool isEmpty() const noexcept { return rows.empty(); }

    std::function<void(int clip, double time, double duration)> onPlace; ///< s

    int getNumRows() override { return static_cast<int>(rows.size()); }
    juce::String getNameForRow(int row) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    struct Row
    {
        juce::String loss, count, worst, place;
        double time = 0.0, duration = 0.0;
        int clip = 0;
        bool isTitle = false;
    };

    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected) override;
    void listBoxItemClicked(int row, const juce::MouseEvent& event) override;
    void returnKeyPressed(int row) override { go(row); }
    juce::String getTooltipForRow(int row) override;
    void go(int row);

    std::vector<Row> rows;
    List list{{}, this};
};

} // namespace pacini::editor
