// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/DeviceSettings.h"

#include "editor/Controls.h"
#include "editor/Icons.h"
#include "editor/Text.h"
#include "editor/Translation.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{

constexpr int deviceRowHeight = 4 * grid;
constexpr int deviceLabelWidth = 15 * grid;
constexpr int noDevice = 1; // menus know no item 0; devices follow
constexpr int channelRowHeight = 3 * grid;
} // namespace

ChannelList::ChannelList(const juce::String& name)
{
    setTitle(name);
    setFocusContainerType(FocusContainerType::focusContainer);
    list.setTitle(name);
    list.setRowHeight(channelRowHeight);
    list.setColour(juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    addAndMakeVisible(list);
}

ChannelList::~ChannelList()
{
    list.setModel(nullptr);
}

void ChannelList::paint(juce::Graphics& g)
{
    g.setColour(paletteFor(*this).well);
    g.fillRoundedRectangle(getLocalBounds().toFloat(), space::corner);
}

void ChannelList::paintOverChildren(juce::Graphics& g)
{
    if (!channels.isEmpty())
        return;
    g.setColour(paletteFor(*this).dim);
    g.setFont(smallFont());
    g.drawText(tr("No channels"), getLocalBounds(), juce::Justification::centred, true);
}

void ChannelList::show(const juce::StringArray& names, const juce::BigInteger& used)
{
    channels = names;
    inUse = used;
    list.updateContent();
    list.repaint();
    repaint();
}

juce::String ChannelList::getNameForRow(int row)
{
    return row >= 0 && row < channels.size() ? juce::String(row + 1) + "  " + channels[row] : juce::String();
}

void ChannelList::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected)
{
    const Palette& p = paletteFor(*this);
    auto area = juce::Rectangle<int>(width, height);
    if (selected && list.hasKeyboardFocus(true))
    {
        g.setColour(p.accent.withAlpha(0.25f));
        g.fillRoundedRectangle(area.toFloat().reduced(1.0f), space::corner);
    }
    area.reduce(grid, 0);
    const auto box = area.removeFromLeft(16).toFloat().withSizeKeepingCentre(16.0f, 16.0f);
    g.setColour(inUse[row] ? p.accent : p.control);
    g.fillRoundedRectangle(box, 3.0f);
    g.setColour(inUse[row] ? p.onAccent : p.dim);
    if (inUse[row])
        drawIcon(g, Icon::tick, box);
    else
        g.drawRoundedRectangle(box.reduced(0.5f), 3.0f, 1.0f);
    area.removeFromLeft(grid);
    g.setColour(p.text);
    g.setFont(smallFont());
    g.drawText(getNameForRow(row), area, juce::Justification::centredLeft, true);
}

void ChannelList::listBoxItemClicked(int row, const juce::MouseEvent&)
{
    turn(row);
}

bool ChannelList::keyPressed(const juce::KeyPress& key)
{
    if (key != juce::KeyPress(juce::KeyPress::spaceKey) || list.getSelectedRow() < 0)
        return false;
    turn(list.getSelectedRow());
    return true;
}

void ChannelList::turn(int row)
{
    juce::BigInteger wanted = inUse;
    wanted.setBit(row, !inUse[row]);
    if (onChange)
        onChange(wanted);
}

DeviceSettings::DeviceSettings(juce::AudioDeviceManager& wanted) : manager(wanted), testButton("Test")
{
    prepare(type, "System", "Way to the audio devices");
    prepare(output, "Output device", "Device that sound and haptic signals play on");
    prepare(input, "Input device", "Device that is recorded from");
    prepare(rate, "Sample rate", "Sample rate of the device");
    prepare(buffer, "Buffer", "Shorter buffers react sooner; too short ones crackle");
    const auto label = [this](juce::Label& one, const juce::String& text)
    {
        prepareLabel(one, text, usualFont());
        addAndMakeVisible(one);
    };
    label(outputsLabel, "Output channels");
    label(inputsLabel, "Input channels");
    label(note, {});
    note.setFont(smallFont());
    prepareButton(testButton, "Plays a tone on the outputs in use", [this] { manager.playTestSound(); });
    type.box.onChange = [this]
    {
        manager.setCurrentAudioDeviceType(type.box.getText(), true);
        fill();
    };
    const auto nameIn = [](const juce::ComboBox& box)
    {
        return box.getSelectedId() > noDevice ? box.getText() : juce::String();
    };
    output.box.onChange = [this, nameIn]
    {
        change(
            [&](Setup& setup)
            {
                setup.outputDeviceName = nameIn(output.box);
                setup.useDefaultOutputChannels = true;
                if (kind() != nullptr && !kind()->hasSeparateInputsAndOutputs())
                {
                    setup.inputDeviceName = setup.outputDeviceName;
                    setup.useDefaultInputChannels = true;
                }
            });
    };
    input.box.onChange = [this, nameIn]
    {
        change(
            [&](Setup& setup)
            {
                setup.inputDeviceName = nameIn(input.box);
                setup.useDefaultInputChannels = true;
            });
    };
    rate.box.onChange = [this]
    {
        change([&](Setup& setup) { setup.sampleRate = rate.box.getSelectedId(); });
    };
    buffer.box.onChange = [this]
    {
        change([&](Setup& setup) { setup.bufferSize = buffer.box.getSelectedId(); });
    };
    outputs.onChange = [this](const juce::BigInteger& channels)
    {
        change(
            [&](Setup& setup)
            {
                setup.useDefaultOutputChannels = false;
                setup.outputChannels = channels;
            });
    };
    inputs.onChange = [this](const juce::BigInteger& channels)
    {
        change(
            [&](Setup& setup)
            {
                setup.useDefaultInputChannels = false;
                setup.inputChannels = channels;
            });
    };
    addAll(*this, {&testButton, &outputs, &inputs});
    int order = 1;
    for (juce::Component* one : std::initializer_list<juce::Component*>{&type.box, &output.box, &testButton, &input.box,
                                                                        &rate.box, &buffer.box, &outputs, &inputs})
        one->setExplicitFocusOrder(order++);
    setTitle("Audio device");
    setFocusContainerType(FocusContainerType::focusContainer);
    manager.addChangeListener(this);
    fill();
}

