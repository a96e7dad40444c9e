// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"

#include "editor/FocusEntry.h"
#include "editor/LanguageProblem.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/clip/commands/ContextMenu.h"
#include "editor/clip/scene/SceneSheet.h"

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int menuHeight = 26;
constexpr int toolbarHeight = 42;
constexpr double leastScale = 0.75;
constexpr int leastBodyWidth = 720, leastBodyHeight = 460; // points, with room for all parts

/// Sliders make their boxes, and text editors colour their text, before they have a look or when they had another.
void takeLook(juce::Component& part)
{
    part.sendLookAndFeelChange();
    const auto colour = [](auto& self, juce::Component& each) -> void
    {
        if (auto* text = dynamic_cast<juce::TextEditor*>(&each))
            text->applyColourToAllText(text->findColour(juce::TextEditor::textColourId));
        for (auto* child : each.getChildren())
            self(self, *child);
    };
    colour(colour, part);
}
constexpr int workBarWidth = 440;
constexpr int workBarHeight = 48;
} // namespace

EditorView::EditorView(Session& shared, HostServices around)
    : open(shared),
      host(std::move(around)),
      menuBar(&menuList),
      toolbar(shared.model, shared.actuators, shared.transport),
      clipPart(shared),
      side(*this),
      meters(shared.actuators, shared.outputs, shared.transport, shared.player),
      start(shared.model, shared.actuators, shared.filePreview, host.demoSounds),
      status(shared, host.outputNames),
      workBar(shared.model, shared.sounds, shared.viewState)
{
    setLookAndFeel(&look);
    tooltips.setLookAndFeel(&look);
    setOpaque(true);
    setWantsKeyboardFocus(true);
    setFocusContainerType(FocusContainerType::keyboardFocusContainer);
    addAndMakeVisible(body);
    for (juce::Component* child : std::initializer_list<juce::Component*>{&menuBar, &toolbar, &clipPart, &side, &meters,
                                                                          &start, &status, &divider})
        body.addAndMakeVisible(child);
    body.addChildComponent(workBar);
    body.addChildComponent(notice);
    addKeyListener(menuList.keys());
    body.addMouseListener(this, true);
    connectParts();
    translateTexts(body);
    if (const auto problem = languageProblem(); problem.isNotEmpty())
    {
        notice.showAdvice(problem);
        speak(problem);
    }
    connectSession();
    juce::Desktop::getInstance().addFocusChangeListener(this);
    arrange();
}

void EditorView::connectParts()
{
    toolbar.onCommand = clipPart.onCommand = [this](Command command)
    {
        doCommand(command);
    };
    divider.widthNow = [this]
    {
        return side.getWidth();
    };
    divider.onWidth = [this](int wanted)
    {
        setSideWidth(wanted < 1 ? usualSideWidth : wanted);
    };
    start.onOpen = [this]
    {
        fileQuestions.askWhatToOpen();
    };
    start.onOutputs = [this]
    {
        doCommand(hapticOutputs);
    };
    start.foundDevices = host.foundDevices;
    start.onFile = [this](const std::filesystem::path& file)
    {
        fileQuestions.open({file});
    };
    if (host.reconnect)
        status.onReconnect = [this]
        {
            reconnect();
        };
    over.onClosed = [this]
    {
        takeFocus();
    };
    speaker.onMissing = [this]
    {
        notice.show(tr("Nothing is spoken: spd-say is missing. Install the package speech-dispatcher."));
    };
}

