// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/DevicesSheet.h"

#include "editor/Theme.h"

namespace pacini::app
{

namespace
{
using editor::grid;
constexpr int none = 1; // menus know no item 0; channels follow
} // namespace

DevicesSheet::DevicesSheet(PreviewRig& wanted)
    : Sheet("Sound devices", 640, 560),
      rig(wanted),
      selector(wanted.devices(), 0, 256, 0, 256, false, false, false, false)
{
    const auto prepare =
        [this](juce::Label& label, juce::ComboBox& box, const juce::String& name, const juce::String& help)
    {
        label.setText(name, juce::dontSendNotification);
        label.setFont(editor::usualFont());
        label.setAccessible(false);
        box.setTitle(name);
        box.setTooltip(help);
        box.onChange = [this]
        {
            rig.setOutputs({sound.getSelectedId() - none - 1, haptic.getSelectedId() - none - 1});
        };
        addAndMakeVisible(label);
        addAndMakeVisible(box);
    };
    prepare(soundLabel, sound, "Sound out", "The two channels where the sound is heard");
    prepare(hapticLabel, haptic, "Haptic out", "The channel that the actuator's amplifier hangs on");
    addAndMakeVisible(selector);
    rig.devices().addChangeListener(this);
    setAnswers({{"Close", {}}});
    fill();
}

DevicesSheet::~DevicesSheet()
{
    rig.devices().removeChangeListener(this);
}

void DevicesSheet::fill()
{
    const auto names = rig.outputNames();
    const PreviewOutputs now = rig.outputs();
    sound.clear(juce::dontSendNotification);
    haptic.clear(juce::dontSendNotification);
    sound.addItem("Nowhere", none);
    haptic.addItem("Nowhere", none);
    for (int c = 0; c < names.size(); ++c)
    {
        if (c % 2 == 0)
            sound.addItem("Outputs " + juce::String(c + 1) + "+" + juce::String(c + 2), none + 1 + c);
        haptic.addItem(juce::String(c + 1) + "  " + names[c], none + 1 + c);
    }
    sound.setSelectedId(none + 1 + now.sound, juce::dontSendNotification);
    haptic.setSelectedId(none + 1 + std::min(now.haptic, std::max(-1, names.size() - 1)), juce::dontSendNotification);
}

void DevicesSheet::layOut(juce::Rectangle<int> area)
{
    for (auto [label, box] : {std::pair(&soundLabel, &sound), std::pair(&hapticLabel, &haptic)})
    {
        auto row = area.removeFromTop(4 * grid);
        label->setBounds(row.removeFromLeft(12 * grid));
        box->setBounds(row);
        area.removeFromTop(grid);
    }
    selector.setBounds(area);
}

} // namespace pacini::app
