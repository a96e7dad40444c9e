// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/RoutingBar.h"

#include "editor/Controls.h"
#include "editor/FileQuestion.h"
#include "editor/Translation.h"
#include "io/AudioExtensions.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

namespace pacini::app
{

namespace
{
using editor::grid;
using editor::tr;

constexpr int none = 1; // menus know no item 0
constexpr int testItem = 1000;
constexpr int fileItem = 1001;
constexpr int rowItems = 10000;       // so many channels side by side: rowItems * channels + the first output
constexpr int channelItems = 1000000; // an output for one of the channels: + rowItems * channel + output + 1
constexpr int mostInRow = static_cast<int>(plugin::maxHapticChannels);

juce::String channelText(const juce::StringArray& names, int channel)
{
    return juce::String(channel + 1) + "  " + names[channel];
}
} // namespace

RoutingBar::RoutingBar(AudioDevices& wanted)
    : rig(wanted), devicesButton(juce::String::fromUTF8("Devices…")), fileButton(juce::String::fromUTF8("File…"))
{
    devicesButton.setTitle("Audio devices");
    devicesButton.onClick = [this]
    {
        if (onDevices)
            onDevices();
    };
    fileButton.setTitle("Play a sound file");
    fileButton.setTooltip("Plays a sound file in a loop");
    fileButton.onClick = [this]
    {
        chooseFile();
    };
    const auto prepare =
        [this](juce::ComboBox& box, juce::Label& label, const juce::String& name, const juce::String& help)
    {
        label.setText(name, juce::dontSendNotification);
        label.setFont(editor::smallFont());
        label.setAccessible(false);
        box.setTitle(name);
        box.setTooltip(help);
        box.onChange = [this]
        {
            readMenus();
        };
        addAndMakeVisible(label);
        addAndMakeVisible(box);
    };
    addAndMakeVisible(devicesButton);
    prepare(input, inputLabel, "Input", "Input the haptic signal is made from");
    addAndMakeVisible(fileButton);
    prepare(sidechain, sidechainLabel, "Sidechain", "Input of the sidechain");
    prepare(heard, heardLabel, "Sound output", "Output for the sound");
    prepare(haptic, hapticLabel, "Haptic output", "Output, or outputs, connected to the actuators' amplifiers");
    missing.setText("No audio device is open, so nothing is heard or felt. Click 'Devices' to choose one or to search "
                    "again.",
                    juce::dontSendNotification);
    missing.setTitle("Notice");
    missing.setFont(editor::usualFont());
    missing.setMinimumHorizontalScale(1.0f);
    addChildComponent(missing);
    rig.devices().addChangeListener(this);
    fillMenus();
}

RoutingBar::~RoutingBar()
{
    rig.devices().removeChangeListener(this);
}

void RoutingBar::paint(juce::Graphics& g)
{
    g.fillAll(editor::paletteFor(*this).card);
    g.setColour(editor::paletteFor(*this).line);
    g.fillRect(getLocalBounds().removeFromBottom(1));
}

void RoutingBar::lookAndFeelChanged()
{
    missing.setColour(juce::Label::textColourId, editor::paletteFor(*this).warning);
}

void RoutingBar::resized()
{
    auto area = getLocalBounds().reduced(2 * grid, grid);
    devicesButton.setBounds(area.removeFromLeft(editor::buttonWidth(devicesButton, 11 * grid)));
    area.removeFromLeft(2 * grid);
    missing.setBounds(area);
    const std::array<std::pair<juce::Label*, juce::ComboBox*>, 4> groups{
        {{&inputLabel, &input}, {&sidechainLabel, &sidechain}, {&heardLabel, &heard}, {&hapticLabel, &haptic}}};
    std::array<int, 4> labels{};
    const int file = editor::buttonWidth(fileButton, 8 * grid);
    int left = area.getWidth() - file - (2 + 3) * grid;
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
        labels[i] = groups[i].first->getFont().getStringWidth(groups[i].first->getText()) + grid;
        left -= labels[i];
    }
    const int box = std::min(editor::space::widestBox, left / 4);
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
        groups[i].first->setBounds(area.removeFromLeft(labels[i]));
        const bool toEnd = i + 1 == groups.size() && box < editor::space::widestBox; // what is left by the division
        groups[i].second->setBounds(toEnd ? area : area.removeFromLeft(box));
        area.removeFromLeft(grid);
        if (i == 0)
        {
            fileButton.setBounds(area.removeFromLeft(file));
            area.removeFromLeft(2 * grid);
        }
    }
}