void EditorView::connectSession()
{
    open.model.onError = [this](const juce::String& title, const juce::String& text)
    {
        showMessage(std::make_unique<MessageSheet>(title, text, std::vector<Sheet::Answer>{{"Close", {}}}));
    };
    open.model.onNotice = [this](const juce::String& text)
    {
        notice.show(text);
        speak(text);
    };
    open.model.onWritten = [this](const std::vector<std::filesystem::path>& files)
    {
        notice.showWritten(files);
        speak(notice.text());
    };
    open.sounds.onSoundsMissing = [this](const std::vector<AudioReference>& missing)
    {
        fileQuestions.tellMissing(missing);
    };
    open.outputs.playsElsewhere = host.playsElsewhere;
    open.outputs.onNowhere = [this]
    {
        tellNowhere();
    };
    subscriptions.on({&open.model.contentChanged, &open.model.projectChanged, &open.sounds.workChanged},
                     [this] { arrange(); });
    subscriptions.on({&open.outputs.changed}, [this] { resized(); });
    subscriptions.on({&open.model.sceneOpened}, [this] { showOpenedScene(); });
    subscriptions.on({&open.model.projectChanged, &open.model.versionChanged, &open.clipSelection.changed,
                      &open.clipSelection.rangeChanged, &open.transport.changed, &open.transport.loopChanged,
                      &open.sounds.workChanged},
                     [this]
                     {
                         menuList.refresh();
                         if (onTitleChanged)
                             onTitleChanged();
                     });
    subscriptions.on({&open.model.contentChanged, &open.model.projectChanged, &open.transport.changed,
                      &open.actuators.changed, &open.outputs.changed, &open.viewState.lookChanged},
                     [this] { speakStatus(); });
}

/// Where the user wants that.
void EditorView::speak(const juce::String& text)
{
    if (open.viewState.viewOptions().spoken)
        speaker.say(text);
}

/// What has changed of the status: whether something plays, and where.
void EditorView::speakStatus()
{
    if (!open.viewState.viewOptions().spoken)
    {
        spokenPlace = {};
        spokenPlaying.reset();
        return;
    }
    const bool playing = open.transport.isPlaying();
    const auto place = status.playsOn();
    juce::StringArray words;
    if (spokenPlaying && playing != *spokenPlaying)
        words.add(tr(playing ? "Playing" : "Stopped"));
    if (place != spokenPlace)
        words.add(place);
    spokenPlaying = playing;
    spokenPlace = place;
    if (!words.isEmpty())
        speaker.say(words.joinIntoString(". "));
}

EditorView::~EditorView()
{
    juce::Desktop::getInstance().removeFocusChangeListener(this);
    open.model.onError = nullptr;
    open.model.onNotice = nullptr;
    open.model.onWritten = nullptr;
    open.outputs.onNowhere = nullptr;
    open.outputs.playsElsewhere = nullptr;
    open.sounds.onSoundsMissing = nullptr;
    body.removeMouseListener(this);
    removeKeyListener(menuList.keys());
    menuBar.setModel(nullptr);
    sheetNow.reset();
    tooltips.setLookAndFeel(nullptr);
    setLookAndFeel(nullptr);
}

juce::String EditorView::title() const
{
    const auto& path = open.model.document().path();
    return (path.empty() ? tr("Untitled") : pathText(path.stem())) + (open.model.document().isDirty() ? " *" : "") +
           " - Pacini Editor";
}

void EditorView::setDark(bool dark)
{
    look.setDark(dark);
    takeLook(*this);
    repaint();
}

void EditorView::setScale(double wanted)
{
    scaleNow = std::clamp(wanted, leastScale, 2.0);
    resized();
}

double EditorView::shownScale() const noexcept
{
    const double fits =
        std::min(getWidth() / static_cast<double>(leastBodyWidth), getHeight() / static_cast<double>(leastBodyHeight));
    return std::clamp(fits, leastScale, scaleNow);
}

void EditorView::setSideWidth(int wanted)
{
    sideWidthNow = std::max(usualSideWidth, wanted);
    resized();
}

void EditorView::showSide(bool wanted)
{
    sideShown = wanted;
    arrange();
    resized();
}

void EditorView::arrange()
{
    const bool any = open.model.clip() != nullptr || open.model.isShowingUnanalysed();
    clipPart.setVisible(any);
    for (juce::Component* part : std::initializer_list<juce::Component*>{&side, &divider, &meters})
        part->setVisible(any && sideShown);
    start.setVisible(!any);
}

void EditorView::paint(juce::Graphics& g)
{
    g.fillAll(look.palette().background);
}

