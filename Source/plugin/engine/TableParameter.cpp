// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/TableParameter.h"

#include "plugin/engine/ParameterText.h"

#include <cmath>

namespace pacini::plugin
{

namespace
{
juce::String labelOf(const ParameterRow& row)
{
    switch (row.unit)
    {
    case ParameterUnit::decibels:
        return "dB";
    case ParameterUnit::semitones:
        return "st";
    case ParameterUnit::milliseconds:
        return "ms";
    case ParameterUnit::percent:
        return "%";
    case ParameterUnit::number:
    case ParameterUnit::choice:
    case ParameterUnit::toggle:
        break;
    }
    return {};
}
/// Hosts hand over floats of 0 to 1. Finer than anything that matters, this makes 8 ms of 8.0000004 ms.
double tidied(double value) noexcept
{
    return std::round(1e4 * value) / 1e4;
}

/// The same for hosts that want values in their unit.
juce::NormalisableRange<float> rangeOf(const ParameterRow& row)
{
    const auto* of = &row;
    return {static_cast<float>(row.low), static_cast<float>(row.high),
            [of](float, float, float normal)
            { return static_cast<float>(tidied(valueAt(*of, static_cast<double>(normal)))); },
            [of](float, float, float value) { return static_cast<float>(normalOf(*of, static_cast<double>(value))); },
            [of](float, float, float value)
            {
                const double limited = juce::jlimit(of->low, of->high, static_cast<double>(value));
                return static_cast<float>(plugin::isDiscrete(*of) ? std::round(limited) : limited);
            }};
}
} // namespace

TableParameter::TableParameter(const ParameterRow& wanted)
    : RangedAudioParameter(juce::ParameterID(wanted.id, wanted.since), wanted.name,
                           juce::AudioProcessorParameterWithIDAttributes().withLabel(labelOf(wanted))),
      tableRow(&wanted),
      range(rangeOf(wanted)),
      normal(static_cast<float>(normalOf(wanted, wanted.standard))),
      plain(wanted.standard)
{
}

double TableParameter::heard() const noexcept
{
    return juce::jlimit(tableRow->low, tableRow->high, value() + modulation.load(std::memory_order_relaxed));
}

void TableParameter::setPlain(double wanted) noexcept
{
    if (std::isfinite(wanted))
        setValue(static_cast<float>(normalOf(*tableRow, wanted)));
}

void TableParameter::setModulation(double wanted) noexcept
{
    if (std::isfinite(wanted))
        modulation.store(wanted, std::memory_order_relaxed);
}

void TableParameter::setPlainNotifyingHost(double wanted)
{
    const auto place = static_cast<float>(normalOf(*tableRow, wanted));
    if (place != getValue())
        setValueNotifyingHost(place);
}

void TableParameter::setValue(float newValue)
{
    if (!std::isfinite(newValue))
        return;
    const double value = valueAt(*tableRow, static_cast<double>(newValue));
    plain.store(tidied(value), std::memory_order_relaxed);
    normal.store(static_cast<float>(plugin::isDiscrete(*tableRow)
                                        ? normalOf(*tableRow, value)
                                        : juce::jlimit(0.0, 1.0, static_cast<double>(newValue))),
                 std::memory_order_relaxed);
}

float TableParameter::getDefaultValue() const
{
    return static_cast<float>(normalOf(*tableRow, tableRow->standard));
}

juce::String TableParameter::getText(float normalisedValue, int maximumLength) const
{
    const auto text =
        juce::String::fromUTF8(textOf(*tableRow, valueAt(*tableRow, static_cast<double>(normalisedValue))).c_str());
    return maximumLength > 0 ? text.substring(0, maximumLength) : text;
}

float TableParameter::getValueForText(const juce::String& text) const
{
    const auto value = valueOf(*tableRow, text.toStdString());
    // The formats of plugins have no way to refuse a text.
    return value ? static_cast<float>(normalOf(*tableRow, *value)) : getValue();
}

int TableParameter::getNumSteps() const
{
    return plugin::isDiscrete(*tableRow) ? static_cast<int>(std::lround(tableRow->high - tableRow->low)) + 1
                                         : juce::AudioProcessor::getDefaultNumParameterSteps();
}

} // namespace pacini::plugin
