// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/study/StudyPage.h"

#include "editor/ActuatorItem.h"
#include "editor/LanguageProblem.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "io/ProfileFile.h"
#include "study/LatencyFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

namespace pacini::editor
{

namespace fs = std::filesystem;

namespace
{
constexpr int columnWidth = 640; // about 70 letters of what participants read
constexpr int toolHeight = 5 * grid;
constexpr int statusHeight = 6 * grid; // two lines
constexpr int leastStatus = 3 * grid;
// A window of this size shows everything as large as it is; a larger one shows it larger.
constexpr float usualWidth = 1280.0f, usualHeight = 800.0f, mostScale = 2.0f;
constexpr int margin = 3 * grid;
constexpr int cardMargin = 4 * grid;
constexpr double above = 0.42; // of the room that is left: the eye's middle is higher than half
constexpr int pollsPerSecond = 60;
constexpr double quieterStep = 3.0;   // dB
constexpr double autoPlayAfter = 0.4; // s between a choice and the next trial

/// Of all texts of a study, in the order of their codes.
juce::StringArray languagesOf(const study::Study& study)
{
    juce::StringArray codes;
    const auto add = [&](const study::Text& text)
    {
        for (const auto& [code, said] : text)
            codes.addIfNotAlreadyThere(toText(code));
    };
    add(study.welcome);
    add(study.consent);
    for (const study::Block& block : study.blocks)
    {
        add(block.question);
        for (const study::Item& item : block.items)
            add(item.question);
    }
    codes.sort(false);
    return codes;
}
} // namespace

StudyPage::StudyPage(StudyPlace wanted, StudyServices around)
    : place(std::move(wanted)),
      services(std::move(around)),
      actuator(place.study.profile),
      language(languageInUse()),
      programLanguage(language),
      kicker(participantFont().withHeight(17.0f)),
      title(participantTitleFont()),
      text(participantFont()),
      status(participantFont().withHeight(17.0f))
{
    // A name that comes with the program, or a file beside the study.
    if (!actuator.empty() && profile() == nullptr)
        if (auto read = readProfile(place.folder / actuator))
            services.profiles.push_back({actuator, std::make_shared<const Profile>(std::move(*read)), true});
    look.setDark(services.dark.value_or(systemIsDark()));
    setLookAndFeel(&look);
    setWantsKeyboardFocus(true);
    setTitle(tr("Study"));
    kicker.setDim(true);
    for (Paragraph* paragraph : {&kicker, &title, &text, &status})
        addAndMakeVisible(paragraph);
    addChildComponent(scrolled);
    scrolled.setScrollBarsShown(true, false);
    show(State::setUp);
    startTimerHz(pollsPerSecond);
}

StudyPage::~StudyPage()
{
    services.player->stop();
    scrolled.setViewedComponent(nullptr, false);
    pane.reset();
    setLookAndFeel(nullptr);
}

void StudyPage::setDark(bool dark)
{
    look.setDark(dark);
    sendLookAndFeelChange();
    repaint();
}

juce::String StudyPage::said(const study::Text& wanted) const
{
    return toText(study::inLanguage(wanted, language.toStdString()));
}

LargeButton& StudyPage::addButton(const juce::String& caption, std::function<void()> click)
{
    auto button = std::make_unique<LargeButton>(caption);
    button->onClick = std::move(click);
    addAndMakeVisible(*button);
    buttons.push_back(std::move(button));
    return *buttons.back();
}

/// A button of the experimenter's, beside those that go on.
void StudyPage::addTool(const juce::String& caption, std::function<void()> click)
{
    addButton(caption, std::move(click)).isTool = true;
}

juce::ComboBox& StudyPage::addBox(const juce::String& name, const juce::StringArray& items, int selected,
                                  std::function<void(int)> chosen)
{
    auto made = std::make_unique<juce::ComboBox>(name);
    made->addItemList(items, 1);
    made->setSelectedItemIndex(selected, juce::dontSendNotification);
    made->setTitle(name);
    auto* raw = made.get();
    made->onChange = [raw, chosen = std::move(chosen)]
    {
        chosen(raw->getSelectedItemIndex());
    };
    auto label = std::make_unique<juce::Label>(juce::String(), name);
    label->setFont(participantFont().withHeight(17.0f));
    addAndMakeVisible(*label);
    addAndMakeVisible(*made);
    names.push_back(std::move(label));
    boxes.push_back(std::move(made));
    return *boxes.back();
}

void StudyPage::show(State wanted)
{
    now = wanted;
    if (now != State::delay)
        delay.reset();
    scrolled.setViewedComponent(nullptr, false);
    scrolled.setVisible(false);
    pane.reset();
    buttons.clear();
    boxes.clear();
    names.clear();
    nextButton = playButton = nullptr;
    kicker.setText({});
    status.setText({});
    switch (now)
    {
    case State::setUp:
        buildSetUp();
        break;
    case State::delay:
        buildDelay();
        break;
    case State::welcome:
        buildText(tr("Welcome"), said(study().welcome));
        nextButton = &addButton(tr("Continue"), [this] { show(State::consent); });
        break;
    case State::consent:
        if (study().consent.empty() || !running->session().head().consent.empty())
            return show(State::comfort);
        buildConsent();
        break;
    case State::comfort:
        if (comfortNext >= study().comfort.size())
            return show(State::trial);
        buildComfort();
        break;
    case State::trial:
        if (running->trial() == nullptr)
            return show(State::goodbye);
        buildTrial();
        break;
    case State::rest:
        buildText(tr("Time for a break"), tr("Go on whenever you like."));
        nextButton = &addButton(tr("Continue"), [this] { show(State::trial); });
        break;
    case State::stopped:
        buildText(tr("Stopped"), tr("Nothing plays. Your answers so far are kept."));
        nextButton = &addButton(tr("Continue"), [this] { show(before); });
        addButton(tr("End the session"),
                  [this]
                  {
                      (void)running->session().note("stopped by the participant");
                      show(State::goodbye);
                  });
        break;
    case State::goodbye:
        buildText(tr("The end"), said(study().goodbye));
        nextButton = &addButton(tr("Close"),
                                [this]
                                {
                                    running.reset();
                                    useLanguage(programLanguage);
                                    show(State::setUp);
                                });
        break;
    }
    wasReady = false;
    showPrimary();
    resized();
    repaint();
    if (isShowing())
        grabKeyboardFocus();
    if (onProgress)
        onProgress();
}

/// One button at a time is the one to press: what is to be felt first, then what goes on.
void StudyPage::showPrimary()
{
    const bool isFelt = playButton == nullptr || (now == State::trial ? wasReady : nextButton->isEnabled());
    if (playButton != nullptr)
        makePrimary(*playButton, !isFelt && !playButton->getToggleState());
    if (nextButton != nullptr && now != State::consent) // both answers of which look alike
        makePrimary(*nextButton, isFelt);
}

void StudyPage::buildText(const juce::String& heading, const juce::String& content)
{
    title.setText(heading);
    text.setText(content);
}

void StudyPage::buildConsent()
{
    buildText(tr("Consent"), said(study().consent));
    nextButton = &addButton(
        tr("I agree"),
        [this]
        {
            if (const auto kept = running->session().note("agreed: " + said(study().consent).toStdString()); !kept)
                return status.setText(translateMessage(toText(kept.error().text())));
            show(State::comfort);
        });
    // Who does not agree leaves nothing behind, and the place is free for another.
    addButton(tr("I do not agree"),
              [this]
              {
                  const fs::path log = running->session().path();
                  running.reset();
                  std::error_code ignored;
                  fs::remove(log, ignored);
                  show(State::goodbye);
              });
}

void StudyPage::addLanguageBox()
{
    const auto codes = languagesOf(study());
    if (codes.size() > 1)
    {
        juce::StringArray shown;
        for (const auto& code : codes)
            shown.add(languageChoice(code));
        const int selected = std::max(0, codes.indexOf(language));
        language = codes[selected];
        addBox(tr("Language"), shown, selected,
               [this, codes](int index)
               {
                   language = codes[index];
                   status.setText(missingFont(language));
               });
    }
}

void StudyPage::addOutputBoxes()
{
    const auto outputs = services.outputNames();
    // Ears first; the actuator on what comes after them, or on the right channel of a device with two.
    if (soundOut >= outputs.size())
        soundOut = 0;
    if (touchOut == soundOut || touchOut >= outputs.size())
        touchOut =
            outputs.size() >= 2 + study().row.actuators ? 2 : std::max(0, outputs.size() - study().row.actuators);
    addBox(tr("Sound output"), outputs, soundOut,
           [this](int index)
           {
               soundOut = index;
               wire();
           });
    addBox(tr("Haptic output"), outputs, touchOut,
           [this](int index)
           {
               touchOut = index;
               wire();
           });
    wire();
}

/// The actuators of a row are on consecutive outputs.
void StudyPage::wire()
{
    services.wire(soundOut, touchOut, study().row.actuators);
}

/// Whether the device has an output for each actuator.
bool StudyPage::hasOutputs()
{
    const int actuators = study().row.actuators;
    if (!services.outputNames || actuators == 1 || touchOut + actuators <= services.outputNames().size())
        return true;
    status.setText(
        tr("The study needs {0} outputs in a row for touch, from the chosen one on.", {juce::String(actuators)}));
    return false;
}

void StudyPage::buildSetUp()
{
    buildText(toText(study().name),
              tr("Groups: {0}. Participants so far: {1} of {2}.",
                 {juce::String(study().groups.size()), juce::String(study::sessionLogs(place.folder).size()),
                  juce::String(study::participantsOf(study()))}));
    addLanguageBox();
    juce::StringArray actuators{tr("No actuator")};
    int chosen = 0;
    for (const NamedProfile& one : services.profiles)
    {
        actuators.add(actuatorText(*one.profile));
        if (one.name == actuator)
            chosen = actuators.size() - 1;
    }
    addBox(tr("Actuator"), actuators, chosen,
           [this](int index)
           { actuator = index > 0 ? services.profiles[static_cast<std::size_t>(index) - 1].name : std::string(); });
    addBox(tr("Colours"), {tr("Dark"), tr("Light")}, look.isDark() ? 0 : 1, [this](int index) { setDark(index == 0); });
    if (services.outputNames)
        addOutputBoxes();
    const auto measured = study::readLatencies(place.folder);
    touchLatency = 0.0;
    if (measured && !measured->empty())
    {
        const auto& newest = measured->back();
        const double known = newest.latency.delay;
        // A delay is that of its device: on another one it counts only where somebody says so.
        const bool fits =
            newest.device.empty() || services.rig == nullptr || newest.device == services.rig->ports().name;
        touchLatency = fits ? known : 0.0;
        const std::string& where = newest.device.empty() ? newest.recording : newest.device;
        addBox(tr("Delay"),
               {tr("Made up for: {0} ms, measured {1}, {2}",
                   {numberText(1000.0 * known, 2), toText(newest.time.substr(0, 10)), toText(where)}),
                tr("Not made up for")},
               fits ? 0 : 1, [this, known](int index) { touchLatency = index == 0 ? known : 0.0; });
    }
    nextButton = &addButton(tr("New participant"), [this] { begin({}); });
    for (const fs::path& log : study::sessionLogs(place.folder))
        if (const auto session = study::readSession(log); session && !session->finished)
            addButton(tr("Continue with {0}", {toText(session->head.participant)}), [this, log] { begin(log); });
    if (services.showMonitor)
        addTool(tr("Experimenter's window"), services.showMonitor);
    if (services.showDevices)
        addTool(tr("Audio devices..."), services.showDevices);
    if (services.rig != nullptr && services.outputNames)
        addTool(tr("Measure the delay..."), [this] { show(State::delay); });
    if (services.close)
        addTool(tr("Close"), services.close);
    if (services.player->sampleRate() <= 0)
        status.setText(tr("No audio device is open."));
    else if (!measured)
        status.setText(translateMessage(toText(measured.error().text())));
    else
        status.setText(programLanguage == language ? languageProblem() : missingFont(language));
}

void StudyPage::buildDelay()
{
    buildText(tr("Delay between sound and touch"),
              tr("Connect the outputs to two inputs with cables, or put a sensor on the actuator. Do not wear the "
                 "actuator meanwhile. Ten short bursts are played."));
    if (!delay)
        delay = std::make_unique<DelayMeasurement>(*services.rig, place.folder);
    const auto ports = delay->ports();
    juce::StringArray inputs;
    for (const std::string& name : ports.inputs)
        inputs.add(toText(name));
    auto& heard = addBox(tr("Sound comes back on"), inputs, 0, [](int) {});
    auto& felt = addBox(tr("Touch comes back on"), inputs, inputs.size() > 1 ? 1 : 0, [](int) {});
    nextButton = &addButton(
        tr("Measure"),
        [this, &heard, &felt]
        {
            const auto index = [](int chosen)
            {
                return static_cast<std::size_t>(std::max(chosen, 0));
            };
            if (!knowsActuator())
                return;
            std::optional<Profile> limits;
            if (const NamedProfile* known = profile())
                limits = *known->profile;
            const auto started = delay->start(index(soundOut), index(touchOut), index(heard.getSelectedItemIndex()),
                                              index(felt.getSelectedItemIndex()), limits);
            if (!started)
                return status.setText(started.error().where == "outputs" ? tr("Sound and touch are on one output.")
                                      : started.error().where == "inputs"
                                          ? tr("Sound and touch are on one input.")
                                          : translateMessage(toText(started.error().message)));
            nextButton->setEnabled(false);
        });
    addButton(tr("Back"), [this] { show(State::setUp); });
    if (!ports.problem.empty())
        status.setText(toText(ports.problem));
}

void StudyPage::pollDelay()
{
    if (!delay || !delay->isRunning())
        return;
    if (const auto latency = delay->poll())
    {
        nextButton->setEnabled(true);
        if (*latency)
        {
            const study::Latency& found = **latency;
            return status.setText(tr("The haptic output comes {0} ms after the sound: {1} bursts, SD {2} ms. The delay "
                                     "is stored, and sessions compensate for it.",
                                     {numberText(1000.0 * found.delay, 3), juce::String(found.bursts),
                                      numberText(1000.0 * found.deviation, 3)}));
        }
        const Error& error = latency->error();
        return status.setText(
            error.where == "sound" ? tr("The sound was not recorded. Check its cable and its input level.")
            : error.where == "touch"
                ? tr("The haptic signal was not recorded. Check its cable or sensor and its input level.")
            : error.where == "device" ? tr("The audio device was disconnected. Please measure again.")
                                      : translateMessage(toText(error.text())));
    }
    status.setText(tr("Measuring: {0} %", {juce::String(static_cast<int>(100.0 * delay->progress()))}));
}

const NamedProfile* StudyPage::profile() const
{
    const auto found = std::find_if(services.profiles.begin(), services.profiles.end(),
                                    [this](const NamedProfile& one) { return one.name == actuator; });
    return found == services.profiles.end() ? nullptr : &*found;
}

/// Without its profile an actuator would lose its protection, so nothing is played without it unawares.
bool StudyPage::knowsActuator()
{
    if (actuator.empty() || profile() != nullptr)
        return true;
    status.setText(tr("The actuator of the study is not known: {0}", {toText(actuator)}));
    return false;
}

void StudyPage::begin(const fs::path& log)
{
    if (!knowsActuator() || !hasOutputs())
        return;
    study::SessionStart start;
    start.language = language.toStdString();
    start.program = services.program;
    auto session =
        log.empty() ? study::Session::begin(study(), place.folder, start) : study::Session::resume(study(), log);
    if (!session)
        return status.setText(translateMessage(toText(session.error().text())));
    const bool goesOn = !log.empty();
    if (goesOn)
        language = toText((*session)->head().language);
    study::StimulusParams params;
    params.sampleRate = std::max(services.player->sampleRate(), 8000);
    if (const NamedProfile* known = profile())
        params.profile = *known->profile;
    params.folder = place.folder;
    params.touchLatency = touchLatency;
    if (touchLatency != 0.0)
        if (const auto kept =
                (*session)->note(fmt::format("the touch starts {:.3f} ms earlier", 1000.0 * touchLatency));
            !kept)
            return status.setText(translateMessage(toText(kept.error().text())));
    running = std::make_unique<study::StudyRun>(study(), std::move(*session), params, *services.player);
    comfortNext = 0;
    useLanguage(language); // of all that participants read
    show(goesOn ? State::comfort : State::welcome);
}

void StudyPage::buildComfort()
{
    buildText(tr("Is this comfortable?"), tr("Play it, and say if it should be weaker."));
    const std::size_t stimulus = study::stimulusNamed(study(), study().comfort[comfortNext]);
    // Nobody has found comfortable what was not felt.
    const auto tryOut = [this, stimulus]
    {
        const auto refusal = running->tryOut(stimulus);
        nextButton->setEnabled(nextButton->isEnabled() || refusal == study::PlayRefusal::none);
        showPrimary();
        tell(refusal);
    };
    playButton = &addButton(tr("Play"), tryOut);
    nextButton =
        &addButton(tr("Comfortable"),
                   [this]
                   {
                       (void)running->session().note("comfortable at " + fmt::format("{:g} dB", running->touchTrim()));
                       ++comfortNext;
                       show(State::comfort);
                   });
    nextButton->setEnabled(false);
    addButton(tr("Weaker"),
              [this, tryOut]
              {
                  running->lowerTouch(quieterStep);
                  tryOut();
              });
}

void StudyPage::buildTrial()
{
    const study::Block& block = running->block();
    buildText(said(block.question), {});
    if (running->trial()->training)
        kicker.setText(tr("For practice"));
    pane = makeAnswerPane(study(), block, running->trial()->stimuli.size(), language);
    pane->onChange = [this]
    {
        if (pane->answersAtOnce())
            juce::MessageManager::callAsync(
                [safe = juce::Component::SafePointer<StudyPage>(this)]
                {
                    if (safe != nullptr)
                        safe->answer();
                });
    };
    pane->onPlayPart = [this](std::size_t part)
    {
        play(part);
    };
    scrolled.setViewedComponent(pane.get(), false);
    scrolled.setVisible(true);
    const bool plays = study::hasStimuli(block);
    if (!running->isPage() && plays)
        playButton = &addButton(tr("Play (space)"), [this] { play(0); });
    if (!pane->answersAtOnce())
        nextButton = &addButton(tr("Next"), [this] { answer(); });
    if (running->isPage() && plays)
        status.setText(tr("Play and rate all of them to go on."));
    // Short trials come in quick succession, and nobody wants to ask for each.
    if (pane->answersAtOnce() || block.task == study::Task::place || block.task == study::Task::which)
        juce::Timer::callAfterDelay(
            static_cast<int>(1000.0 * autoPlayAfter),
            [safe = juce::Component::SafePointer<StudyPage>(this), trial = running->session().answered()]
            {
                if (safe != nullptr && safe->now == State::trial && safe->running->session().answered() == trial)
                    safe->play(0);
            });
}

void StudyPage::play(std::size_t part)
{
    if (now == State::trial && running && !running->poll().now)
        tell(running->play(part));
}

void StudyPage::tell(study::PlayRefusal refusal)
{
    const auto what = [&]
    {
        switch (refusal)
        {
        case study::PlayRefusal::none:
            return juce::String();
        case study::PlayRefusal::noDevice:
            return tr("No audio device is open.");
        case study::PlayRefusal::noReplayLeft:
            return tr("It cannot be played again.");
        case study::PlayRefusal::exposure:
            return tr("The daily limit of vibration is reached. Please tell the experimenter.");
        case study::PlayRefusal::soundLevel:
            return tr("The sound is louder than the study allows. Please tell the experimenter.");
        case study::PlayRefusal::failed:
            break;
        }
        return running->failure() ? translateMessage(toText(running->failure()->text())) : juce::String();
    };
    status.setText(what());
}

void StudyPage::answer()
{
    if (now != State::trial || !pane || !running->canAnswer())
        return;
    const auto given = pane->answer();
    if (!given)
        return;
    const bool feedback = running->block().feedback;
    const study::Trial* const answered = running->trial();
    juce::String right; // what the touches of a practice trial are called
    if (running->block().task == study::Task::which && running->trial()->training)
    {
        const juce::StringArray events = eventNames(study(), running->block(), language);
        juce::StringArray there;
        for (int i = 0; i < events.size(); ++i)
            if ((running->trial()->right >> i & 1) != 0)
                there.add(events[i]);
        right = there.joinIntoString(", ");
    }
    const auto kept = running->answer(*given);
    if (!kept)
    {
        // The answer stays on the screen and can be given again.
        status.setText(tr("The answer could not be kept: {0}", {translateMessage(toText(kept.error().text()))}));
        return;
    }
    const bool rest = running->trial() != nullptr && running->trial()->afterBreak;
    show(rest ? State::rest : State::trial);
    if (running->trial() == answered && now == State::trial)
        status.setText(tr("The sound or the touch had a gap, so this one comes once more."));
    else if (feedback && *kept && now == State::trial)
        status.setText(tr(**kept ? "Right" : "Wrong"));
    else if (right.isNotEmpty() && now == State::trial)
        status.setText(tr("It was: {0}", {right}));
}

/// Nobody agrees by a key that says "go on" everywhere else: an answer is clicked, or has the keyboard's focus.
bool StudyPage::isConsentFocused() const
{
    const auto* focused = getCurrentlyFocusedComponent();
    return now == State::consent &&
           std::any_of(buttons.begin(), buttons.end(), [&](const auto& button) { return button.get() == focused; });
}

void StudyPage::goOn()
{
    if (now == State::trial)
        answer();
    else if (now == State::consent)
        status.setText(tr("Please choose one of the two: click it, or go to it and press it."));
    else if (nextButton != nullptr && nextButton->isEnabled())
        nextButton->triggerClick();
}

void StudyPage::stop()
{
    services.player->stop();
    if (now == State::delay)
        return show(State::setUp); // which ends the bursts
    if (!running || now == State::stopped || now == State::goodbye || now == State::setUp)
        return;
    before = now;
    show(State::stopped);
}

bool StudyPage::keyPressed(const juce::KeyPress& key)
{
    if (key == juce::KeyPress::escapeKey)
        return stop(), true;
    if (key == juce::KeyPress::returnKey)
        return goOn(), true;
    if (key == juce::KeyPress::spaceKey && isConsentFocused())
        return dynamic_cast<juce::Button*>(getCurrentlyFocusedComponent())->triggerClick(), true;
    if (key == juce::KeyPress::spaceKey && playButton != nullptr)
        return playButton->triggerClick(), true;
    const auto character = key.getTextCharacter();
    return pane && character >= '1' && character <= '9' && pane->digit(character - '0');
}

void StudyPage::control(Control pressed)
{
    auto* focused = juce::Component::getCurrentlyFocusedComponent();
    if (focused == nullptr || !isParentOf(focused))
        focused = this;
    auto* button = dynamic_cast<juce::Button*>(focused);
    const bool back = pressed == Control::left || pressed == Control::up;
    switch (pressed)
    {
    case Control::next:
        // A choice of the pane is taken by its button, as a page's stimulus is played; so is consent.
        if ((pane && button != nullptr && pane->isParentOf(button)) || isConsentFocused())
            button->triggerClick();
        else
            goOn();
        break;
    case Control::play:
        if (playButton != nullptr)
            playButton->triggerClick();
        break;
    case Control::stop:
        stop();
        break;
    case Control::left:
    case Control::right:
        if (focused->keyPressed(juce::KeyPress(back ? juce::KeyPress::leftKey : juce::KeyPress::rightKey)))
            break;
        [[fallthrough]];
    case Control::up:
    case Control::down:
        if (focused == this && pane)
        {
            // From nowhere into the answer, at the end that was asked for.
            std::vector<juce::Component*> stops;
            for (auto* child : pane->getChildren())
                if (child->isVisible() && child->isEnabled() && child->getWantsKeyboardFocus())
                    stops.push_back(child);
            if (!stops.empty())
                (back ? stops.front() : stops.back())->grabKeyboardFocus();
        }
        else
            focused->moveKeyboardFocusToSibling(!back);
        break;
    }
}

void StudyPage::timerCallback()
{
    pollDelay();
    if (!running || (now != State::trial && now != State::comfort))
        return;
    const auto playing = running->poll();
    if (playButton != nullptr)
        playButton->setLit(playing.now);
    if (!pane)
        return;
    pane->showPlaying(playing.part);
    if (std::exchange(wasPlaying, playing.now) && !playing.now && !running->canAnswer() && !running->isPage())
        status.setText(tr("It was interrupted. Please play it again."));
    const bool ready = running->canAnswer();
    pane->setReady(ready);
    if (ready && !std::exchange(wasReady, true))
        pane->takeFocus();
    if (nextButton != nullptr)
    {
        const bool possible = ready && pane->answer().has_value();
        if (possible && !nextButton->isEnabled() && running->isPage())
            status.setText({}); // it said what was missing
        nextButton->setEnabled(possible);
    }
    showPrimary();
}

/// Puts everything into a column whose height is that of what is in it; returns that height.
int StudyPage::layOut(juce::Rectangle<int> area, int paneHeight, int below)
{
    const int top = area.getY();
    for (Paragraph* paragraph : {&kicker, &title, &text})
        paragraph->setBounds(area.removeFromTop(paragraph->heightFor(area.getWidth())));
    area.removeFromTop(2 * grid);
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
        auto row = area.removeFromTop(5 * grid);
        names[i]->setBounds(row.removeFromLeft(22 * grid));
        boxes[i]->setBounds(row); // as wide as the buttons below
        area.removeFromTop(grid);
    }
    if (!boxes.empty())
        area.removeFromTop(grid);
    if (playButton != nullptr)
    {
        playButton->setBounds(area.removeFromTop(participantRow));
        area.removeFromTop(2 * grid);
    }
    if (pane)
    {
        scrolled.setBounds(area.removeFromTop(paneHeight));
        const int wanted = pane->wantedHeight();
        pane->setSize(scrolled.getWidth() - (wanted > paneHeight ? scrolled.getScrollBarThickness() : 0), wanted);
        area.removeFromTop(2 * grid);
    }
    const auto putRows = [&](bool tools, int perRow, int height)
    {
        std::vector<juce::Component*> row;
        for (auto& button : buttons)
            if (button.get() != playButton && button->isTool == tools)
                row.push_back(button.get());
        const int width = (area.getWidth() - (perRow - 1) * 2 * grid) / perRow;
        for (std::size_t i = 0; i < row.size(); ++i)
        {
            const int column = static_cast<int>(i) % perRow;
            if (column == 0 && i > 0)
                area.removeFromTop(height + grid);
            row[i]->setBounds(area.getX() + column * (width + 2 * grid), area.getY(), width, height);
        }
        area.removeFromTop(row.empty() ? 0 : height + 2 * grid);
    };
    putRows(false, 3, participantRow);
    putRows(true, 2, toolHeight);
    status.setBounds(area.removeFromTop(std::max(below, status.heightFor(area.getWidth()))));
    return area.getY() - top;
}

