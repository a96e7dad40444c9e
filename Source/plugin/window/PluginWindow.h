// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The plugin's window.

#include "editor/BandView.h"
#include "editor/Meters.h"
#include "editor/ParameterControls.h"
#include "editor/Theme.h"
#include "editor/clip/EditorView.h"
#include "plugin/window/ActuatorsPage.h"
#include "plugin/window/CapturePanel.h"
#include "plugin/window/Plugin.h"

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
    /// The keys of the clip editor also work while the header has the focus.
    bool keyPressed(const juce::KeyPress& key) override;

    /// Looks at everything that may have changed, as the timer does.
    void refresh();
    void setDark(bool dark);
    /// What is shown below the header.
    enum class Page
    {
        live,
        actuators,
        clips
    };
    void show(Page wanted);
    [[nodiscard]] editor::EditorView* clipEditor() const noexcept { return clipView.get(); }
    std::function<void()> onThemeChange; ///< for what shares the look
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
    void showProgram();
    void showMeters();
    void showRouting();
    void placeHeader(juce::Rectangle<int> area);
    void placeKnobs(juce::Rectangle<int> area, std::initializer_list<editor::ParameterSlider*> knobs);
    [[nodiscard]] juce::String statusText() const;

    Plugin& processor;
    editor::Look look;
    juce::TooltipWindow tooltips;
    std::vector<editor::Refreshed*> refreshed;
    int focusOrder = 0;

    juce::ComboBox programChoice;
    std::unique_ptr<editor::ParameterChoice> actuator;
    juce::TextButton loadButton, themeButton, actuatorsButton, clipsButton;
    std::unique_ptr<editor::ParameterToggle> bypassToggle;

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
    std::unique_ptr<editor::ParameterSlider> intensity, strength, brightness, audible, transposition;
    std::unique_ptr<editor::ParameterSlider> direct, attack, release;
    std::unique_ptr<editor::ParameterSlider> sensitivity, sharpness, gateThreshold, gateRelease;

    CapturePanel capture;
    // Made when they are shown for the first time.
    std::unique_ptr<ActuatorsPage> actuatorsPage;
    std::unique_ptr<editor::EditorView> clipView;
    juce::Label status;
    std::unique_ptr<juce::FileChooser> chooser;

    struct Card
    {
        juce::Rectangle<int> area;
        juce::String name;
    };
    std::vector<Card> cards;

    JUCE_DECLARE_NON_COPYABLE_WITH_LEAK_DETECTOR(PluginWindow)
};

} // namespace pacini::plugin