DeviceSettings::~DeviceSettings()
{
    manager.removeChangeListener(this);
}

void DeviceSettings::prepare(Row& row, const juce::String& name, const juce::String& help)
{
    prepareLabel(row.name, name, usualFont());
    row.box.setTitle(name);
    row.box.setTooltip(help);
    addAndMakeVisible(row.name);
    addAndMakeVisible(row.box);
}

juce::AudioIODeviceType* DeviceSettings::kind() const
{
    return manager.getCurrentDeviceTypeObject();
}

void DeviceSettings::change(const std::function<void(Setup&)>& edit)
{
    Setup setup = manager.getAudioDeviceSetup();
    edit(setup);
    const juce::String refused = manager.setAudioDeviceSetup(setup, true);
    note.setText(refused, juce::dontSendNotification);
    note.setTooltip(refused);
    fill();
}

void DeviceSettings::fill()
{
    const Setup setup = manager.getAudioDeviceSetup();
    auto* device = manager.getCurrentAudioDevice();
    const auto clear = [](Row& row)
    {
        row.box.clear(juce::dontSendNotification);
    };
    clear(type);
    for (auto* one : manager.getAvailableDeviceTypes())
        type.box.addItem(one->getTypeName(), type.box.getNumItems() + 1);
    type.box.setText(manager.getCurrentAudioDeviceType(), juce::dontSendNotification);
    const auto fillDevices = [&](Row& row, bool forInput, const juce::String& chosen)
    {
        clear(row);
        row.box.addItem(tr("None"), noDevice);
        row.box.setSelectedId(noDevice, juce::dontSendNotification);
        const auto names = kind() != nullptr ? kind()->getDeviceNames(forInput) : juce::StringArray();
        for (int i = 0; i < names.size(); ++i)
        {
            row.box.addItem(names[i], noDevice + 1 + i);
            if (names[i] == chosen)
                row.box.setSelectedId(noDevice + 1 + i, juce::dontSendNotification);
        }
    };
    fillDevices(output, false, setup.outputDeviceName);
    fillDevices(input, true, setup.inputDeviceName);
    input.box.setEnabled(kind() != nullptr && kind()->hasSeparateInputsAndOutputs());
    clear(rate);
    clear(buffer);
    if (device != nullptr)
    {
        for (const double one : device->getAvailableSampleRates())
            rate.box.addItem(numberText(one, 0) + " Hz", juce::roundToInt(one));
        rate.box.setSelectedId(juce::roundToInt(device->getCurrentSampleRate()), juce::dontSendNotification);
        for (const int one : device->getAvailableBufferSizes())
            buffer.box.addItem(
                tr("{0} samples ({1} ms)",
                   {juce::String(one), numberText(1000.0 * one / std::max(1.0, device->getCurrentSampleRate()), 1)}),
                one);
        buffer.box.setSelectedId(device->getCurrentBufferSizeSamples(), juce::dontSendNotification);
    }
    outputs.show(device != nullptr ? device->getOutputChannelNames() : juce::StringArray(),
                 device != nullptr ? device->getActiveOutputChannels() : juce::BigInteger());
    inputs.show(device != nullptr ? device->getInputChannelNames() : juce::StringArray(),
                device != nullptr ? device->getActiveInputChannels() : juce::BigInteger());
    for (juce::Component* one :
         std::initializer_list<juce::Component*>{&rate.box, &buffer.box, &testButton, &outputs, &inputs})
        one->setEnabled(device != nullptr);
}

void DeviceSettings::resized()
{
    auto area = getLocalBounds();
    note.setBounds(area.removeFromBottom(3 * grid));
    const auto place = [&](Row& row)
    {
        auto line = area.removeFromTop(deviceRowHeight);
        row.name.setBounds(line.removeFromLeft(deviceLabelWidth));
        row.box.setBounds(line.removeFromLeft(std::min(space::widestBox, line.getWidth())).reduced(0, 2));
        area.removeFromTop(grid / 2);
        return line.reduced(0, 2);
    };
    place(type);
    auto rest = place(output);
    rest.removeFromLeft(grid);
    testButton.setBounds(rest.removeFromLeft(9 * grid));
    for (Row* row : {&input, &rate, &buffer})
        place(*row);
    area.removeFromTop(grid / 2);
    auto heads = area.removeFromTop(3 * grid);
    const int half = (area.getWidth() - grid) / 2;
    outputsLabel.setBounds(heads.removeFromLeft(half));
    heads.removeFromLeft(grid);
    inputsLabel.setBounds(heads);
    outputs.setBounds(area.removeFromLeft(half));
    area.removeFromLeft(grid);
    inputs.setBounds(area);
}

} // namespace pacini::editor