void StudyPage::resized()
{
    const float scale = juce::jlimit(
        1.0f, mostScale,
        std::min(static_cast<float>(getWidth()) / usualWidth, static_cast<float>(getHeight()) / usualHeight));
    for (auto* child : getChildren())
        child->setTransform(juce::AffineTransform::scale(scale));
    auto area = (getLocalBounds().toFloat() / scale).getSmallestIntegerContainer().reduced(margin);
    area = area.withSizeKeepingCentre(std::min(columnWidth, area.getWidth()), area.getHeight());
    const int room = area.getHeight();
    const auto column = area.withHeight(1 << 20); // what does not fit is cut off below
    int paneHeight = 0;
    if (pane)
    {
        pane->setSize(area.getWidth(), pane->getHeight()); // its height depends on its width
        paneHeight = pane->wantedHeight();
    }
    int below = statusHeight;
    int height = layOut(column, paneHeight, below);
    if (height > room)
        height = layOut(column, paneHeight, below = leastStatus);
    if (pane && height > room) // the pane scrolls, and the buttons stay in sight
    {
        paneHeight = std::max(2 * participantRow, paneHeight - (height - room));
        height = layOut(column, paneHeight, below);
    }
    // What is said below comes and goes: the page stands as if nothing were.
    const int down = static_cast<int>(std::lround(above * std::max(0, room - height + below)));
    layOut(column.translated(0, std::min(down, std::max(0, room - height))), paneHeight, below);
}

void StudyPage::paint(juce::Graphics& g)
{
    const Palette& palette = look.palette();
    g.fillAll(palette.background);
    if (!running || (now != State::trial && now != State::rest))
        return;
    auto bar = getLocalBounds().removeFromTop(grid);
    g.setColour(palette.line);
    g.fillRect(bar);
    g.setColour(palette.accent);
    g.fillRect(bar.withWidth(static_cast<int>(std::lround(running->session().progress() * bar.getWidth()))));
}

} // namespace pacini::editor
