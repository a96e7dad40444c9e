// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/StudyWindow.h"

#include "editor/DeviceSettings.h"
#include "editor/FocusEntry.h"
#include "editor/Text.h"
#include "editor/Translation.h"

#include <optional>
#include <utility>

namespace pacini::app
{

/// The experimenter's window: participant, trial, playback and exposure. Keep it out of the participant's sight.
class StudyWindow::Monitor final : public juce::DocumentWindow
{
public:
    Monitor(editor::StudyPage& watched, std::function<void()> whenClosed)
        : DocumentWindow(editor::tr("Study: experimenter"), juce::Colours::black,
                         DocumentWindow::minimiseButton | DocumentWindow::closeButton),
          page(watched),
          closed(std::move(whenClosed))
    {
        setLookAndFeel(&look);
        setUsingNativeTitleBar(true);
        lines.setMultiLine(true);
        lines.setReadOnly(true);
        lines.setTitle(editor::tr("State of the session"));
        lines.setFont(editor::participantFont().withHeight(17.0f));
        lines.setLineSpacing(1.4f);
        lines.setIndents(3 * editor::grid, 2 * editor::grid);
        lines.setBorder({});
        lines.setSize(60 * editor::grid, 28 * editor::grid);
        setContentNonOwned(&lines, true);
        setResizable(true, false);
        refresh();
    }
    ~Monitor() override
    {
        clearContentComponent();
        setLookAndFeel(nullptr);
    }

    void closeButtonPressed() override { closed(); }
    /// Escape stops what plays from here, too.
    bool keyPressed(const juce::KeyPress& key) override
    {
        if (key == juce::KeyPress::escapeKey)
            page.control(editor::Control::stop);
        else if (key == juce::KeyPress::F9Key)
            closed();
        else
            return editor::enterByTab(*this, key);
        return true;
    }

