// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/window/ActuatorsPage.h"

#include "editor/Controls.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <pacini/foundation/Units.h>

#include <cmath>

namespace pacini::plugin
{

namespace
{
using editor::grid;

constexpr int controlHeight = 3 * grid + 2;
constexpr int lineHeight = 5 * grid;
} // namespace

std::vector<int> offeredValues(const ParameterRow& row)
{
    std::vector<int> values;
    for (std::size_t i = 0; i < row.choices.size(); ++i)
        if (!hasNoActuator(row.choices[i]))
            values.push_back(static_cast<int>(i));
    return values;
}

ActuatorsPage::ActuatorsPage(PluginProcessor& shown) : processor(shown)
{
    setTitle("Actuators");
    pan = choice(ParameterId::pan);
    position = slider(ParameterId::position, "Position");
    law = choice(ParameterId::panLaw);
    places = choice(ParameterId::places);
    for (std::size_t c = 0; c < rows.size(); ++c)
    {
        Row& row = rows[c];
        const auto of = [c](ChannelSetting setting)
        {
            return channelParameter(c, setting);
        };
        const juce::String number(c + 1);
        row.actuator = choice(of(ChannelSetting::actuator));
        row.load.setButtonText(juce::String::fromUTF8("Load…"));
        row.load.setTitle(editor::tr("Load actuator {0}", {number}));
        editor::prepareButton(row.load,
                              editor::tr("Loads the actuator of haptic channel {0} from a profile file", {number}),
                              [this, c]
                              {
                                  if (onLoad)
                                      onLoad(c);
                              });
        adopt(row.load, nullptr);
        row.place = slider(of(ChannelSetting::place), {});
        row.gain = slider(of(ChannelSetting::gain), {});
        row.delay = slider(of(ChannelSetting::delay), {});
        row.meter = std::make_unique<editor::LevelMeter>(
            editor::tr("Output {0}", {number}), editor::tr("Peak of haptic channel {0}; 0 dB is full drive", {number}),
            editor::LevelMeter::Scale{.low = -60.0f, .high = 0.0f, .warnAbove = -0.1f});
        addAndMakeVisible(*row.meter);
    }
    outputCount = slider(ParameterId::outputCount, "Added");
    hint.setFont(editor::smallFont());
    hint.setTitle("Channels");
    addAndMakeVisible(hint);
    refresh();
}

void ActuatorsPage::adopt(juce::Component& component, editor::Refreshed* wanted)
{
    component.setExplicitFocusOrder(++focusOrder);
    addAndMakeVisible(component);
    if (wanted)
        refreshed.push_back(wanted);
}

std::unique_ptr<editor::ParameterSlider> ActuatorsPage::slider(ParameterId parameter, const juce::String& label)
{
    const ParameterRow& row = rowOf(parameter);
    auto made = std::make_unique<editor::ParameterSlider>(
        processor.parameter(parameter), editor::ParameterSlider::Shape::bar, label, row.name, row.help);
    adopt(*made, made.get());
    return made;
}

std::unique_ptr<editor::ParameterChoice> ActuatorsPage::choice(ParameterId parameter)
{
    const ParameterRow& row = rowOf(parameter);
    auto made = std::make_unique<editor::ParameterChoice>(processor.parameter(parameter), offeredValues(row), row.name,
                                                          row.help);
    adopt(*made, made.get());
    return made;
}

void ActuatorsPage::refresh()
{
    for (editor::Refreshed* each : refreshed)
        each->refresh();
    const auto values = processor.values();
    const auto panned = static_cast<PanChoice>(values.index(ParameterId::pan));
    const std::size_t used = processor.channelsInUse();
    position->setEnabled(panned == PanChoice::position);
    law->setEnabled(panned != PanChoice::off);
    places->setEnabled(panned != PanChoice::off);
    for (std::size_t c = 0; c < rows.size(); ++c)
    {
        Row& row = rows[c];
        const bool isThere = c < used;
        row.actuator->setEnabled(isThere);
        row.load.setEnabled(isThere);
        row.place->setEnabled(isThere && panned != PanChoice::off && values.index(ParameterId::places) == 1);
        row.gain->setEnabled(isThere);
        row.delay->setEnabled(isThere);
        row.meter->setEnabled(isThere);
        row.meter->show(isThere ? Decibels::fromGain(static_cast<double>(processor.takePeak(c))).value : -1000.0);
    }
    outputCount->setEnabled(values.index(ParameterId::outputMode) ==
                            static_cast<std::size_t>(OutputMode::addToChannel));
    const juce::String text =
        used == 1
            ? editor::tr("One haptic channel. For more, add channels to the haptic output in the host, or set the "
                         "main output to \"Haptic replaces sound\" or \"Haptic added to one channel\".")
            : editor::tr("{0} haptic channels", {juce::String(static_cast<int>(used))});
    if (text != hint.getText())
        hint.setText(text, juce::dontSendNotification);
}

juce::Rectangle<int> ActuatorsPage::panCard() const
{
    return getLocalBounds().reduced(grid).withHeight(9 * grid);
}

juce::Rectangle<int> ActuatorsPage::channelCard() const
{
    return getLocalBounds().reduced(grid).withTrimmedTop(10 * grid);
}

juce::Rectangle<int> ActuatorsPage::lineOf(std::size_t row) const
{
    auto area = editor::insideOfCard(channelCard());
    if (row == 0)
        return area.removeFromTop(2 * grid);
    return area.withTrimmedTop(3 * grid + static_cast<int>(row - 1) * lineHeight).withHeight(lineHeight - grid);
}

ActuatorsPage::Columns ActuatorsPage::columnsOf(juce::Rectangle<int> line)
{
    Columns columns;
    const auto take = [&line](int width)
    {
        const auto taken = line.removeFromLeft(width);
        line.removeFromLeft(grid);
        return taken;
    };
    columns[numberColumn] = take(2 * grid);
    const int rest = line.getWidth() - 9 * grid - 6 * grid;
    columns[actuatorColumn] = take(rest * 24 / 100);
    columns[loadColumn] = take(9 * grid);
    columns[placeColumn] = take(rest * 18 / 100);
    columns[gainColumn] = take(rest * 18 / 100);
    columns[delayColumn] = take(rest * 18 / 100);
    columns[meterColumn] = line;
    return columns;
}

void ActuatorsPage::resized()
{
    auto line = editor::insideOfCard(panCard()).withHeight(controlHeight);
    const int width = (line.getWidth() - 6 * grid) / 10;
    pan->setBounds(line.removeFromLeft(2 * width));
    line.removeFromLeft(2 * grid);
    position->setBounds(line.removeFromLeft(4 * width));
    line.removeFromLeft(2 * grid);
    law->setBounds(line.removeFromLeft(2 * width));
    line.removeFromLeft(2 * grid);
    places->setBounds(line);
    for (std::size_t c = 0; c < rows.size(); ++c)
    {
        const Columns columns = columnsOf(lineOf(c + 1));
        const auto control = [&columns](int column)
        {
            return columns[static_cast<std::size_t>(column)].withHeight(controlHeight);
        };
        rows[c].actuator->setBounds(control(actuatorColumn));
        rows[c].load.setBounds(control(loadColumn));
        rows[c].place->setBounds(control(placeColumn));
        rows[c].gain->setBounds(control(gainColumn));
        rows[c].delay->setBounds(control(delayColumn));
        rows[c].meter->setBounds(columns[meterColumn]);
    }
    auto last = lineOf(maxHapticChannels + 1);
    outputCount->setBounds(last.removeFromRight(32 * grid).withHeight(controlHeight));
    hint.setBounds(last.withTrimmedRight(grid));
}

void ActuatorsPage::paint(juce::Graphics& g)
{
    const auto& palette = editor::paletteFor(*this);
    hint.setColour(juce::Label::textColourId, palette.dim);
    editor::drawCard(g, panCard(), "Pan", palette);
    editor::drawCard(g, channelCard(), "Haptic channels", palette);
    g.setFont(editor::smallFont());
    g.setColour(palette.dim);
    const Columns heads = columnsOf(lineOf(0));
    const auto head = [&](int column, const char* text)
    {
        g.drawText(editor::tr(text), heads[static_cast<std::size_t>(column)], juce::Justification::centredLeft, true);
    };
    head(actuatorColumn, "Actuator");
    head(placeColumn, "Place");
    head(gainColumn, "Gain");
    head(delayColumn, "Delay");
    g.setColour(palette.text);
    for (std::size_t c = 0; c < rows.size(); ++c)
        g.drawText(juce::String(c + 1), columnsOf(lineOf(c + 1))[numberColumn].withHeight(controlHeight),
                   juce::Justification::centred, false);
}

} // namespace pacini::plugin