void EditorView::resized()
{
    const double shown = shownScale();
    body.setTransform(juce::AffineTransform::scale(static_cast<float>(shown)));
    body.setBounds(0, 0, static_cast<int>(std::ceil(getWidth() / shown)),
                   static_cast<int>(std::ceil(getHeight() / shown)));
    auto area = body.getLocalBounds();
    if (sheetNow)
        sheetNow->setBounds(area);
    menuBar.setBounds(area.removeFromTop(menuHeight));
    toolbar.setBounds(area.removeFromTop(toolbarHeight));
    status.setBounds(area.removeFromBottom(StatusBar::height));
    start.setBounds(area);
    auto beside = area.removeFromRight(
        sideShown ? std::clamp(sideWidthNow, usualSideWidth, std::max(usualSideWidth, area.getWidth() / 2)) : 0);
    divider.setBounds(beside.withWidth(SideDivider::width).translated(-SideDivider::width / 2, 0));
    meters.setBounds(beside.removeFromBottom(meters.wantedHeight()));
    side.setBounds(beside);
    clipPart.setBounds(area);
    notice.setBounds(area.withTrimmedBottom(grid).removeFromBottom(4 * grid));
    workBar.setBounds(area.withTrimmedBottom(7 * grid)
                          .removeFromBottom(workBarHeight)
                          .withSizeKeepingCentre(std::min(workBarWidth, area.getWidth() - 2 * grid), workBarHeight));
}

bool EditorView::keyStateChanged(bool)
{
    if (drawKey.isDown() && !juce::KeyPress::isKeyCurrentlyDown(drawKeyCode) &&
        drawKey.release(juce::Time::getMillisecondCounter()))
        open.viewState.setDrawing(!open.viewState.isDrawing());
    return false;
}

void EditorView::switchDrawing()
{
    // A key that is held repeats; its release decides.
    const bool byKey = isShowing() && juce::KeyPress::isKeyCurrentlyDown(drawKeyCode);
    if (!byKey || drawKey.press(juce::Time::getMillisecondCounter()))
        open.viewState.setDrawing(!open.viewState.isDrawing());
}

void EditorView::takeFocus()
{
    if (over.sheet() != nullptr)
        over.sheet()->takeFocus();
    else if (sheetNow)
        sheetNow->takeFocus();
    else if (isShowing())
        grabKeyboardFocus();
}

void EditorView::globalFocusChanged(juce::Component* focused)
{
    if (focused != nullptr && isParentOf(focused) &&
        !juce::ModifierKeys::getCurrentModifiersRealtime().isAnyMouseButtonDown())
        scrollIntoView(*focused);
}

void EditorView::scrollIntoView(juce::Component& focused)
{
    auto* viewport = focused.findParentComponentOfClass<juce::Viewport>();
    auto* page = viewport != nullptr ? viewport->getViewedComponent() : nullptr;
    if (page == nullptr || !page->isParentOf(&focused))
        return;
    const auto wanted = page->getLocalArea(&focused, focused.getLocalBounds()).expanded(0, grid);
    const auto seen = viewport->getViewArea();
    if (wanted.getY() < seen.getY() || wanted.getHeight() > seen.getHeight())
        viewport->setViewPosition(seen.getX(), wanted.getY());
    else if (wanted.getBottom() > seen.getBottom())
        viewport->setViewPosition(seen.getX(), wanted.getBottom() - seen.getHeight());
}

/// To what had the keyboard before the sheet.
void EditorView::returnFocus()
{
    auto* const before = focusedBefore.getComponent();
    focusedBefore = nullptr;
    takeFocus();
    if (before != nullptr && before->isShowing() && isParentOf(before))
        before->grabKeyboardFocus();
}

void EditorView::focusPart(int direction)
{
    const std::vector<juce::Component*> parts{&toolbar, &clipPart, &side, &meters, &start};
    const auto* focused = getCurrentlyFocusedComponent();
    std::size_t now = direction > 0 ? parts.size() - 1 : 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (focused != nullptr && (focused == parts[i] || parts[i]->isParentOf(focused)))
            now = i;
    for (std::size_t tried = 0; tried < parts.size(); ++tried)
    {
        now = (now + (direction > 0 ? 1 : parts.size() - 1)) % parts.size();
        if (!parts[now]->isShowing())
            continue;
        parts[now]->grabKeyboardFocus();
        const auto* got = getCurrentlyFocusedComponent();
        if (got == parts[now] || parts[now]->isParentOf(got))
            return;
    }
}

