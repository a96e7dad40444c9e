// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The plugin's window.

#include "editor/BandView.h"
#include "editor/Icons.h"
#include "editor/Meters.h"
#include "editor/ParameterControls.h"
#include "editor/Theme.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/sheets/SheetOver.h"
#include "plugin/window/ActuatorsPage.h"
#include "plugin/window/CapturePanel.h"
#include "plugin/window/Plugin.h"
#include "plugin/window/PresetBox.h"
#include "plugin/window/WindowSettings.h"

#include <juce_audio_processors/juce_audio_processors.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace pacini::plugin
{

class PluginWindow final : public juce::AudioProcessorEditor, private juce::Timer
{
public:
    explicit PluginWindow(Plugin& shown);
    ~PluginWindow() override;

    void paint(juce::Graphics& g) override;
    void resized() override;
    /// Undo and redo. The keys of the clip editor also work while the header has the focus.
    bool keyPressed(const juce::KeyPress& key) override;

    /// Looks at everything that may have changed, as the timer does.
    void refresh();
    void setDark(bool dark);
    /// Scales all of the window, for this one and those to come; one of WindowSettings::scales, %.
    void chooseScale(int percent);
    /// The scale of host and user together; 1 is 100 %.
    [[nodiscard]] float scaleFactor() const noexcept { return getTransform().mat00; }
    /// Sets the scale of the host, which multiplies that of the user.
    void setScaleFactor(float byHost) override;
    /// The menu of the button at the right end of the header.
    [[nodiscard]] juce::PopupMenu menu();
    /// The question that is shown; null: none.
    [[nodiscard]] editor::Sheet* sheet() const noexcept { return question.sheet(); }
    static constexpr int leastWidth = 936, leastHeight = 608; ///< before it is scaled
    /// The content below the header.
    enum class Page
    {
        live,
        actuators,
        clips
    };
    void show(Page wanted);
    [[nodiscard]] editor::EditorView* clipEditor() const noexcept { return clipView.get(); }
    std::function<void()> onThemeChange; ///< for components with the same look
    std::function<void()> onScaleChange; ///< for components with the same scale
    /// Puts a captured clip into the session's project, with its sound where it has been kept, and shows it.
    void editCaptured(const editor::CapturedClip& captured);

private:
    using Shape = editor::ParameterSlider::Shape;
    static constexpr int headerHeight = 6 * editor::grid;

    void timerCallback() override { refresh(); }
    std::unique_ptr<editor::ParameterSlider> slider(ParameterId parameter, Shape shape);
    std::unique_ptr<editor::ParameterToggle> toggle(ParameterId parameter, const juce::String& text);
    std::unique_ptr<editor::ParameterChoice> choice(ParameterId parameter);
    void adopt(juce::Component& component, editor::Refreshed* refreshed);
    void chooseActuator(std::size_t channel);
    void showEdits();
    void showMeters();
    void ask(std::unique_ptr<editor::Sheet> sheet);
    void applyScale();
    void showRouting();
    void placeHeader(juce::Rectangle<int> area);
    void placeKnobs(juce::Rectangle<int> area, std::initializer_list<editor::ParameterSlider*> knobs);
    [[nodiscard]] juce::PopupMenu controllerMenu();
    [[nodiscard]] static juce::String controllerText(const PadOutput::Status& of);
    [[nodiscard]] juce::String statusText() const;

    Plugin& processor;
    editor::Look look;
    juce::TooltipWindow tooltips;
    const juce::String languageNote; ///< see languageProblem(), of the time when all texts were set
    std::vector<editor::Refreshed*> refreshed;
    int focusOrder = 0;

    WindowSettings settings;
    float hostScale = 1.0f;
    int scale = 100; // %
    PresetBox presets;
    editor::IconButton undoButton{editor::Icon::undo}, redoButton{editor::Icon::redo};
    std::array<juce::TextButton, 2> sideButtons;
    std::unique_ptr<editor::ParameterChoice> actuator;
    juce::TextButton loadButton, actuatorsButton, clipsButton;
    std::unique_ptr<editor::ParameterToggle> bypassToggle;
    editor::IconButton menuButton{editor::Icon::menu};

    std::unique_ptr<editor::ParameterChoice> sourceChoice;
    std::unique_ptr<editor::ParameterSlider> sourceMix, inputGain;
    editor::LevelMeter inputMeter;
    editor::EventLamp lamp;

    editor::BandView bands;

    editor::LevelMeter outputMeter, reductionMeter, feltMeter;
    std::unique_ptr<editor::ParameterChoice> outputMode;
    std::unique_ptr<editor::ParameterSlider> outputChannel;

    std::array<std::unique_ptr<editor::ParameterSlider>, 3> roleLevels;
    std::array<std::unique_ptr<editor::ParameterToggle>, 3> roleMutes;
    std::unique_ptr<editor::ParameterSlider> intensity, strength, brightness, audible, speech, transposition;
    std::unique_ptr<editor::ParameterSlider> direct, attack, release;
    std::unique_ptr<editor::ParameterSlider> sensitivity, sharpness, gateThreshold, gateRelease;

    CapturePanel capture;
    // Made when they are shown for the first time.
    std::unique_ptr<ActuatorsPage> actuatorsPage;
    std::unique_ptr<editor::EditorView> clipView;
    juce::Label status;
    double shownLoad = 0.0; // see PluginProcessor::load()
    int untilLoad = 0;      // refreshes
    std::unique_ptr<juce::FileChooser> chooser;
    editor::SheetOver question{*this};

    struct Card
    {
        juce::Rectangle<int> area;
        juce::String name;
    };
    std::vector<Card> cards;

    JUCE_DECLARE_NON_COPYABLE_WITH_LEAK_DETECTOR(PluginWindow)
};

} // namespace pacini::plugin
