// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/RoutingBar.h"

#include <array>
#include <utility>

namespace pacini::app
{

namespace
{
using editor::grid;

constexpr int none = 1; // menus know no item 0
constexpr int testItem = 1000;
constexpr int fileItem = 1001;
constexpr int pairItems = 500; // a pair of channels from here on

juce::String channelText(const juce::StringArray& names, int channel)
{
    return juce::String(channel + 1) + "  " + names[channel];
}
} // namespace

RoutingBar::RoutingBar(AudioDevices& wanted)
    : rig(wanted),
      devicesButton("Devices" + juce::String::fromUTF8("…")),
      fileButton("File" + juce::String::fromUTF8("…"))
{
    devicesButton.setTitle("Sound devices");
    devicesButton.setTooltip("Chooses the sound device, its rate and its block size");
    devicesButton.onClick = [this]
    {
        if (onDevices)
            onDevices();
    };
    fileButton.setTitle("Play a sound file");
    fileButton.setTooltip("Plays a sound file again and again");
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
    prepare(input, inputLabel, "Input", "The input that the haptic signal is made from");
    addAndMakeVisible(fileButton);
    prepare(sidechain, sidechainLabel, "Sidechain", "The input that the source Sidechain listens to");
    prepare(heard, heardLabel, "Sound out", "Where the sound is heard");
    prepare(haptic, hapticLabel, "Haptic out", "The output that the actuator's amplifier is connected to");
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

void RoutingBar::resized()
{
    auto area = getLocalBounds().reduced(2 * grid, grid);
    devicesButton.setBounds(area.removeFromLeft(11 * grid));
    area.removeFromLeft(2 * grid);
    const std::array<std::pair<juce::Label*, juce::ComboBox*>, 4> groups{
        {{&inputLabel, &input}, {&sidechainLabel, &sidechain}, {&heardLabel, &heard}, {&hapticLabel, &haptic}}};
    const std::array<int, 4> labels{5 * grid, 9 * grid, 9 * grid, 10 * grid};
    const int left = area.getWidth() - 9 * grid - 3 * grid - 33 * grid - 3 * grid;
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
        groups[i].first->setBounds(area.removeFromLeft(labels[i]));
        groups[i].second->setBounds(area.removeFromLeft(left / 4));
        area.removeFromLeft(grid);
        if (i == 0)
        {
            fileButton.setBounds(area.removeFromLeft(8 * grid));
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
    input.addItem("Test signal", testItem);
    input.addItem("File", fileItem);
    for (int c = 0; c + 1 < ins.size(); c += 2)
        input.addItem("Inputs " + juce::String(c + 1) + "+" + juce::String(c + 2), c + 2);
    if (ins.size() == 1)
        input.addItem("Input 1", 2);
    input.setSelectedId(now.input == InputChoice::test   ? testItem
                        : now.input == InputChoice::file ? fileItem
                                                         : now.mainInput + 2,
                        juce::dontSendNotification);
    if (input.getSelectedId() == 0)
        input.setTextWhenNothingSelected("None");

    sidechain.clear(juce::dontSendNotification);
    sidechain.addItem("None", none);
    for (int c = 0; c < ins.size(); ++c)
        sidechain.addItem(channelText(ins, c), c + 2);
    sidechain.setSelectedId(now.sidechainInput < ins.size() ? now.sidechainInput + 2 : none,
                            juce::dontSendNotification);

    heard.clear(juce::dontSendNotification);
    heard.addItem("Nowhere", none);
    for (int c = 0; c + 1 < outs.size(); c += 2)
        heard.addItem("Outputs " + juce::String(c + 1) + "+" + juce::String(c + 2), c + 2);
    heard.setSelectedId(now.mainOutput + 1 < outs.size() ? now.mainOutput + 2 : none, juce::dontSendNotification);

    haptic.clear(juce::dontSendNotification);
    haptic.addItem("Nowhere", none);
    for (int c = 0; c < outs.size(); ++c)
        haptic.addItem(channelText(outs, c), c + 2);
    for (int c = 0; c + 1 < outs.size(); c += 2)
        haptic.addItem("Both of " + juce::String(c + 1) + "+" + juce::String(c + 2), pairItems + c);
    haptic.setSelectedId(now.hapticOutput + now.hapticChannels > outs.size() || now.hapticOutput < 0 ? none
                         : now.hapticChannels == 2 ? pairItems + now.hapticOutput
                                                   : now.hapticOutput + 2,
                         juce::dontSendNotification);
}

void RoutingBar::readMenus()
{
    Routing wanted = rig.routing();
    const int in = input.getSelectedId();
    wanted.input = in == testItem ? InputChoice::test : in == fileItem ? InputChoice::file : InputChoice::device;
    if (wanted.input == InputChoice::device && in > 0)
        wanted.mainInput = in - 2;
    wanted.sidechainInput = sidechain.getSelectedId() - 2;
    wanted.mainOutput = heard.getSelectedId() - 2;
    const int out = haptic.getSelectedId();
    wanted.hapticChannels = out >= pairItems ? 2 : 1;
    wanted.hapticOutput = out >= pairItems ? out - pairItems : out - 2;
    rig.setRouting(wanted);
}

void RoutingBar::chooseFile()
{
    chooser = std::make_unique<juce::FileChooser>("Play a sound file", juce::File(),
                                                  "*.wav;*.flac;*.ogg;*.mp3;*.aif;*.aiff;*.caf");
    chooser->launchAsync(juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles,
                         [this](const juce::FileChooser& chosen)
                         {
                             if (chosen.getResult() == juce::File())
                                 return;
                             if (const auto played = rig.play(chosen.getResult()); !played)
                                 juce::NativeMessageBox::showMessageBoxAsync(
                                     juce::MessageBoxIconType::WarningIcon, "Not played",
                                     chosen.getResult().getFileName() + ": " + juce::String(played.error().text()),
                                     this);
                             fillMenus();
                         });
}

} // namespace pacini::app