bool EditorView::showContextMenu(juce::Component* of, bool atPointer)
{
    for (auto* one = of; one != nullptr && one != this; one = one->getParentComponent())
        if (const auto* found = dynamic_cast<const ContextMenu*>(one))
        {
            auto options = juce::PopupMenu::Options().withTargetComponent(one);
            if (atPointer)
                options = options.withMousePosition();
            menuList.menuOf(found->contextCommands()).showMenuAsync(options);
            return true;
        }
    return false;
}

void EditorView::mouseDown(const juce::MouseEvent& event)
{
    if (event.mods.isPopupMenu())
        showContextMenu(event.originalComponent, true);
}

bool EditorView::keyPressed(const juce::KeyPress& key)
{
    if (key == juce::KeyPress(juce::KeyPress::F10Key, juce::ModifierKeys::shiftModifier, 0))
        return !sheetNow && showContextMenu(getCurrentlyFocusedComponent(), false);
    if (key == juce::KeyPress(juce::KeyPress::F10Key))
    {
        menuBar.showMenu(0);
        return true;
    }
    return enterByTab(*this, key);
}

void EditorView::showSheet(std::unique_ptr<Sheet> wanted)
{
    if (!sheetNow && wanted)
        focusedBefore = getCurrentlyFocusedComponent();
    sheetNow = std::move(wanted);
    if (lastExport.written)
        status.setExported();
    if (!sheetNow && !messages.empty())
    {
        sheetNow = std::move(messages.front());
        messages.pop_front();
    }
    if (!sheetNow)
        return returnFocus();
    speak(sheetNow->getTitle() + ". " + sheetNow->getDescription());
    sheetNow->onClose = [this]
    {
        // Not from within one of its own functions.
        juce::MessageManager::callAsync(
            [self = juce::Component::SafePointer<EditorView>(this), closed = sheetNow.get()]
            {
                if (self && self->sheetNow.get() == closed)
                    self->showSheet(nullptr);
            });
    };
    sheetNow->onKey = [this](const juce::KeyPress& key)
    {
        const auto command = menuList.commandOf(key);
        const auto theirs = sheetNow->commands();
        if (!command || std::find(theirs.begin(), theirs.end(), *command) == theirs.end())
            return false;
        menuList.perform(*command);
        return true;
    };
    translateTexts(*sheetNow);
    body.addAndMakeVisible(*sheetNow);
    takeLook(*sheetNow);
    sheetNow->setBounds(body.getLocalBounds());
    sheetNow->takeFocus();
}

void EditorView::showMessage(std::unique_ptr<Sheet> wanted)
{
    if (sheetNow)
        messages.push_back(std::move(wanted));
    else
        showSheet(std::move(wanted));
}

void EditorView::tellNowhere()
{
    if (question() != nullptr && question()->getTitle() == tr("Nothing to play on"))
        return;
    std::vector<Sheet::Answer> answers;
    if (host.reconnect)
        answers.push_back({"Reconnect", [this]
                           {
                               reconnect();
                           }});
    if (host.showDevices)
        answers.push_back({toText("Audio devices…"), host.showDevices});
    answers.push_back({"Close", {}});
    ask(std::make_unique<MessageSheet>(
        "Nothing to play on",
        "No audio device is open, so there is no sound or haptic output. Connect one or switch it on; it is used at "
        "once. Game controllers and phones play without an audio device.",
        std::move(answers)));
}

void EditorView::reconnect()
{
    notice.show(host.reconnect() ? tr("The audio device is open") : tr("No audio device was found"));
}

void EditorView::ask(std::unique_ptr<Sheet> question)
{
    if (sheetNow)
    {
        speak(question->getTitle() + ". " + question->getDescription());
        over.show(std::move(question));
    }
    else
        showSheet(std::move(question));
}

/// Behind what is told of the files that were opened.
void EditorView::showOpenedScene()
{
    juce::MessageManager::callAsync(
        [self = SafePointer(this)]
        {
            if (self != nullptr && dynamic_cast<SceneSheet*>(self->sheetNow.get()) == nullptr)
                self->showMessage(std::make_unique<SceneSheet>(self->open));
        });
}

void EditorView::filesDropped(const juce::StringArray& files, int, int)
{
    start.setDropping(false);
    std::vector<std::filesystem::path> paths;
    for (const auto& file : files)
        paths.push_back(pathOf(file));
    fileQuestions.open(paths);
}

} // namespace pacini::editor
