// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Page of the project's scene: its timeline, what a part plays with, what is left out and why, and its export.

#include "editor/Controls.h"
#include "editor/clip/scene/SceneCurveLane.h"
#include "editor/clip/scene/SceneTimeline.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/session/Session.h"
#include "editor/clip/sheets/Sheet.h"
#include "editor/clip/sheets/SheetOver.h"

#include <filesystem>
#include <memory>

namespace pacini::editor
{

/// What of a scene of that many parts is felt: left out, skipped, and what difference that makes.
[[nodiscard]] juce::String forecastText(std::size_t parts, const SceneForecast& scene);

class SceneSheet final : public Sheet, private juce::Timer
{
public:
    explicit SceneSheet(Session& shared);
    ~SceneSheet() override;

    [[nodiscard]] std::vector<Command> commands() const override { return {undo, redo, editor::save, saveAs}; }

    [[nodiscard]] SceneSelection& parts() noexcept { return selection; }
    [[nodiscard]] SceneTimeline& timeline() noexcept { return line; }
    /// A scene file in place of the scene; what is wrong with it is said on the page.
    void read(const std::filesystem::path& file);
    /// The scene as a file, after a question where one stands there.
    void write(const std::filesystem::path& file);
    [[nodiscard]] juce::String summary() const { return note.getText(); }

private:
    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override { return &line; }
    bool keyPressed(const juce::KeyPress& key) override;
    void timerCallback() override;
    void prepareChoices();
    void prepareSliders();
    void fillClips();
    void fillParameters();
    void follow();
    void plan();
    void play();
    void begin();
    [[nodiscard]] Playback playback() const;
    void stop();
    void openScene();
    void exportScene();
    void setRepeats(int passes);

    Session& session;
    SceneSelection selection;
    SceneTimeline line;
    SceneCurveLane curve;
    MenuBox clips;
    juce::ComboBox actuators, law, parameter;
    juce::Label clipsLabel, actuatorsLabel, lawLabel, parameterLabel, valueLabel, priorityLabel, repeatsLabel, note;
    juce::TextButton playButton, removeButton, removeCurveButton, fitButton, openButton, exportButton;
    Slider value, priority, repeats;
    std::unique_ptr<juce::FileChooser> chooser;
    SheetOver question{*this};
    Gesture sliding = 0;
    bool plays = false;
    int planned = 0;       ///< counts what was planned
    double duration = 0.0; ///< s, of what was planned last
    Jobs jobs;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
