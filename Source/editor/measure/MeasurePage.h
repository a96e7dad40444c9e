// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Measure page: the measurement of an actuator over the whole window.

#include "editor/clip/NoticeBar.h"
#include "editor/clip/sheets/SheetOver.h"
#include "editor/measure/EqualizerStep.h"
#include "editor/measure/MeasurementController.h"
#include "editor/measure/ResponseStep.h"
#include "editor/measure/SaveStep.h"
#include "editor/measure/SetUpStep.h"
#include "editor/measure/StepList.h"
#include "editor/measure/SweepStep.h"
#include "editor/measure/VerifyStep.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace pacini::editor
{

/// Steps at the left, the chosen one beside them. Escape stops a sweep, or closes the page; measured data stays in the
/// controller. One page at a time for a controller.
class MeasurePage final : public Sheet, private juce::Timer
{
public:
    /// `showDevices`: empty where devices cannot be chosen.
    MeasurePage(std::shared_ptr<MeasurementController> wanted, std::function<void()> showDevices);
    ~MeasurePage() override;

    [[nodiscard]] std::vector<Command> commands() const override { return {editor::save, saveAs}; }

    [[nodiscard]] MeasureStep step() const noexcept { return stepNow; }
    /// False for a step that is locked.
    bool show(MeasureStep wanted);
    [[nodiscard]] StepPanel& panel() noexcept;

    /// A sweep and its description, after a question where files stand there.
    void saveSweep(const std::filesystem::path& sound, bool throughEqualizer);

    SetUpStep& setUpStep() noexcept { return setUp; }
    SweepStep& sweepStep() noexcept { return sweep; }
    ResponseStep& responseStep() noexcept { return response; }
    EqualizerStep& equalizerStep() noexcept { return equalizer; }
    VerifyStep& verifyStep() noexcept { return verify; }
    SaveStep& saveStep() noexcept { return saving; }

    void paint(juce::Graphics& g) override;
    void resized() override;
    bool keyPressed(const juce::KeyPress& key) override;

private:
    juce::Component* firstFocus() override { return &nextButton; }
    void timerCallback() override;
    void refresh();
    void askForFile(const juce::String& title, const juce::String& pattern, bool saving, const juce::String& name,
                    std::function<void(const juce::File&)> chosen);
    void save(const std::vector<std::filesystem::path>& files, const std::function<bool()>& write);
    void tell(const juce::String& title, const juce::String& text);

    std::shared_ptr<MeasurementController> shared;
    StepServices services;
    MeasureStep stepNow = MeasureStep::setUp;
    StepList steps;
    juce::Viewport scroll;
    SetUpStep setUp;
    SweepStep sweep;
    ResponseStep response;
    EqualizerStep equalizer;
    VerifyStep verify;
    SaveStep saving;
    juce::TextButton backButton, nextButton, closeButton;
    std::unique_ptr<juce::FileChooser> chooser;
    SheetOver over{*this};
    NoticeBar notice;
};

} // namespace pacini::editor
