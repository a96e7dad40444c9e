// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/DevicePage.h"

#include "editor/Theme.h"
#include "editor/Translation.h"

namespace pacini::app
{

namespace
{
using editor::grid;

constexpr int adviceHeight = 17 * grid;

juce::String adviceFor(juce::AudioDeviceManager& manager)
{
    bool any = false;
    for (auto* type : manager.getAvailableDeviceTypes())
        any = any || !type->getDeviceNames(false).isEmpty();
    if (any)
        return editor::tr(
            "No audio device is open, so nothing is heard or felt. Choose an output below. If it cannot be opened, "
            "another program may be using it: close that program and search again.");
    juce::String text = editor::tr("No audio device was found, so nothing is heard or felt. Connect an audio "
                                   "interface or switch it on, then search again.");
#if JUCE_LINUX || JUCE_BSD
    text << editor::tr(
        " The command \"aplay -l\" lists what the system has. If it lists nothing, the driver is missing or you "
        "are not allowed to use the device (group \"audio\"). Start JACK before searching.");
#endif
    return text;
}
} // namespace

DevicePage::DevicePage(juce::AudioDeviceManager& wanted) : manager(wanted), settings(wanted)
{
    advice.setMultiLine(true);
    advice.setReadOnly(true);
    advice.setCaretVisible(false);
    advice.setTitle("No audio device");
    advice.setFont(editor::usualFont());
    advice.setIndents(grid, grid / 2);
    searchButton.setTooltip("Looks for audio devices, and opens the system's");
    searchButton.onClick = [this]
    {
        searchAgain();
    };
    addChildComponent(advice);
    addChildComponent(searchButton);
    addAndMakeVisible(settings);
    manager.addChangeListener(this);
    showState();
}

DevicePage::~DevicePage()
{
    manager.removeChangeListener(this);
}

void DevicePage::lookAndFeelChanged()
{
    const editor::Palette& p = editor::paletteFor(*this);
    advice.setColour(juce::TextEditor::backgroundColourId, p.card);
    advice.setColour(juce::TextEditor::outlineColourId, p.line);
    advice.applyColourToAllText(p.text);
}

void DevicePage::showState()
{
    const bool missing = manager.getCurrentAudioDevice() == nullptr;
    if (missing)
        advice.setText(adviceFor(manager), juce::dontSendNotification);
    advice.setVisible(missing);
    searchButton.setVisible(missing);
    lookAndFeelChanged();
    resized();
}

void DevicePage::searchAgain()
{
    for (auto* type : manager.getAvailableDeviceTypes())
        type->scanForDevices();
    (void)manager.initialiseWithDefaultDevices(256, 256);
    showState();
}

void DevicePage::resized()
{
    auto area = getLocalBounds().reduced(2 * grid, 2 * grid);
    if (advice.isVisible())
    {
        advice.setBounds(area.removeFromTop(adviceHeight));
        area.removeFromTop(grid);
        searchButton.setBounds(area.removeFromTop(4 * grid).removeFromLeft(16 * grid));
        area.removeFromTop(grid);
    }
    settings.setBounds(area);
}

} // namespace pacini::app
