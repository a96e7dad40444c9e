// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Actuator row of the clip view: what the chosen actuator really plays of the clip.

#include "document/ActuatorTrace.h"
#include "editor/clip/commands/ContextMenu.h"
#include "editor/clip/session/Actuators.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/session/ViewState.h"

#include <pacini/actuator/Strength.h>

#include <juce_gui_basics/juce_gui_basics.h>

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

namespace pacini::editor
{

/// Two plots: the drive with the reduction by the protection, and below it one line for each band, shaded where
/// playback differs from the clip. Rendered in the background after a pause in editing. Ignores mute and solo of
/// bands.
class ActuatorRow final : public juce::Component,
                          public juce::SettableTooltipClient,
                          public ContextMenu,
                          private juce::Timer
{
public:
    ActuatorRow(const EditorModel& project, const Actuators& profiles, const ViewState& sight);
    ~ActuatorRow() override;

    /// Low without an actuator.
    [[nodiscard]] int wantedHeight() const;

    /// What is shown; null: nothing yet, or no actuator.
    [[nodiscard]] std::shared_ptr<const ActuatorTrace> trace() const noexcept { return shown; }
    void show(std::shared_ptr<const ActuatorTrace> wanted);

    /// What the plots say at a place: time, band, level and loss.
    [[nodiscard]] juce::String textAt(juce::Point<float> place) const;

    void paint(juce::Graphics& g) override;
    [[nodiscard]] std::vector<Command> contextCommands() const override;
    void mouseMove(const juce::MouseEvent& event) override;

private:
    static constexpr int driveHeight = 60; // pixels

    void timerCallback() override;
    void update();
    [[nodiscard]] juce::Rectangle<int> drivePlot() const;
    [[nodiscard]] juce::Rectangle<int> lossPlot() const;
    [[nodiscard]] std::size_t sourceAt(double y) const; ///< y from the top of the losses
    void paintHead(juce::Graphics& g);
    void paintDrive(juce::Graphics& g, juce::Rectangle<int> plot);
    void paintLosses(juce::Graphics& g, juce::Rectangle<int> plot);
    void drawLosses(const Clip& clip, juce::Rectangle<int> plot, const TimeAxis& axis, bool dark);

    const EditorModel& model;
    const Actuators& actuators;
    const ViewState& viewState;
    std::shared_ptr<const Clip> askedClip; ///< what is rendered or has been
    std::optional<Profile> askedProfile;
    double askedStrength = standardStrength;
    std::shared_ptr<std::atomic<bool>> cancelled;
    std::shared_ptr<const ActuatorTrace> shown;
    juce::String summary, failure;
    bool waiting = false; ///< the clip has changed since
    juce::Image losses;
    TimeAxis lossAxis;
    bool lossDark = true, lossStale = true;
    Jobs jobs; ///< ends before the rest
    Subscriptions subscriptions;
};

} // namespace pacini::editor
