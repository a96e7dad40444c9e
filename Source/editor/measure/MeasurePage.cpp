// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/MeasurePage.h"

#include "editor/Controls.h"
#include "editor/FileQuestion.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/sheets/OverwriteQuestion.h"

#include <algorithm>
#include <array>

namespace pacini::editor
{

namespace
{
constexpr int headHeight = 6 * grid;
constexpr int footHeight = 6 * grid;
constexpr int stepsWidth = 20 * grid; // the longest name of a step in any language

juce::String whatToDo(MeasureStep step)
{
    static const std::array<const char*, measureSteps> words{
        "Connect actuator and sensor, choose their channels and set levels",
        "Sweep the actuator and record its motion, once per wearer",
        "The response of the actuator at each frequency",
        "Make the response flat: the equaliser of the profile",
        "Measure again through the equaliser to verify it",
        "Save the result as an actuator profile"};
    return tr(words[static_cast<std::size_t>(step)]);
}
} // namespace

MeasurePage::MeasurePage(std::shared_ptr<MeasurementController> wanted, std::function<void()> showDevices)
    : Sheet("Measure an actuator", 10000, 10000),
      shared(std::move(wanted)),
      services{[this](const auto&... asked) { askForFile(asked...); },
               [this](bool throughEqualizer)
               {
                   askForFile(throughEqualizer ? "Save the equalised sweep" : "Save sweep", "*.wav", true,
                              throughEqualizer ? "sweep-equalised.wav" : "sweep.wav",
                              [this, throughEqualizer](const juce::File& file)
                              { saveSweep(pathOf(file.withFileExtension("wav")), throughEqualizer); });
               },
               [this](const auto&... asked) { save(asked...); }, std::move(showDevices)},
      setUp(*shared, services),
      sweep(*shared),
      response(*shared),
      equalizer(*shared),
      verify(*shared, services),
      saving(*shared, services),
      backButton("Back"),
      nextButton("Next"),
      closeButton("Close")
{
    setOpaque(true);
    const auto go = [this](int by)
    {
        show(static_cast<MeasureStep>(static_cast<int>(stepNow) + by));
    };
    prepareButton(backButton, "Previous step", [go] { go(-1); });
    makePrimary(nextButton);
    prepareButton(nextButton, "Next step", [go] { go(1); });
    prepareButton(closeButton, "Back to the editor; measurements are kept until you quit", [this] { close(); });
    steps.onChoose = [this](MeasureStep chosen)
    {
        show(chosen);
    };
    scroll.setScrollBarsShown(true, true);
    scroll.setWantsKeyboardFocus(false);
    addAll(*this, {&steps, &scroll, &backButton, &nextButton, &closeButton});
    addChildComponent(notice);
    over.onClosed = [this]
    {
        takeFocus();
    };
    int order = 1;
    for (juce::Component* child :
         std::initializer_list<juce::Component*>{&scroll, &nextButton, &backButton, &closeButton, &steps})
        child->setExplicitFocusOrder(order++);
    shared->onChange = [this]
    {
        refresh();
    };
    shared->setOpen(true);
    for (StepPanel* step : std::initializer_list<StepPanel*>{&setUp, &sweep, &response, &equalizer, &verify, &saving})
        translateTexts(*step); // only the one in front is inside of the page
    scroll.setViewedComponent(&panel(), false);
    refresh();
    startTimerHz(30);
}

MeasurePage::~MeasurePage()
{
    shared->onChange = nullptr;
    shared->setOpen(false);
}

StepPanel& MeasurePage::panel() noexcept
{
    switch (stepNow)
    {
    case MeasureStep::setUp:
        break;
    case MeasureStep::sweep:
        return sweep;
    case MeasureStep::response:
        return response;
    case MeasureStep::equalizer:
        return equalizer;
    case MeasureStep::verify:
        return verify;
    case MeasureStep::save:
        return saving;
    }
    return setUp;
}

bool MeasurePage::show(MeasureStep wanted)
{
    const int index = static_cast<int>(wanted);
    if (index < 0 || index >= static_cast<int>(measureSteps) ||
        shared->measurement().state(wanted) == MeasureStepState::locked)
        return false;
    shared->setTone(false);
    stepNow = wanted;
    scroll.setViewedComponent(&panel(), false);
    refresh();
    resized();
    repaint();
    return true;
}

void MeasurePage::refresh()
{
    const ActuatorMeasurement& work = shared->measurement();
    // A step can lose what it stands on.
    while (stepNow > MeasureStep::sweep && work.state(stepNow) == MeasureStepState::locked &&
           (stepNow != MeasureStep::verify || work.placements().empty()))
    {
        stepNow = static_cast<MeasureStep>(static_cast<int>(stepNow) - 1);
        scroll.setViewedComponent(&panel(), false);
        resized();
        repaint();
    }
    steps.show(stepNow, work);
    panel().refresh();
    backButton.setEnabled(stepNow != MeasureStep::setUp && !shared->isPlaying());
    const auto next = static_cast<MeasureStep>(static_cast<int>(stepNow) + 1);
    nextButton.setVisible(stepNow != MeasureStep::save);
    nextButton.setEnabled(stepNow != MeasureStep::save && work.state(next) != MeasureStepState::locked &&
                          !shared->isPlaying());
    if (auto* action = panel().action())
        makePrimary(*action, !nextButton.isEnabled());
}

void MeasurePage::timerCallback()
{
    shared->poll();
    panel().tick();
}

bool MeasurePage::keyPressed(const juce::KeyPress& key)
{
    if (key == juce::KeyPress::escapeKey && shared->isPlaying())
    {
        shared->stop();
        return true;
    }
    return Sheet::keyPressed(key);
}

void MeasurePage::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.background);
    auto head = getLocalBounds().removeFromTop(headHeight).reduced(2 * grid, 0);
    g.setColour(p.text);
    g.setFont(titleFont());
    g.drawText(getTitle(), head, juce::Justification::centredLeft, true);
    const int used = titleFont().getStringWidth(getTitle()) + 3 * grid;
    g.setColour(p.dim);
    g.setFont(usualFont());
    g.drawText(whatToDo(stepNow), head.withTrimmedLeft(used).withTrimmedRight(12 * grid),
               juce::Justification::centredLeft, true);
}