void RoutingBar::fillMenus()
{
    const Routing now = rig.routing();
    const auto ins = rig.inputNames();
    const auto outs = rig.outputNames();
    input.clear(juce::dontSendNotification);
    input.addItem(tr("Test signal"), testItem);
    input.addItem(tr("File"), fileItem);
    for (int c = 0; c + 1 < ins.size(); c += 2)
        input.addItem(tr("Inputs {0}+{1}", {juce::String(c + 1), juce::String(c + 2)}), c + 2);
    if (ins.size() == 1)
        input.addItem(tr("Input {0}", {juce::String(1)}), 2);
    input.setSelectedId(now.input == InputChoice::test   ? testItem
                        : now.input == InputChoice::file ? fileItem
                                                         : now.mainInput + 2,
                        juce::dontSendNotification);
    if (input.getSelectedId() == 0)
        input.setTextWhenNothingSelected(tr("None"));

    sidechain.clear(juce::dontSendNotification);
    sidechain.addItem(tr("None"), none);
    for (int c = 0; c < ins.size(); ++c)
        sidechain.addItem(channelText(ins, c), c + 2);
    sidechain.setSelectedId(now.sidechainInput < ins.size() ? now.sidechainInput + 2 : none,
                            juce::dontSendNotification);

    heard.clear(juce::dontSendNotification);
    heard.addItem(tr("None"), none);
    for (int c = 0; c + 1 < outs.size(); c += 2)
        heard.addItem(tr("Outputs {0}+{1}", {juce::String(c + 1), juce::String(c + 2)}), c + 2);
    heard.setSelectedId(now.mainOutput + 1 < outs.size() ? now.mainOutput + 2 : none, juce::dontSendNotification);

    fillHapticMenu(now, outs);
    showMissing(rig.devices().getCurrentAudioDevice() == nullptr);
}

/// Menus of channels say nothing without a device.
void RoutingBar::showMissing(bool isMissing)
{
    for (juce::Component* one : std::initializer_list<juce::Component*>{
             &input, &sidechain, &heard, &haptic, &inputLabel, &sidechainLabel, &heardLabel, &hapticLabel, &fileButton})
        one->setVisible(!isMissing);
    missing.setVisible(isMissing);
    devicesButton.setTooltip(tr(isMissing ? "No audio device is open: click for help"
                                          : "Chooses the audio device, sample rate and block size"));
}

