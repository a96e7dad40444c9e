// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Undo history of the plugin: what a user did to the parameters, step by step.

#include "plugin/engine/ParameterValues.h"

#include <juce_audio_processors/juce_audio_processors.h>

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pacini::plugin
{

/// The preset that values were taken from.
struct PresetChoice
{
    int program = 0;  ///< of the shipped ones
    std::string user; ///< the name of the user's own; empty: the shipped one
    bool operator==(const PresetChoice&) const = default;
};

/// A step: the parameters that changed, and the preset.
struct EditStep
{
    struct Change
    {
        ParameterId parameter;
        double before, after;
    };
    std::vector<Change> changes;
    PresetChoice presetBefore, presetAfter;
    std::uint32_t milliseconds = 0; ///< when it began, by a clock that wraps
    bool instant = false;           ///< begun and ended at once: a notch of the wheel, a key
};

/// The steps that can be undone, and those that can be done again.
class StepList
{
public:
    static constexpr std::size_t mostSteps = 200; ///< the oldest ones are forgotten

    /// Forgets what could be done again. A step that changes nothing is left out, and one notch of the wheel after the
    /// other is one step.
    void add(EditStep step);
    /// The step to take back or to do again, which is then on the other side; null: there is none. Valid until the
    /// next call.
    [[nodiscard]] const EditStep* undo();
    [[nodiscard]] const EditStep* redo();
    [[nodiscard]] bool canUndo() const noexcept { return done > 0; }
    [[nodiscard]] bool canRedo() const noexcept { return done < steps.size(); }
    void clear() noexcept;

private:
    [[nodiscard]] bool goesOn(const EditStep& step) const;

    std::vector<EditStep> steps;
    std::size_t done = 0;
};

/// Makes one step of each gesture of the window's controls. Hosts change parameters without gestures of the plugin, so
/// that automation makes no steps. The audio thread never comes here but by JUCE's call for a changed value, which is
/// empty. [message]
class EditHistory final : private juce::AudioProcessorParameter::Listener
{
public:
    using Now = std::function<ParameterValues()>;

    /// `onStep` takes each step. `parameters` outlive this.
    EditHistory(std::vector<juce::AudioProcessorParameter*> parameters, Now valuesNow,
                std::function<void(EditStep)> onStep);
    ~EditHistory() override;

    /// While it lives gestures make no steps: they are part of a larger one.
    class Pause
    {
    public:
        explicit Pause(EditHistory& paused) noexcept : history(paused) { ++history.pauses; }
        ~Pause() { --history.pauses; }
        Pause(const Pause&) = delete;
        Pause& operator=(const Pause&) = delete;

    private:
        EditHistory& history;
    };

    /// What differs, as a step without presets.
    [[nodiscard]] static EditStep stepBetween(const ParameterValues& before, const ParameterValues& after);

private:
    void parameterValueChanged(int, float) override {}
    void parameterGestureChanged(int parameter, bool begins) override;

    std::vector<juce::AudioProcessorParameter*> watched;
    Now now;
    std::function<void(EditStep)> take;
    ParameterValues before;
    std::bitset<parameterCount> touched; ///< in the gesture that is going on
    std::uint32_t begun = 0;             ///< milliseconds
    int open = 0;                        ///< gestures
    int pauses = 0;
};

} // namespace pacini::plugin