void MeasurePage::resized()
{
    auto area = getLocalBounds();
    auto head = area.removeFromTop(headHeight);
    closeButton.setBounds(head.removeFromRight(13 * grid).reduced(2 * grid, grid));
    auto foot = area.removeFromBottom(footHeight).reduced(2 * grid, grid);
    nextButton.setBounds(foot.removeFromRight(12 * grid));
    foot.removeFromRight(grid);
    backButton.setBounds(foot.removeFromRight(12 * grid));
    steps.setBounds(area.removeFromLeft(stepsWidth).withTrimmedLeft(grid));
    area.removeFromLeft(grid);
    area.removeFromRight(2 * grid);
    scroll.setBounds(area);
    StepPanel& shown = panel();
    const bool tall = shown.leastHeight() > area.getHeight();
    const bool wide = StepPanel::leastWidth > area.getWidth();
    const int bar = scroll.getScrollBarThickness();
    shown.setSize(std::max(StepPanel::leastWidth, area.getWidth() - (tall ? bar : 0)),
                  std::max(shown.leastHeight(), area.getHeight() - (wide ? bar : 0)));
    notice.setBounds(getLocalBounds().withTrimmedBottom(footHeight).removeFromBottom(4 * grid));
}

void MeasurePage::askForFile(const juce::String& title, const juce::String& pattern, bool forSaving,
                             const juce::String& name, std::function<void(const juce::File&)> chosen)
{
    const auto folder = documentsFolder();
    chooser = std::make_unique<juce::FileChooser>(tr(title), folder.getChildFile(name), pattern);
    using Browser = juce::FileBrowserComponent;
    askForFiles(*chooser,
                Browser::canSelectFiles | (forSaving ? Browser::saveMode : Browser::openMode), // who saves asks
                [chosen = std::move(chosen)](const juce::FileChooser& done)
                {
                    if (done.getResult() != juce::File())
                        chosen(done.getResult());
                });
}

void MeasurePage::save(const std::vector<std::filesystem::path>& files, const std::function<bool()>& write)
{
    writeAfterAsking(
        files, shared->neededFiles(),
        [this, files, write]
        {
            if (write())
                notice.showWritten({files.front()});
        },
        [this](std::unique_ptr<Sheet> asked) { over.show(std::move(asked)); },
        [this](const Error& error) { tell("Not saved", toText(error.text())); });
}

void MeasurePage::saveSweep(const std::filesystem::path& sound, bool throughEqualizer)
{
    save({sound, MeasurementController::describing(sound)},
         [this, sound, throughEqualizer]
         {
             const auto saved = shared->saveSweep(sound, throughEqualizer);
             if (!saved)
                 tell("Sweep not saved", toText(saved.error().text()));
             else if (!throughEqualizer)
                 tell(
                     "Sweep saved",
                     "Play it through the actuator and record the sensor, with some margin before and after. Then open "
                     "the recording here. Keep the .json file next to it; it describes the sweep.");
             return saved.ok();
         });
}

void MeasurePage::tell(const juce::String& title, const juce::String& text)
{
    over.show(std::make_unique<MessageSheet>(title, text, std::vector<Answer>{{tr("Close"), {}}}));
}

} // namespace pacini::editor