/// One actuator, several side by side, or each somewhere.
void RoutingBar::fillHapticMenu(const Routing& now, const juce::StringArray& outputs)
{
    const auto outputText = [&](int output)
    {
        return output >= 0 && output < outputs.size() ? juce::String(output + 1) : juce::String::fromUTF8("–");
    };
    haptic.clear(juce::dontSendNotification);
    auto& menu = *haptic.getRootMenu();
    menu.addItem(none, tr("None"));
    for (int c = 0; c < outputs.size(); ++c)
        menu.addItem(c + 2, channelText(outputs, c));
    menu.addSeparator();
    for (int channels = 2; channels <= std::min(mostInRow, outputs.size()); ++channels)
    {
        juce::PopupMenu firsts;
        for (int c = 0; c + channels <= outputs.size(); ++c)
            firsts.addItem(rowItems * channels + c,
                           tr("Outputs {0} to {1}", {juce::String(c + 1), juce::String(c + channels)}));
        menu.addSubMenu(tr("{0} actuators", {juce::String(channels)}), firsts);
    }
    if (now.hapticChannels > 1)
    {
        menu.addSeparator();
        for (int channel = 0; channel < now.hapticChannels; ++channel)
        {
            const int output = now.hapticOutputs[static_cast<std::size_t>(channel)];
            juce::PopupMenu places;
            const auto add = [&](int to, const juce::String& text)
            {
                places.addItem(channelItems + rowItems * channel + to + 1, text, true, to == output);
            };
            add(-1, tr("None"));
            for (int c = 0; c < outputs.size(); ++c)
                add(c, channelText(outputs, c));
            menu.addSubMenu(tr("Actuator {0}: {1}", {juce::String(channel + 1), outputText(output)}), places);
        }
    }
    const int first = now.hapticOutputs[0];
    if (now.hapticChannels == 1)
    {
        haptic.setSelectedId(first >= 0 && first < outputs.size() ? first + 2 : none, juce::dontSendNotification);
        return;
    }
    juce::StringArray texts;
    for (int channel = 0; channel < now.hapticChannels; ++channel)
        texts.add(outputText(now.hapticOutputs[static_cast<std::size_t>(channel)]));
    haptic.setSelectedId(0, juce::dontSendNotification);
    haptic.setText(texts.joinIntoString(", "), juce::dontSendNotification);
}

void RoutingBar::readHapticMenu(Routing& wanted) const
{
    const int chosen = haptic.getSelectedId();
    if (chosen == 0)
        return; // as it was
    if (chosen >= channelItems)
    {
        const int channel = (chosen - channelItems) / rowItems;
        wanted.hapticOutputs[static_cast<std::size_t>(channel)] = (chosen - channelItems) % rowItems - 1;
        return;
    }
    wanted.hapticChannels = chosen >= rowItems ? chosen / rowItems : 1;
    wanted.hapticOutputs.fill(-1);
    if (chosen >= rowItems)
        for (int c = 0; c < wanted.hapticChannels; ++c)
            wanted.hapticOutputs[static_cast<std::size_t>(c)] = chosen % rowItems + c;
    else
        wanted.hapticOutputs[0] = chosen - 2;
}

void RoutingBar::readMenus()
{
    Routing wanted = rig.routing();
    const int in = input.getSelectedId();
    wanted.input = in == testItem ? InputChoice::test : in == fileItem ? InputChoice::file : InputChoice::device;
    if (wanted.input == InputChoice::device && in > 0)
        wanted.mainInput = in - 2;
    wanted.sidechainInput = sidechain.getSelectedId() - 2;
    if (heard.getSelectedId() != 0)
        wanted.mainOutput = heard.getSelectedId() - 2; // else there is no device, and the choice is kept
    readHapticMenu(wanted);
    rig.setRouting(wanted);
    fillHapticMenu(wanted, rig.outputNames());
}

void RoutingBar::chooseFile()
{
    juce::StringArray names;
    for (const std::string& extension : audioExtensions())
        names.add("*" + juce::String(extension));
    chooser = std::make_unique<juce::FileChooser>(tr("Play a sound file"), juce::File(), names.joinIntoString(";"));
    editor::askForFiles(*chooser, juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles,
                        [this](const juce::FileChooser& chosen)
                        {
                            if (chosen.getResult() == juce::File())
                                return;
                            if (const auto played = rig.play(chosen.getResult()); !played)
                                juce::NativeMessageBox::showMessageBoxAsync(
                                    juce::MessageBoxIconType::WarningIcon, tr("Not played"),
                                    chosen.getResult().getFileName() + ": " +
                                        editor::translateMessage(juce::String(played.error().text())),
                                    this);
                            fillMenus();
                        });
}

} // namespace pacini::app
