// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Base class of the lanes: a head with the name, and a plot over time whose things can be picked, moved and added.

#include "document/view/ValueTicks.h"
#include "editor/clip/commands/ContextMenu.h"
#include "editor/clip/session/Transport.h"
#include "editor/clip/session/ViewState.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace pacini::editor
{

inline constexpr int laneHeadWidth = 144; ///< pixels, of all rows alike

/// Handles mouse and keys in the same way for all kinds of lanes; each kind defines the positions of its items and the
/// effect of moving them. Paints only the invalidated part.
class PlotLane : public juce::Component, public juce::SettableTooltipClient, public ContextMenu
{
public:
    PlotLane(EditorModel& project, ClipSelection& selected, ViewState& sight, Transport& playing);

    [[nodiscard]] juce::Rectangle<int> plotArea() const noexcept
    {
        return getLocalBounds().withTrimmedLeft(laneHeadWidth).withTrimmedBottom(1);
    }

    /// Adds what lies in a rectangle of this component to a selection. For a marquee over several lanes.
    virtual void addInside(Selection& selection, juce::Rectangle<float> area) const = 0;

    /// A drag that began where nothing is, in coordinates of this component; `over` when the button is released.
    std::function<void(PlotLane& lane, const juce::MouseEvent& event, bool over)> onMarquee;

    void paint(juce::Graphics& g) final;
    [[nodiscard]] std::vector<Command> contextCommands() const override;
    void mouseMove(const juce::MouseEvent& event) override;
    void mouseExit(const juce::MouseEvent& event) override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseDrag(const juce::MouseEvent& event) override;
    void mouseUp(const juce::MouseEvent& event) override;
    void mouseDoubleClick(const juce::MouseEvent& event) override;
    bool keyPressed(const juce::KeyPress& key) override;
    void focusGained(FocusChangeType) override { repaint(); }
    void focusLost(FocusChangeType) override { repaint(); }

protected:
    struct Style
    {
        juce::String name, note; ///< the head's two lines
        juce::Colour colour;
        juce::String behind = {}; ///< what a thin line in the plot is; empty: there is none
    };

    [[nodiscard]] virtual Style style() const = 0;
    /// Of a plot of `height` pixels; asked again when the content has changed.
    [[nodiscard]] virtual ValueAxis valueAxis(double height) const = 0;
    virtual void paintPlot(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn) = 0;
    [[nodiscard]] virtual std::optional<std::size_t> thingAt(juce::Point<float> place) const = 0;
    [[nodiscard]] virtual std::size_t count() const = 0;
    [[nodiscard]] virtual Breakpoint place(std::size_t thing) const = 0; ///< time and the value that is shown
    [[nodiscard]] virtual Indices picked() const = 0;
    [[nodiscard]] virtual Selection pick(Selection selection, Indices things) const = 0;
    [[nodiscard]] virtual EditedClip added(const Clip& clip, Breakpoint where) const = 0;
    /// How everything selected moves when the thing at `from` goes to `to`.
    [[nodiscard]] virtual SelectionMove move(Breakpoint from, Breakpoint to) const = 0;
    [[nodiscard]] virtual juce::String valueText(double value) const = 0;
    /// A value of the scale, without its unit.
    [[nodiscard]] virtual juce::String tickText(double value) const;
    /// A drag that is for a tool and not for things; false: there is none for it.
    virtual bool beginTool(const juce::MouseEvent&) { return false; }
    virtual void dragTool(const juce::MouseEvent&) {}
    virtual void endTool() {}
    /// Of a pointer that is over the plot and over nothing in it.
    [[nodiscard]] virtual juce::MouseCursor cursorAt(const juce::MouseEvent&) const
    {
        return juce::MouseCursor::NormalCursor;
    }
    /// The time in which the plot of `now` differs from that of `before`, of the same scale; from > to: nowhere.
    /// Nothing: everywhere.
    [[nodiscard]] virtual std::optional<TimeRange> changedTime(const Clip& before, const Clip& now) const = 0;
    /// What changed lies between the neighbours of the first and the last of a list's items that differ.
    template <typename Item>
    [[nodiscard]] static TimeRange changedTime(const std::vector<Item>& before, const std::vector<Item>& now);

    void say(const juce::String& text);
    [[nodiscard]] const ValueAxis& scale() const;
    void forgetScale() { scaleNow.reset(); }
    [[nodiscard]] juce::Point<float> pointOf(Breakpoint p) const;
    [[nodiscard]] Breakpoint placeAt(juce::Point<float> position) const;
    [[nodiscard]] static ValueAxis amplitudeAxis(bool decibels, double highest, double height);
    [[nodiscard]] static SelectionMove amplitudeMove(double from, double to);

    EditorModel& model;
    ClipSelection& clipSelection;
    ViewState& viewState;
    Transport& transport;
    Subscriptions subscriptions;

private:
    bool repaintChanged();
    void repaintAll();
    void paintHead(juce::Graphics& g);
    void paintTicks(juce::Graphics& g, juce::Rectangle<int> column, juce::Justification side);
    void nudge(double pixels, double steps);
    void scaleByKeys(double pixels, double steps);
    bool beginNudge(bool scaling);
    void step(int direction);
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override;

    enum class Drag
    {
        none,
        things,
        marquee,
        tool
    };
    mutable std::optional<ValueAxis> scaleNow;
    std::shared_ptr<const Clip> drawn; ///< the content of the last repaint
    std::optional<Indices> drawnPicked;
    juce::String drawnNote;
    Drag drag = Drag::none;
    Gesture gesture = 0;
    Selection dragged; ///< at the start of the gesture
    Breakpoint grabbed;
    Gesture nudging = 0; ///< by keys
    Selection nudged;    ///< where the last one has brought it
    bool nudgeScales = false;
    double nudgedPixels = 0.0, nudgedSteps = 0.0;
    juce::uint32 lastNudge = 0;
    std::optional<std::size_t> hovered;
};

template <typename Item>
TimeRange PlotLane::changedTime(const std::vector<Item>& before, const std::vector<Item>& now)
{
    constexpr double everything = std::numeric_limits<double>::infinity();
    const std::size_t both = std::min(before.size(), now.size());
    std::size_t first = 0;
    while (first < both && before[first] == now[first])
        ++first;
    if (first == before.size() && first == now.size())
        return {1.0, 0.0};
    std::size_t last = 0; // from the end
    while (last < both - first && before[before.size() - 1 - last] == now[now.size() - 1 - last])
        ++last;
    return {first > 0 ? now[first - 1].time : -everything, last > 0 ? now[now.size() - last].time : everything};
}

} // namespace pacini::editor
