// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Clip view: everything that a clip holds over one time axis.

#include "editor/clip/commands/Command.h"
#include "editor/clip/lanes/ActuatorRow.h"
#include "editor/clip/lanes/BrightnessLine.h"
#include "editor/clip/lanes/MarkerStrip.h"
#include "editor/clip/lanes/Overview.h"
#include "editor/clip/lanes/PlotLane.h"
#include "editor/clip/lanes/SelectionBar.h"
#include "editor/clip/lanes/TimeRuler.h"
#include "editor/clip/lanes/ToolStrip.h"
#include "editor/clip/lanes/WaveformRow.h"
#include "editor/clip/session/Session.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace pacini::editor
{

/// Ruler, markers (if any) and sound are fixed, the lanes below scroll: transients, sharpness, envelope, centroid,
/// bands with high ones on top, noise. The signal of the actuator and the overview are at the bottom.
class ClipView final : public juce::Component, private juce::Timer
{
public:
    explicit ClipView(Session& shared);
    ~ClipView() override;

    std::function<void(Command)> onCommand;

    void paint(juce::Graphics& g) override;
    void resized() override;
    void mouseMagnify(const juce::MouseEvent& event, float factor) override;

    /// Zooms about the playhead where that is visible, else about the middle.
    void zoomAtPlayhead(double factor);

    /// The row of a lane, or null.
    [[nodiscard]] PlotLane* rowOf(Lane lane) const;
    [[nodiscard]] PlotLane* eventRow() const;
    /// Pixels of a band: as chosen, or more where all lanes together would leave room below them.
    [[nodiscard]] int shownLaneHeight() const noexcept { return shownUnit; }
    [[nodiscard]] WaveformRow& soundRow() noexcept { return waveform; }
    [[nodiscard]] ActuatorRow& actuatorRow() noexcept { return actuator; }

private:
    class Overlay;

    /// Leaves the wheel with Shift, which moves in time, to the view.
    class LaneViewport final : public juce::Viewport
    {
        void mouseWheelMove(const juce::MouseEvent& event, const juce::MouseWheelDetails& details) override
        {
            if (event.mods.isShiftDown() || std::abs(details.deltaX) > std::abs(details.deltaY))
                juce::Component::mouseWheelMove(event, details); // NOLINT(bugprone-parent-virtual-call): to the parent
            else
                juce::Viewport::mouseWheelMove(event, details);
        }

        /// These move the playhead.
        bool keyPressed(const juce::KeyPress& key) override
        {
            const bool ends = key == juce::KeyPress::homeKey || key == juce::KeyPress::endKey;
            return !ends && juce::Viewport::keyPressed(key);
        }
    };

    bool showMarkers();
    void timerCallback() override { placePlayhead(); }
    void rebuild();
    void layOut();
    void placePlayhead();
    void marquee(PlotLane& from, const juce::MouseEvent& event, bool over);
    void mouseWheelMove(const juce::MouseEvent& event, const juce::MouseWheelDetails& details) override;
    [[nodiscard]] juce::Rectangle<int> plotArea() const;

    EditorModel& model;
    ClipSelection& clipSelection;
    ViewState& viewState;
    Transport& transport;
    TimeRuler ruler;
    ToolStrip tools;
    SelectionBar selectionBar;
    MarkerStrip markers;
    WaveformRow waveform;
    ActuatorRow actuator;
    Overview overview;
    BrightnessLine brightness;
    LaneViewport viewport;
    juce::Component rows;
    std::vector<std::unique_ptr<PlotLane>> lanes;
    std::vector<Lane> built; ///< the lanes that there are rows for
    std::unique_ptr<Overlay> overlay;
    Selection beforeMarquee;
    int shownUnit = 0;
    float heightWheel = 0.0f; ///< of the wheel since the lanes' height changed
    Subscriptions subscriptions;
};

} // namespace pacini::editor
