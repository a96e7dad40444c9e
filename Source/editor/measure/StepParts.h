// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Common components of the measure page's steps: named controls, notes, tables.

#include "editor/Theme.h"

#include <pacini/actuator/ProfileMeasurement.h>

#include <juce_gui_basics/juce_gui_basics.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pacini::editor
{

inline constexpr int stepRow = 4 * grid;   ///< height of a control
inline constexpr int stepGap = grid / 2;   ///< between rows
inline constexpr int stepSide = 38 * grid; ///< width of the controls beside a plot

/// A control with its name at its left.
template <typename Control>
class Named final : public juce::Component
{
public:
    Named(const juce::String& name, const juce::String& help)
    {
        label.setText(name, juce::dontSendNotification);
        label.setFont(usualFont());
        label.setAccessible(false);
        control.setTitle(name);
        control.setTooltip(help);
        addAndMakeVisible(label);
        addAndMakeVisible(control);
    }
    void resized() override
    {
        auto area = getLocalBounds();
        label.setBounds(area.removeFromLeft(labelWidth));
        if constexpr (std::is_same_v<Control, juce::ComboBox>)
            area = area.withWidth(std::min(area.getWidth(), space::widestBox));
        control.setBounds(area);
    }
    void enablementChanged() override { label.setEnabled(isEnabled()); }

    Control control;
    int labelWidth = 12 * grid;

private:
    juce::Label label;
};

/// A horizontal slider with its value and unit in a field.
void prepareSlider(juce::Slider& slider, double least, double most, double step, const juce::String& unit,
                   int decimals);

/// The same with its sign, for what is a change.
[[nodiscard]] juce::String signedText(double value, int decimals);

/// Where a response is off its mean the most, and by how much.
[[nodiscard]] juce::String worstText(const Linearity& linearity);

/// The ground of a step: a card of that title at its side, and one for a plot.
void drawSideAndPlot(juce::Graphics& g, const juce::Component& step, const juce::String& title);

struct Note
{
    enum class Kind
    {
        plain,
        warning
    };
    std::string text;
    Kind kind = Kind::plain;
    bool operator==(const Note&) const = default;
};

/// A scrollable list of notes.
class NoteBox final : public juce::TextEditor
{
public:
    explicit NoteBox(const juce::String& name);
    void show(std::vector<Note> wanted);
    [[nodiscard]] const std::vector<Note>& shown() const noexcept { return notes; }

private:
    void lookAndFeelChanged() override;
    void parentHierarchyChanged() override { fill(); }
    void fill();
    std::vector<Note> notes;
};

/// Names and values, one below the other.
class FactTable final : public juce::Component
{
public:
    using Facts = std::vector<std::pair<juce::String, juce::String>>;
    explicit FactTable(const juce::String& name) { setTitle(name); }
    void show(Facts wanted);
    [[nodiscard]] const Facts& shown() const noexcept { return facts; }
    [[nodiscard]] int wantedHeight() const noexcept { return static_cast<int>(facts.size()) * rowHeight; }
    void paint(juce::Graphics& g) override;

private:
    static constexpr int rowHeight = 22;
    Facts facts;
};

/// One step of the page. refresh() after changes, tick() 30 times a second while it is shown.
class StepPanel : public juce::Component
{
public:
    virtual void refresh() = 0;
    virtual void tick() {}
    /// What is done in this step, where that is one button; it stands out until the next step can be gone to.
    [[nodiscard]] virtual juce::Button* action() { return nullptr; }
    [[nodiscard]] virtual int leastHeight() const { return 416; }
    static constexpr int leastWidth = 656;
};

/// Services of the page that a step may ask for.
struct StepServices
{
    std::function<void(const juce::String& title, const juce::String& pattern, bool saving, const juce::String& name,
                       std::function<void(const juce::File&)> chosen)>
        askForFile;
    std::function<void(bool throughEqualizer)> saveSweep;
    /// Writes after a question where a file would be lost; true of `write`: it has been written.
    std::function<void(const std::vector<std::filesystem::path>& files, std::function<bool()> write)> save;
    std::function<void()> showDevices; ///< empty: there are none to choose
};

} // namespace pacini::editor
