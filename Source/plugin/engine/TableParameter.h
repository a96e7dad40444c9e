// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Host parameter (JUCE) of a row of parameterTable.

#include "plugin/engine/ParameterTable.h"

#include <juce_audio_processors/juce_audio_processors.h>

#include <atomic>

namespace pacini::plugin
{

/// Any thread may read and write; there is no lock.
class TableParameter final : public juce::RangedAudioParameter
{
public:
    explicit TableParameter(const ParameterRow& wanted);

    [[nodiscard]] const ParameterRow& row() const noexcept { return *tableRow; }

    /// The value in the unit of the row.
    [[nodiscard]] double value() const noexcept { return plain.load(std::memory_order_relaxed); }
    /// The value with its modulation, within the range of the row: what the engine plays.
    [[nodiscard]] double heard() const noexcept;
    /// Sets the value as a host does, without notifying it; one that is not finite is ignored. [any]
    void setPlain(double wanted) noexcept;
    /// Sets what a host adds to the value for as long as it modulates it, in the unit of the row: the value stays. One
    /// that is not finite is ignored. [any]
    void setModulation(double wanted) noexcept;
    /// Notifies the host and all listeners. [message]
    void setPlainNotifyingHost(double wanted);

    const juce::NormalisableRange<float>& getNormalisableRange() const override { return range; }
    float getValue() const override { return normal.load(std::memory_order_relaxed); }
    void setValue(float newValue) override;
    float getDefaultValue() const override;
    juce::String getText(float normalisedValue, int maximumLength) const override;
    float getValueForText(const juce::String& text) const override;
    int getNumSteps() const override;
    bool isDiscrete() const override { return plugin::isDiscrete(*tableRow); }
    bool isBoolean() const override { return tableRow->unit == ParameterUnit::toggle; }

private:
    const ParameterRow* tableRow;
    juce::NormalisableRange<float> range;
    std::atomic<float> normal;
    std::atomic<double> plain;
    std::atomic<double> modulation{0.0};
};

} // namespace pacini::plugin
