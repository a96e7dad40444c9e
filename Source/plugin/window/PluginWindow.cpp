// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/window/PluginWindow.h"

#include "editor/Controls.h"
#include "editor/FileQuestion.h"
#include "editor/LanguageProblem.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/clip/commands/KeyText.h"
#include "editor/clip/sheets/HelpSheet.h"
#include "io/ShippedProfiles.h"
#include "plugin/window/DisplayErrors.h"

#include <pacini/foundation/Units.h>
#include <pacini/realtime/TranslatorPresets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pacini::plugin
{

namespace
{
using editor::grid;

constexpr std::size_t mostKeptSound = std::size_t(16) << 20; // bytes, of a session
constexpr int usualWidth = 1024;
constexpr int usualHeight = 648;
constexpr int framesPerSecond = 30;
constexpr int rowHeight = 3 * grid + 2;
constexpr int topCard = 28 * grid;

juce::KeyPress undoKey()
{
    return {'z', juce::ModifierKeys::commandModifier, 0};
}
juce::KeyPress redoKey()
{
    return {'z', juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier, 0};
}
juce::KeyPress helpKey()
{
    return juce::KeyPress(juce::KeyPress::F1Key);
}

juce::String nameOf(ParameterId parameter)
{
    return rowOf(parameter).name;
}

/// Beside the name of the group, under a knob.
juce::String labelOf(ParameterId parameter)
{
    switch (parameter)
    {
    case ParameterId::transposition:
        return "Transpose";
    case ParameterId::transientSensitivity:
        return "Sensitivity";
    case ParameterId::gateThreshold:
        return "Threshold";
    case ParameterId::gateRelease:
        return "Release";
    default:
        return nameOf(parameter);
    }
}

juce::String helpOf(ParameterId parameter)
{
    return rowOf(parameter).help;
}

} // namespace

juce::AudioProcessorEditor* Plugin::createEditor()
{
    editor::useLanguage({}); // a host has no settings of ours to ask
    ignoreDisplayErrors();
    return new PluginWindow(*this);
}

PluginWindow::PluginWindow(Plugin& shown)
    : AudioProcessorEditor(shown),
      processor(shown),
      tooltips(this, 600),
      languageNote(editor::languageProblem()),
      settings(shown.userFolder()),
      presets(shown, [this](std::unique_ptr<editor::Sheet> sheet) { ask(std::move(sheet)); }),
      inputMeter("Input", "Peak of the input sound", {.low = -60.0f, .high = 6.0f, .warnAbove = 0.0f}),
      outputMeter("Output", "Peak of the haptic signal; 0 dB is full drive",
                  {.low = -60.0f, .high = 0.0f, .warnAbove = -0.1f}),
      reductionMeter("Gain reduction", "Gain reduction by the limiter and the actuator's protection",
                     {.low = 0.0f, .high = 24.0f, .from = 0.0f, .warnAbove = 6.0f}),
      feltMeter("Above touch threshold", "Haptic level above the touch threshold",
                {.low = -20.0f, .high = 70.0f, .from = 0.0f, .sign = true}),
      capture(shown)
{
    using Id = ParameterId;
    look.setDark(editor::systemIsDark());
    setLookAndFeel(&look);
    setTitle("Pacini");
    setDescription("Turns sound into touch");

    adopt(presets, nullptr);
    undoButton.setTitle("Undo");
    editor::prepareButton(undoButton, "Undoes the last step", [this] { processor.undo(); });
    redoButton.setTitle("Redo");
    editor::prepareButton(redoButton, "Redoes the last undone step", [this] { processor.redo(); });
    for (editor::IconButton* button : {&undoButton, &redoButton})
    {
        button->setWantsKeyboardFocus(true);
        adopt(*button, nullptr);
    }
    for (const Side side : {Side::a, Side::b})
    {
        juce::TextButton& button = sideButtons[static_cast<std::size_t>(side)];
        button.setButtonText(side == Side::a ? "A" : "B");
        button.setTitle(side == Side::a ? "Side A" : "Side B");
        button.setClickingTogglesState(true);
        button.setRadioGroupId(1);
        button.setConnectedEdges(side == Side::a ? juce::Button::ConnectedOnRight : juce::Button::ConnectedOnLeft);
        editor::prepareButton(button, "Two sides to compare: each has its own settings and actuators",
                              [this, side] { processor.chooseSide(side); });
        adopt(button, nullptr);
    }
    actuator = choice(Id::profile);
    loadButton.setButtonText(juce::String::fromUTF8("Load…"));
    loadButton.setTitle("Load an actuator");
    editor::prepareButton(loadButton, "Loads an actuator from a profile file", [this] { chooseActuator(0); });
    adopt(loadButton, nullptr);
    bypassToggle = toggle(Id::bypass, "Bypass");
    actuatorsButton.setButtonText("Actuators");
    actuatorsButton.setClickingTogglesState(true);
    editor::prepareButton(actuatorsButton,
                          "Settings for several actuators: one per haptic channel, and panning across them",
                          [this] { show(actuatorsButton.getToggleState() ? Page::actuators : Page::live); });
    adopt(actuatorsButton, nullptr);
    clipsButton.setButtonText("Clips");
    clipsButton.setTitle("Clip editor");
    clipsButton.setClickingTogglesState(true);
    editor::prepareButton(clipsButton, "View, edit and export captured and opened clips; saved with the session",
                          [this] { show(clipsButton.getToggleState() ? Page::clips : Page::live); });
    adopt(clipsButton, nullptr);
    menuButton.setTitle("Menu");
    menuButton.setWantsKeyboardFocus(true);
    editor::prepareButton(menuButton, "Undo, sides, controller, scale of the window, theme, help",
                          [this] { menu().showMenuAsync(juce::PopupMenu::Options().withTargetComponent(menuButton)); });
    adopt(menuButton, nullptr);

    sourceChoice = choice(Id::source);
    sourceMix = slider(Id::sourceMix, Shape::bar);
    inputGain = slider(Id::inputGain, Shape::bar);
    editor::addAll(*this, {&inputMeter, &lamp, &bands, &outputMeter, &reductionMeter, &feltMeter});
    outputMode = choice(Id::outputMode);
    outputChannel = slider(Id::outputChannel, Shape::bar);

    roleLevels = {slider(Id::rumbleLevel, Shape::bar), nullptr, nullptr};
    roleMutes = {toggle(Id::rumbleMute, "Mute"), nullptr, nullptr};
    roleLevels[1] = slider(Id::textureLevel, Shape::bar);
    roleMutes[1] = toggle(Id::textureMute, "Mute");
    roleLevels[2] = slider(Id::transientLevel, Shape::bar);
    roleMutes[2] = toggle(Id::transientMute, "Mute");
    intensity = slider(Id::intensity, Shape::knob);
    strength = slider(Id::strength, Shape::knob);
    brightness = slider(Id::brightness, Shape::knob);
    audible = slider(Id::audible, Shape::knob);
    speech = slider(Id::speech, Shape::knob);
    transposition = slider(Id::transposition, Shape::knob);
    direct = slider(Id::direct, Shape::knob);
    attack = slider(Id::attack, Shape::knob);
    release = slider(Id::release, Shape::knob);
    sensitivity = slider(Id::transientSensitivity, Shape::knob);
    sharpness = slider(Id::transientSharpness, Shape::knob);
    gateThreshold = slider(Id::gateThreshold, Shape::knob);
    gateRelease = slider(Id::gateRelease, Shape::knob);

    capture.onEdit = [this](const editor::CapturedClip& captured)
    {
        editCaptured(captured);
    };
    adopt(capture, nullptr);
    status.setFont(editor::smallFont());
    status.setJustificationType(juce::Justification::centredRight);
    status.setTitle("Status");
    addAndMakeVisible(status);
    editor::translateTexts(*this);

    setDark(look.isDark());
    const auto wanted = processor.windowSize(); // before the limits set a size
    setResizable(true, true);
    setResizeLimits(leastWidth, leastHeight, 2400, 1600);
    setSize(wanted.x > 0 ? wanted.x : usualWidth, wanted.y > 0 ? wanted.y : usualHeight);
    scale = settings.scale();
    applyScale();
    refresh();
    startTimerHz(framesPerSecond);
}

PluginWindow::~PluginWindow()
{
    stopTimer();
    question.show(nullptr);
    clipView.reset();
    setLookAndFeel(nullptr);
}

void PluginWindow::adopt(juce::Component& component, editor::Refreshed* wanted)
{
    component.setExplicitFocusOrder(++focusOrder);
    addAndMakeVisible(component);
    if (wanted)
        refreshed.push_back(wanted);
}

std::unique_ptr<editor::ParameterSlider> PluginWindow::slider(ParameterId parameter, Shape shape)
{
    auto made = std::make_unique<editor::ParameterSlider>(processor.parameter(parameter), shape, labelOf(parameter),
                                                          nameOf(parameter), helpOf(parameter));
    adopt(*made, made.get());
    return made;
}

std::unique_ptr<editor::ParameterToggle> PluginWindow::toggle(ParameterId parameter, const juce::String& text)
{
    auto made = std::make_unique<editor::ParameterToggle>(processor.parameter(parameter), text, nameOf(parameter),
                                                          helpOf(parameter));
    adopt(*made, made.get());
    return made;
}

std::unique_ptr<editor::ParameterChoice> PluginWindow::choice(ParameterId parameter)
{
    auto made = std::make_unique<editor::ParameterChoice>(
        processor.parameter(parameter), offeredValues(rowOf(parameter)), nameOf(parameter), helpOf(parameter));
    adopt(*made, made.get());
    return made;
}

void PluginWindow::setDark(bool dark)
{
    look.setDark(dark);
    status.setColour(juce::Label::textColourId, look.palette().dim);
    sendLookAndFeelChange();
    if (clipView)
        clipView->setDark(dark);
    repaint();
    if (onThemeChange)
        onThemeChange();
}

void PluginWindow::show(Page wanted)
{
    if (wanted == Page::clips && !clipView)
    {
        clipView = std::make_unique<editor::EditorView>(processor.clips().session(), editor::HostServices{});
        clipView->setDark(look.isDark());
        clipView->setExplicitFocusOrder(++focusOrder);
        addChildComponent(*clipView);
    }
    if (wanted == Page::actuators && !actuatorsPage)
    {
        actuatorsPage = std::make_unique<ActuatorsPage>(processor);
        actuatorsPage->setExplicitFocusOrder(++focusOrder);
        actuatorsPage->onLoad = [this](std::size_t channel)
        {
            chooseActuator(channel);
        };
        editor::translateTexts(*actuatorsPage);
        addChildComponent(*actuatorsPage);
        actuatorsPage->sendLookAndFeelChange(); // it was made before it had this look
    }
    // What is behind must not be reached by keys.
    for (juce::Component* child : getChildren())
        if (child->getY() >= headerHeight || child == &lamp)
            child->setVisible(wanted == Page::live);
    actuatorsButton.setToggleState(wanted == Page::actuators, juce::dontSendNotification);
    clipsButton.setToggleState(wanted == Page::clips, juce::dontSendNotification);
    if (actuatorsPage)
        actuatorsPage->setVisible(wanted == Page::actuators);
    if (clipView)
        clipView->setVisible(wanted == Page::clips);
    resized();
    repaint();
}

bool PluginWindow::keyPressed(const juce::KeyPress& key)
{
    if (question.sheet() != nullptr)
        return false;
    if (clipView && clipView->isVisible())
        return clipView->sheet() == nullptr && clipView->menus().keys()->keyPressed(key, clipView.get());
    if (key == undoKey())
        processor.undo();
    else if (key == redoKey() || key == juce::KeyPress('y', juce::ModifierKeys::commandModifier, 0))
        processor.redo();
    else if (key == helpKey())
        ask(std::make_unique<editor::HelpSheet>(true));
    else
        return false;
    refresh();
    return true;
}

juce::PopupMenu PluginWindow::menu()
{
    juce::PopupMenu menu;
    menu.setLookAndFeel(&look);
    const auto add = [](juce::PopupMenu& to, const juce::String& text, bool enabled, std::function<void()> action,
                        const juce::String& key = {}, bool ticked = false)
    {
        juce::PopupMenu::Item item(text);
        item.setEnabled(enabled).setTicked(ticked).setAction(std::move(action));
        item.shortcutKeyDescription = key;
        to.addItem(std::move(item));
    };
    add(
        menu, editor::tr("Undo"), processor.canUndo(), [this] { processor.undo(); }, editor::keyText(undoKey()));
    add(
        menu, editor::tr("Redo"), processor.canRedo(), [this] { processor.redo(); }, editor::keyText(redoKey()));
    menu.addSeparator();
    const bool isA = processor.side() == Side::a;
    add(menu, editor::tr(isA ? "Copy A to B" : "Copy B to A"), true, [this] { processor.copyToOtherSide(); });
    menu.addSeparator();
    menu.addSubMenu(editor::tr("Controller"), controllerMenu());
    juce::PopupMenu sizes;
    for (const int percent : WindowSettings::scales)
        add(
            sizes, juce::String(percent) + " %", true, [this, percent] { chooseScale(percent); }, {}, percent == scale);
    menu.addSubMenu(editor::tr("Scale of the window"), sizes);
    const bool dark = look.isDark();
    add(menu, editor::tr(dark ? "Light theme" : "Dark theme"), true, [this, dark] { setDark(!dark); });
    menu.addSeparator();
    add(
        menu, editor::tr("Help"), true, [this] { ask(std::make_unique<editor::HelpSheet>(true)); },
        editor::keyText(helpKey()));
    return menu;
}

/// Those that are connected now, and the chosen one.
juce::PopupMenu PluginWindow::controllerMenu()
{
    PadOutput& pad = processor.pad();
    const PadOutput::Status chosen = pad.status();
    const auto connected = pad.connected();
    juce::PopupMenu menu;
    const auto add = [&](const juce::String& text, bool ticked, std::function<void()> action)
    {
        juce::PopupMenu::Item item(text);
        item.setTicked(ticked).setEnabled(action != nullptr);
        item.setAction(std::move(action));
        menu.addItem(std::move(item));
    };
    add(editor::tr("None"), chosen.name.empty(), [&pad] { pad.choose({}); });
    bool isThere = chosen.name.empty();
    const bool none = !connected || connected->empty();
    if (connected)
        for (const devices::Controller& each : *connected)
        {
            const std::string name = nameOf(each);
            const bool isChosen = !isThere && pad.isChosen(each);
            isThere = isThere || isChosen;
            add(editor::toText(name), isChosen, [&pad, name, path = each.path] { pad.choose(name, path); });
        }
    if (!isThere)
        add(editor::toText(chosen.name), true, [&pad, name = chosen.name] { pad.choose(name); });
    juce::StringArray told;
    if (!connected)
        told.add(editor::translateMessage(editor::toText(connected.error().text())));
    else if (none)
        told.add(editor::tr("No supported controller connected"));
    if (const auto text = controllerText(chosen); text.isNotEmpty())
        told.add(text);
    if (!told.isEmpty())
        menu.addSeparator();
    for (const juce::String& text : told)
        add(text, false, nullptr);
    return menu;
}

juce::String PluginWindow::controllerText(const PadOutput::Status& of)
{
    const juce::String name = editor::toText(of.name);
    if (of.name.empty())
        return {};
    if (!of.trouble.empty())
        return name + " " + editor::translateMessage(editor::toText(of.trouble));
    if (!of.lesser.empty())
        return editor::tr("{0} plays by rumble: it {1}", {name, editor::translateMessage(editor::toText(of.lesser))});
    return of.plays ? editor::tr("{0} plays", {name}) : juce::String();
}

void PluginWindow::ask(std::unique_ptr<editor::Sheet> sheet)
{
    question.show(std::move(sheet));
}

void PluginWindow::chooseScale(int percent)
{
    settings.setScale(percent);
    scale = settings.scale();
    applyScale();
}

void PluginWindow::setScaleFactor(float byHost)
{
    hostScale = byHost;
    applyScale();
}

void PluginWindow::applyScale()
{
    AudioProcessorEditor::setScaleFactor(hostScale * 0.01f * static_cast<float>(scale));
    if (onScaleChange)
        onScaleChange();
}

void PluginWindow::editCaptured(const editor::CapturedClip& captured)
{
    show(Page::clips);
    editor::Imported imported;
    imported.clip = captured.clip;
    imported.encoder = captured.encoder;
    editor::Session& session = processor.clips().session();
    if (session.model.isEmpty())
    {
        session.actuators.setProfile(std::string(profileNameOf(processor.values().index(ParameterId::profile))));
        session.actuators.setStrength(processor.values()[ParameterId::strength]);
    }
    std::size_t kept = 0;
    for (const AudioReference& sound : session.model.document().project().sources)
        kept += sound.embedded ? sound.embedded->size() : 0;
    if (captured.sound && *captured.sound)
    {
        const DescribedAudio& sound = **captured.sound;
        if (kept + sound.reference.embedded->size() <= mostKeptSound)
        {
            imported.reference = sound.reference;
            imported.sound = std::make_shared<const editor::Sound>(StoredAudio(sound.audio));
        }
        else
            session.model.onError("Sound not kept",
                                  editor::tr("The clips of this session already have {0} MB of sound. The new clip is "
                                             "kept without its sound and cannot be analysed again.",
                                             {juce::String(kept >> 20)}));
    }
    session.sounds.add(std::move(imported));
}

void PluginWindow::refresh()
{
    for (editor::Refreshed* each : refreshed)
        each->refresh();
    presets.refresh();
    showEdits();
    if (actuatorsPage && actuatorsPage->isVisible())
        actuatorsPage->refresh();
    showMeters();
    showRouting();
    const juce::String text = statusText();
    if (text != status.getText())
    {
        status.setText(text, juce::dontSendNotification);
        status.setTooltip(text);
    }
}

void PluginWindow::showEdits()
{
    undoButton.setEnabled(processor.canUndo());
    redoButton.setEnabled(processor.canRedo());
    sideButtons[static_cast<std::size_t>(processor.side())].setToggleState(true, juce::dontSendNotification);
    if (--untilLoad < 0)
    {
        shownLoad = processor.load();
        untilLoad = framesPerSecond; // figures that change faster cannot be read
    }
}

void PluginWindow::showMeters()
{
    const auto reading = processor.readMeters();
    inputMeter.show(Decibels::fromGain(static_cast<double>(processor.takeInputPeak())).value);
    lamp.show(reading.events, reading.lastEventLevel);
    bands.add(reading);
    if (!outputMeter.isVisible())
        return; // another page reads the peaks
    // What leaves the output: in bypass, or where no output has the drive, nothing does.
    const auto peak = static_cast<double>(processor.takePeak(0));
    outputMeter.show(Decibels::fromGain(peak).value);
    reductionMeter.show(peak > 0.0 && reading.gainReduction > 0.05 ? reading.gainReduction : -1.0);
    feltMeter.show(peak > 0.0 ? reading.overThreshold : -std::numeric_limits<double>::infinity());
}

void PluginWindow::showRouting()
{
    const auto values = processor.values();
    sourceMix->setEnabled(values.index(ParameterId::source) == static_cast<std::size_t>(SourceChoice::mix));
    strength->setEnabled(processor.strengthMatters());
    brightness->setEnabled(values[ParameterId::audible] < 1.0); // what is audible leaves it nothing
    outputChannel->setEnabled(values.index(ParameterId::outputMode) ==
                              static_cast<std::size_t>(OutputMode::addToChannel));
}

juce::String PluginWindow::statusText() const
{
    const PadOutput::Status pad = processor.pad().status();
    if (!pad.trouble.empty())
        return controllerText(pad);
    juce::String note = processor.note();
    if (note.isNotEmpty())
        return editor::translateMessage(note);
    if (processor.isBypassedByHost())
        return editor::tr("Bypassed by the host");
    if (languageNote.isNotEmpty())
        return languageNote;
    if (!pad.lesser.empty())
        return controllerText(pad);
    const double milliseconds = 1000.0 * processor.latency() / processor.sampleRate();
    return editor::tr("{0}, latency {1} ms, load {2} %",
                      {editor::tr(processor.actuatorName()), editor::numberText(milliseconds, 2),
                       editor::numberText(100.0 * shownLoad, 2)});
}

void PluginWindow::chooseActuator(std::size_t channel)
{
    chooser = std::make_unique<juce::FileChooser>(editor::tr("Load an actuator"), juce::File(), "*.json");
    editor::askForFiles(*chooser, juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles,
                        [this, channel](const juce::FileChooser& chosen)
                        {
                            if (chosen.getResult() == juce::File())
                                return;
                            const auto loaded = processor.loadActuator(chosen.getResult(), channel);
                            if (!loaded)
                                juce::NativeMessageBox::showMessageBoxAsync(
                                    juce::MessageBoxIconType::WarningIcon, editor::tr("Not a profile"),
                                    chosen.getResult().getFileName() + ": " +
                                        editor::translateMessage(juce::String(loaded.error().text())),
                                    this);
                        });
}

void PluginWindow::paint(juce::Graphics& g)
{
    const auto& palette = look.palette();
    g.fillAll(palette.background);
    g.setColour(palette.text);
    g.setFont(editor::titleFont());
    g.drawText("Pacini", juce::Rectangle<int>(2 * grid, grid, 10 * grid, 4 * grid), juce::Justification::centredLeft,
               false);
    if ((clipView && clipView->isVisible()) || (actuatorsPage && actuatorsPage->isVisible()))
        return;
    for (const Card& card : cards)
        editor::drawCard(g, card.area, card.name, palette);
}

// Layout.

void PluginWindow::resized()
{
    cards.clear();
    const auto card = [this](juce::Rectangle<int> area, const juce::String& name)
    {
        cards.push_back({area, name});
        return editor::insideOfCard(area);
    };
    if (actuatorsPage)
        actuatorsPage->setBounds(getLocalBounds().withTrimmedTop(headerHeight));
    if (clipView)
        clipView->setBounds(getLocalBounds().withTrimmedTop(headerHeight));
    auto area = getLocalBounds().reduced(grid);
    placeHeader(area.removeFromTop(4 * grid).reduced(grid, 0));
    area.removeFromTop(grid);

    auto footer = area.removeFromBottom(5 * grid).reduced(grid, grid).withTrimmedBottom(-grid / 2);
    status.setBounds(footer.removeFromRight(footer.getWidth() * 2 / 5));
    capture.setBounds(footer.withTrimmedRight(2 * grid));

    auto lower = area.removeFromBottom(19 * grid);
    area.removeFromBottom(grid);

    auto left = area.removeFromLeft(31 * grid);
    area.removeFromLeft(grid);
    auto right = area.removeFromRight(31 * grid);
    area.removeFromRight(grid);
    bands.setBounds(card(area, "Bands"));
    const auto row = [](juce::Rectangle<int>& from)
    {
        const auto taken = from.removeFromTop(rowHeight);
        from.removeFromTop(grid);
        return taken;
    };

    auto sound = card(left.removeFromTop(topCard), "Sound");
    left.removeFromTop(grid);
    sourceChoice->setBounds(row(sound));
    sourceMix->setBounds(row(sound));
    inputGain->setBounds(row(sound));
    sound.removeFromTop(grid);
    inputMeter.setBounds(row(sound));
    lamp.setBounds(left.withHeight(4 * grid).withTrimmedRight(2 * grid).removeFromRight(3 * grid));
    placeKnobs(card(left, "Events"), {sensitivity.get(), sharpness.get()});

    auto touch = card(right.removeFromTop(topCard), "Touch");
    right.removeFromTop(grid);
    outputMode->setBounds(row(touch));
    outputChannel->setBounds(row(touch));
    touch.removeFromTop(grid);
    outputMeter.setBounds(row(touch));
    reductionMeter.setBounds(row(touch));
    feltMeter.setBounds(row(touch));
    placeKnobs(card(right, "Gate"), {gateThreshold.get(), gateRelease.get(), speech.get()});

    auto roles = card(lower.removeFromLeft(lower.getWidth() * 2 / 5), "Layers");
    lower.removeFromLeft(grid);
    for (std::size_t i = 0; i < roleLevels.size(); ++i)
    {
        auto line = roles.removeFromTop(roles.getHeight() / static_cast<int>(roleLevels.size() - i))
                        .withSizeKeepingCentre(roles.getWidth(), rowHeight);
        roleMutes[i]->setBounds(line.removeFromRight(7 * grid));
        line.removeFromRight(grid);
        roleLevels[i]->setBounds(line);
    }
    placeKnobs(card(lower, "Character"), {intensity.get(), strength.get(), brightness.get(), audible.get(),
                                          transposition.get(), direct.get(), attack.get(), release.get()});

    processor.setWindowSize(getWidth(), getHeight());
}

void PluginWindow::placeHeader(juce::Rectangle<int> area)
{
    area = area.withSizeKeepingCentre(area.getWidth(), rowHeight);
    area.removeFromLeft(9 * grid);
    const auto atRight = [&area](juce::Component& component, int width)
    {
        component.setBounds(area.removeFromRight(width));
        area.removeFromRight(grid);
    };
    atRight(menuButton, 4 * grid);
    atRight(*bypassToggle, 9 * grid);
    atRight(clipsButton, editor::buttonWidth(clipsButton, 8 * grid));
    atRight(actuatorsButton, editor::buttonWidth(actuatorsButton, 11 * grid));
    area.removeFromRight(grid);
    constexpr int edits = 4 * 4 * grid + 3 * grid; // and what is around them
    const int load = editor::buttonWidth(loadButton, 8 * grid);
    const int box = std::min(editor::space::widestBox, (area.getWidth() - edits - load - 2 * grid) / 2);
    presets.setBounds(area.removeFromLeft(box));
    area.removeFromLeft(grid);
    undoButton.setBounds(area.removeFromLeft(4 * grid));
    redoButton.setBounds(area.removeFromLeft(4 * grid));
    area.removeFromLeft(grid);
    for (juce::TextButton& button : sideButtons)
        button.setBounds(area.removeFromLeft(4 * grid));
    area.removeFromLeft(grid);
    actuator->setBounds(area.removeFromLeft(box));
    area.removeFromLeft(grid);
    loadButton.setBounds(area.removeFromLeft(load));
}

/// Beside each other, as wide as each other where all names fit; those with long names take what they need from the
/// rest, so that all are of one size of type.
void PluginWindow::placeKnobs(juce::Rectangle<int> area, std::initializer_list<editor::ParameterSlider*> knobs)
{
    constexpr int shared = -1; // an equal share of the rest
    std::vector<int> widths(knobs.size(), shared);
    int rest = std::max(area.getWidth(), 0), sharing = static_cast<int>(knobs.size());
    for (bool changed = true; changed;)
    {
        changed = false;
        for (std::size_t i = 0; i < knobs.size() && sharing > 1; ++i)
            if (const int needed = knobs.begin()[i]->nameWidth(); widths[i] == shared && needed > rest / sharing)
            {
                widths[i] = std::min(needed, rest);
                rest -= widths[i];
                --sharing;
                changed = true;
            }
    }
    for (std::size_t i = 0; i < knobs.size(); ++i)
    {
        const bool shares = widths[i] == shared;
        const int width = shares ? rest / sharing : widths[i];
        if (shares)
        {
            rest -= width;
            --sharing;
        }
        knobs.begin()[i]->setBounds(area.removeFromLeft(width));
    }
}

} // namespace pacini::plugin
