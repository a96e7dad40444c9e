// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The pages that a participant goes through, and the experimenter's before them.

#include "document/measure/MeasureRig.h"
#include "editor/Theme.h"
#include "editor/study/AnswerPane.h"
#include "editor/study/DelayMeasurement.h"
#include "io/ShippedProfiles.h"
#include "study/StudyRun.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace pacini::editor
{

/// Services of the program for a study.
struct StudyServices
{
    study::TrialPlayer* player = nullptr;
    MeasureRig* rig = nullptr;                           ///< of the same device; null: delays are not measured
    std::function<juce::StringArray()> outputNames = {}; ///< of the device
    /// First of two channels for the ears; the first actuator's; number of actuators, on consecutive channels.
    std::function<void(int sound, int touch, int actuators)> wire = {};
    std::function<void()> showDevices = {}; ///< null: no choice of devices
    std::function<void()> showMonitor = {}; ///< the experimenter's window; null: it is seen by itself
    std::function<void()> close = {};
    std::vector<NamedProfile> profiles = {};
    std::string program = {};      ///< name and version, for the logs
    std::optional<bool> dark = {}; ///< the theme of the program; none: the system's
};

/// Input from a game controller.
enum class Control
{
    next, ///< goes on, or takes the choice that is marked
    play,
    stop,
    left,
    right,
    up,
    down
};

/// A study in its folder.
struct StudyPlace
{
    study::Study study;
    std::filesystem::path folder;
};

class StudyPage final : public juce::Component, private juce::Timer
{
public:
    StudyPage(StudyPlace wanted, StudyServices around);
    ~StudyPage() override;

    /// What is on the screen.
    enum class State
    {
        setUp,
        delay, ///< between sound and touch, is measured
        welcome,
        consent,
        comfort,
        trial,
        rest,
        stopped,
        goodbye
    };
    [[nodiscard]] State state() const noexcept { return now; }
    [[nodiscard]] study::StudyRun* run() noexcept { return running.get(); }
    std::function<void()> onProgress; ///< after each answer and each change of state

    void control(Control pressed);
    void setDark(bool dark);
    [[nodiscard]] bool isDark() const noexcept { return look.isDark(); }
    void resized() override;
    void paint(juce::Graphics& g) override;
    bool keyPressed(const juce::KeyPress& key) override;

private:
    void timerCallback() override;
    void show(State wanted);
    void buildConsent();
    void buildSetUp();
    void addLanguageBox();
    void addOutputBoxes();
    void wire();
    [[nodiscard]] bool hasOutputs();
    void buildDelay();
    [[nodiscard]] bool knowsActuator();
    void pollDelay();
    void buildText(const juce::String& title, const juce::String& text);
    void buildComfort();
    void buildTrial();
    void begin(const std::filesystem::path& log);
    void play(std::size_t part);
    [[nodiscard]] bool isConsentFocused() const;
    void goOn();
    void answer();
    void tell(study::PlayRefusal refusal);
    void stop();
    LargeButton& addButton(const juce::String& text, std::function<void()> click);
    void addTool(const juce::String& text, std::function<void()> click);
    void showPrimary();
    int layOut(juce::Rectangle<int> area, int paneHeight, int below);
    juce::ComboBox& addBox(const juce::String& name, const juce::StringArray& items, int selected,
                           std::function<void(int)> chosen);
    [[nodiscard]] const study::Study& study() const noexcept { return place.study; }
    [[nodiscard]] const NamedProfile* profile() const; ///< null: none, or one that is not known
    [[nodiscard]] juce::String said(const study::Text& text) const;

    StudyPlace place;
    StudyServices services;
    Look look;
    State now = State::setUp, before = State::trial;
    std::string actuator;                    ///< name of its profile
    double touchLatency = 0.0;               ///< s, that sessions make up for
    int soundOut = 0, touchOut = 0;          ///< outputs, as they are listed
    std::unique_ptr<DelayMeasurement> delay; ///< while that is shown
    juce::String language, programLanguage;
    std::unique_ptr<study::StudyRun> running;
    std::size_t comfortNext = 0;

    Paragraph kicker, title, text, status; ///< what kind of page it is, in dim type, stands above its title
    bool wasPlaying = false;
    bool wasReady = false; ///< the trial could be answered at the last look
    std::unique_ptr<AnswerPane> pane;
    juce::Viewport scrolled; ///< shows the pane, which may be higher than the window
    std::vector<std::unique_ptr<LargeButton>> buttons;
    std::vector<std::unique_ptr<juce::ComboBox>> boxes;
    std::vector<std::unique_ptr<juce::Label>> names; ///< of the boxes
    LargeButton* nextButton = nullptr;
    LargeButton* playButton = nullptr;
};

} // namespace pacini::editor
