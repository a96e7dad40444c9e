// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/OutputsSheet.h"

#include "editor/ActuatorItem.h"
#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"

#include <algorithm>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr int outputRowHeight = 4 * grid;
constexpr int nowhere = 1;              // menus know no item 0; channels follow
constexpr int asProject = 1, plain = 2; // profiles follow
constexpr std::array<const char*, 5> names{"Output", "Actuator", "Gain", "Delay", "Position"};
} // namespace

OutputsSheet::OutputsSheet(HapticOutputs& hapticOutputs, const Actuators& profiles, const juce::StringArray& channels)
    : Sheet("Haptic outputs", 1060, 520),
      outputs(hapticOutputs),
      actuators(profiles),
      channelNames(channels),
      addButton("Add output"),
      removeButton("Remove last output")
{
    for (std::size_t i = 0; i < heads.size(); ++i)
    {
        prepareLabel(heads[i], names[i], smallFont());
        heads[i].setBorderSize({});
        addAndMakeVisible(heads[i]);
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
        prepare(i);
    addButton.setTitle("Add output");
    removeButton.setTitle("Remove last output");
    prepareButton(addButton, "Adds an output on the next channel of the device", [this] { outputs.add(); });
    prepareButton(removeButton, "Removes the last output", [this] { outputs.removeLast(); });
    note.setFont(smallFont());
    note.setBorderSize({});
    note.setTitle("Note");
    addAll(*this, {&addButton, &removeButton, &note});
    setAnswers({{"Close", {}}});
    subscriptions.on({&outputs.changed, &actuators.changed, &actuators.listChanged}, [this] { show(); });
    show();
}

OutputsSheet::OutputsSheet(EditorView& view, const juce::StringArray& channels,
                           const std::filesystem::path& presetFolder)
    : OutputsSheet(view.session().outputs, view.session().actuators, channels)
{
    own = std::make_unique<OwnPresets>(view, presetFolder);
    own->settings = [this]
    {
        return outputSettings({outputs.outputs(), outputs.pan()});
    };
    own->load = [this](const std::filesystem::path& file, const juce::String&) -> Result<void>
    {
        auto read = readOutputSettings(file);
        if (!read)
            return read.error();
        outputs.setPan(read->pan);
        outputs.setOutputs(std::move(read->outputs));
        return {};
    };
    own->onSaved = [this](const juce::String&)
    {
        fillPresets();
    };
    own->onRenamed = [this](const juce::String&, const juce::String&)
    {
        fillPresets();
    };
    presetBox.setTitle("Preset");
    presetBox.setTooltip("Presets of all outputs: settings files");
    presetBox.onChange = [this]
    {
        const int chosen = presetBox.getSelectedId();
        presetBox.setSelectedId(0, juce::dontSendNotification);
        if (chosen > 0)
            own->choose(chosen);
    };
    addAndMakeVisible(presetBox);
    fillPresets();
    resized();
}

void OutputsSheet::fillPresets()
{
    presetBox.clear(juce::dontSendNotification);
    own->addTo(presetBox);
    presetBox.setTextWhenNothingSelected(tr("Preset"));
}

void OutputsSheet::prepare(std::size_t index)
{
    Row& row = rows[index];
    const juce::String number(static_cast<int>(index) + 1);
    prepareLabel(row.number, number, usualFont());
    const auto box = [&](juce::ComboBox& one, const juce::String& title, const juce::String& help)
    {
        one.setTitle(tr(title, {number}));
        one.setTooltip(help);
    };
    box(row.channel, "Channel of output {0}", "Output channel connected to the actuator's amplifier");
    box(row.actuator, "Actuator of output {0}", "Actuator of this output; its limits are respected");
    const auto slider = [&](juce::Slider& one, const juce::String& title, const juce::String& help,
                            const juce::String& unit, juce::Range<double> range, double step, double rest)
    {
        one.setSliderStyle(juce::Slider::LinearHorizontal);
        one.setTextBoxStyle(juce::Slider::TextBoxRight, false, 7 * grid, 3 * grid);
        one.setTitle(tr(title, {number}));
        one.setTooltip(help);
        one.setRange(range, step);
        one.setTextValueSuffix(unit);
        one.setDoubleClickReturnValue(true, rest);
        one.setWantsKeyboardFocus(true);
    };
    slider(row.gain, "Gain of output {0}", "Level in dB", " dB", {HapticOutputs::leastGain, 0.0}, 0.5, 0.0);
    slider(row.delay, "Delay of output {0}", "Delay in ms, to align the outputs", " ms",
           {0.0, 1000.0 * HapticOutputs::longestDelay}, 1.0, 0.0);
    slider(row.place, "Position of output {0}", "Position in the row, for panning", " %", {0.0, 100.0}, 1.0, 0.0);
    row.channel.onChange = [this, index]
    {
        set(index, [&](HapticOutput& output) { output.channel = rows[index].channel.getSelectedId() - nowhere - 1; });
    };
    row.actuator.onChange = [this, index]
    {
        const int chosen = rows[index].actuator.getSelectedId();
        set(index,
            [&](HapticOutput& output)
            {
                output.actuator = chosen == plain ? HapticOutputs::plainDrive
                                  : chosen > plain
                                      ? actuators.profiles()[static_cast<std::size_t>(chosen - plain - 1)].name
                                      : std::string();
            });
    };
    row.gain.onValueChange = [this, index]
    {
        set(index, [&](HapticOutput& output) { output.gain = rows[index].gain.getValue(); });
    };
    row.delay.onValueChange = [this, index]
    {
        set(index, [&](HapticOutput& output) { output.delay = 0.001 * rows[index].delay.getValue(); });
    };
    row.place.onValueChange = [this, index]
    {
        set(index, [&](HapticOutput& output) { output.place = 0.01 * rows[index].place.getValue(); });
    };
    for (juce::Component* part : std::initializer_list<juce::Component*>{&row.number, &row.channel, &row.actuator,
                                                                         &row.gain, &row.delay, &row.place})
        addChildComponent(part);
}

void OutputsSheet::set(std::size_t index, const std::function<void(HapticOutput&)>& change)
{
    auto wanted = outputs.outputs();
    if (index >= wanted.size())
        return;
    change(wanted[index]);
    outputs.setOutputs(std::move(wanted));
}

void OutputsSheet::show()
{
    const auto& list = outputs.outputs();
    const int channels = channelNames.size();
    bool shared = false, beyond = false;
    juce::String silent; // of the outputs that play nowhere
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        Row& row = rows[i];
        const bool there = i < list.size();
        for (juce::Component* part : std::initializer_list<juce::Component*>{&row.number, &row.channel, &row.actuator,
                                                                             &row.gain, &row.delay, &row.place})
            part->setVisible(there);
        if (!there)
            continue;
        const HapticOutput& output = list[i];
        row.channel.clear(juce::dontSendNotification);
        row.channel.addItem(tr("None"), nowhere);
        for (int c = 0; c < channels; ++c)
            row.channel.addItem(juce::String(c + 1) + "  " + channelNames[c], nowhere + 1 + c);
        const int plays = std::min(outputs.channelOf(i), std::max(-1, channels - 1));
        const bool missing = plays < 0 && output.channel >= channels;
        if (missing)
            row.channel.addItem(tr("{0}  not on this device", {juce::String(output.channel + 1)}),
                                nowhere + 1 + output.channel);
        row.channel.setSelectedId(nowhere + 1 + (plays >= 0 ? plays : output.channel), juce::dontSendNotification);
        if (plays < 0)
            silent << (silent.isEmpty() ? "" : ", ") << juce::String(static_cast<int>(i) + 1);
        row.actuator.clear(juce::dontSendNotification);
        row.actuator.addItem(tr("As in project"), asProject);
        row.actuator.addItem(tr("No actuator"), plain);
        int chosen = output.actuator == HapticOutputs::plainDrive ? plain : asProject;
        for (std::size_t k = 0; k < actuators.profiles().size(); ++k)
        {
            const int item = plain + 1 + static_cast<int>(k);
            addActuator(row.actuator, *actuators.profiles()[k].profile, item);
            if (actuators.profiles()[k].name == output.actuator)
                chosen = item;
        }
        row.actuator.setSelectedId(chosen, juce::dontSendNotification);
        row.gain.setValue(output.gain, juce::dontSendNotification);
        row.delay.setValue(1000.0 * output.delay, juce::dontSendNotification);
        row.place.setValue(100.0 * output.place, juce::dontSendNotification);
        row.place.setEnabled(list.size() > 1 && outputs.pan().has_value());
        beyond = beyond || output.channel >= channels;
        for (std::size_t other = 0; other < i; ++other)
            shared = shared || (output.channel >= 0 && list[other].channel == output.channel);
    }
    addButton.setEnabled(list.size() < HapticOutputs::most);
    removeButton.setEnabled(list.size() > 1);
    note.setText(
        shared ? tr("Two outputs share a channel: only the first one plays.")
        : silent.isNotEmpty()
            ? tr("Output {0} does not play. Choose a channel that the device has and no other output uses.", {silent})
        : beyond           ? tr("The device has fewer channels: its last one is used instead.")
        : list.size() == 1 ? tr("One output plays the clip.")
                           : tr("All outputs play the clip; the Play page pans it across them."),
        juce::dontSendNotification);
    resized();
}