    void refresh()
    {
        if (look.isDark() != page.isDark())
        {
            look.setDark(page.isDark());
            sendLookAndFeelChange();
        }
        auto* run = page.run();
        juce::StringArray text;
        if (run == nullptr)
            text.add(editor::tr("Waiting for a participant"));
        else
        {
            const auto& head = run->session().head();
            text.add(editor::tr("Participant {0}, group {1}",
                                {editor::toText(head.participant), editor::toText(head.group)}));
            text.add(editor::tr("{0} of {1} trials",
                                {juce::String(run->session().answered()), juce::String(run->session().planned())}));
            if (const auto* trial = run->trial())
            {
                text.add(editor::tr("Block: {0}", {editor::toText(run->block().name)}));
                text.add(editor::tr("Stimuli:"));
                for (const std::size_t stimulus : trial->stimuli)
                    text.add(editor::toText("  · ") + editor::toText(run->study().stimuli[stimulus].name));
                if (const auto level = run->session().level())
                    text.add(editor::tr("Level: {0}", {editor::numberText(*level, 2)}));
            }
            text.add(
                editor::tr(editor::toText("Exposure A(8): {0} of {1} m/s²"),
                           {editor::numberText(run->exposure(), 3), editor::numberText(run->study().limits.daily, 2)}));
        }
        lines.setText(text.joinIntoString("\n"), false);
        lines.applyColourToAllText(look.palette().text);
    }

private:
    editor::StudyPage& page;
    std::function<void()> closed;
    editor::Look look;
    juce::TextEditor lines;
};

StudyWindow::StudyWindow(editor::StudyPlace place, juce::AudioDeviceManager& devices,
                         std::vector<NamedProfile> profiles, std::string program, std::optional<bool> dark,
                         std::function<void()> whenClosed)
    : DocumentWindow(editor::toText(place.study.name), juce::Colours::black, DocumentWindow::allButtons),
      manager(devices),
      device(devices),
      rig(devices),
      closed(std::move(whenClosed))
{
    editor::StudyServices around;
    around.player = &device;
    around.rig = &rig;
    around.outputNames = [this]
    {
        return device.outputNames();
    };
    around.wire = [this](int sound, int touch, int actuators)
    {
        device.wire(sound, touch, actuators);
    };
    around.showDevices = [this]
    {
        showDevices();
    };
    around.showMonitor = [this]
    {
        showMonitor(monitor == nullptr);
    };
    around.close = [this]
    {
        closeButtonPressed();
    };
    around.profiles = std::move(profiles);
    around.program = std::move(program);
    around.dark = dark;
    content = std::make_unique<editor::StudyPage>(std::move(place), std::move(around));
    setUsingNativeTitleBar(true);
    setContentNonOwned(content.get(), false);
    setResizable(true, false);
    setResizeLimits(640, 520, 8000, 6000);
    centreWithSize(960, 720);
    content->onProgress = [this]
    {
        if (monitor != nullptr)
            monitor->refresh();
    };
    joysticks =
        std::make_unique<JoystickReader>("/dev/input", [this](const JoystickPress& pressed) { press(pressed); });
}

StudyWindow::~StudyWindow()
{
    joysticks.reset();
    cancelPendingUpdate();
    monitor.reset();
    clearContentComponent();
}

/// Buttons as most controllers number them: below, right, left and above. Axes: two sticks with a trigger each, and the
/// cross.
void StudyWindow::press(const JoystickPress& pressed)
{
    std::optional<editor::Control> control;
    if (pressed.button == 0)
        control = editor::Control::next;
    else if (pressed.button == 1)
        control = editor::Control::stop;
    else if (pressed.button == 2 || pressed.button == 3)
        control = editor::Control::play;
    else if (pressed.axis == 0 || pressed.axis == 6)
        control = pressed.direction < 0 ? editor::Control::left : editor::Control::right;
    else if (pressed.axis == 1 || pressed.axis == 7)
        control = pressed.direction < 0 ? editor::Control::up : editor::Control::down;
    if (!control)
        return;
    {
        const std::lock_guard lock(mutex);
        waiting.push_back(*control);
    }
    triggerAsyncUpdate();
}

void StudyWindow::handleAsyncUpdate()
{
    std::vector<editor::Control> controls;
    {
        const std::lock_guard lock(mutex);
        controls.swap(waiting);
    }
    if (!juce::Process::isForegroundProcess())
        return;
    for (const editor::Control control : controls)
        content->control(control);
}

void StudyWindow::visibilityChanged()
{
    if (!isVisible() || content == nullptr)
        return;
    // On a single screen participants would see what they must not: it comes when it is asked for.
    showMonitor(juce::Desktop::getInstance().getDisplays().displays.size() > 1);
    toFront(true);
    content->grabKeyboardFocus();
}

void StudyWindow::showMonitor(bool shown)
{
    monitor.reset();
    if (!shown)
        return;
    const auto& displays = juce::Desktop::getInstance().getDisplays();
    const auto* place = displays.getDisplayForRect(getBounds());
    for (const auto& display : displays.displays)
        if (!display.totalArea.intersects(getBounds()))
            place = &display;
    monitor = std::make_unique<Monitor>(*content,
                                        [this]
                                        {
                                            juce::MessageManager::callAsync(
                                                [safe = juce::Component::SafePointer<StudyWindow>(this)]
                                                {
                                                    if (safe != nullptr)
                                                        safe->showMonitor(false);
                                                });
                                        });
    if (place != nullptr)
        monitor->setTopLeftPosition(place->userArea.getRight() - monitor->getWidth(),
                                    place->userArea.getBottom() - monitor->getHeight());
    monitor->setVisible(true);
}

void StudyWindow::closeButtonPressed()
{
    device.stop();
    juce::MessageManager::callAsync([done = closed] { done(); });
}

bool StudyWindow::keyPressed(const juce::KeyPress& key)
{
    if (key == juce::KeyPress::F11Key)
    {
        setFullScreen(!isFullScreen());
        return true;
    }
    if (key == juce::KeyPress::F9Key)
    {
        showMonitor(monitor == nullptr);
        return true;
    }
    const auto character = key.getTextCharacter();
    if (!key.getModifiers().isCommandDown() || (character != '+' && character != '-'))
        return DocumentWindow::keyPressed(key);
    auto& desktop = juce::Desktop::getInstance();
    const float step = character == '+' ? 1.25f : 0.8f;
    desktop.setGlobalScaleFactor(juce::jlimit(0.64f, 2.0f, desktop.getGlobalScaleFactor() * step));
    return true;
}

void StudyWindow::showDevices()
{
    auto settings = std::make_unique<editor::DeviceSettings>(manager);
    editor::translateTexts(*settings);
    settings->setSize(560, 460);
    juce::DialogWindow::LaunchOptions dialog;
    dialog.content.setOwned(settings.release());
    dialog.dialogTitle = editor::tr("Audio devices");
    dialog.componentToCentreAround = this;
    dialog.useNativeTitleBar = true;
    dialog.launchAsync();
}

} // namespace pacini::app