void OutputsSheet::layOut(juce::Rectangle<int> area)
{
    const auto columns = [](juce::Rectangle<int> line)
    {
        std::array<juce::Rectangle<int>, 6> parts;
        parts[0] = line.removeFromLeft(3 * grid);
        const int rest = line.getWidth() - 5 * grid;
        const std::array<int, 5> shares{22, 27, 17, 17, 17};
        for (std::size_t i = 0; i < shares.size(); ++i)
        {
            parts[i + 1] = line.removeFromLeft(rest * shares[i] / 100);
            line.removeFromLeft(grid);
        }
        return parts;
    };
    const auto top = columns(area.removeFromTop(2 * grid));
    for (std::size_t i = 0; i < heads.size(); ++i)
        heads[i].setBounds(top[i + 1]);
    area.removeFromTop(grid / 2);
    auto last = area.removeFromBottom(outputRowHeight);
    const auto widthOf = [](const juce::TextButton& button)
    {
        return usualFont().getStringWidth(button.getButtonText()) + 3 * grid;
    };
    addButton.setBounds(last.removeFromLeft(widthOf(addButton)).reduced(0, 3));
    last.removeFromLeft(grid);
    removeButton.setBounds(last.removeFromLeft(widthOf(removeButton)).reduced(0, 3));
    last.removeFromLeft(grid);
    if (own)
    {
        presetBox.setBounds(last.removeFromRight(20 * grid).reduced(0, 3));
        last.removeFromRight(grid);
    }
    note.setBounds(last);
    for (std::size_t i = 0; i < outputs.outputs().size(); ++i)
    {
        const auto parts = columns(area.removeFromTop(outputRowHeight));
        Row& row = rows[i];
        row.number.setBounds(parts[0]);
        row.channel.setBounds(parts[1].reduced(0, 2));
        row.actuator.setBounds(parts[2].reduced(0, 2));
        row.gain.setBounds(parts[3]);
        row.delay.setBounds(parts[4]);
        row.place.setBounds(parts[5]);
        area.removeFromTop(grid / 2);
    }
}

} // namespace pacini::editor
