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

/// The steps to undo and to redo.
class StepList
{
public:
    static constexpr std::size_t mostSteps = 200; ///< the oldest ones are forgotten

    /// Adds a step and clears the steps to redo. A step without changes is left out; consecutive notches of the wheel
    /// are one step.
    void add(EditStep step);
    /// Returns the step to undo or to redo and moves it to the other list; null if there is none. Valid until the next
    /// call.
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

/// Records one step for each gesture of the window's controls. Hosts change parameters without gestures of the plugin,
/// so automation makes no steps. On the audio thread, only JUCE's callback for a changed value runs, which is empty.
/// [message]
class EditHistory final : private juce::AudioProcessorParameter::Listener
{
public:
    using Now = std::function<ParameterValues()>;

    /// `onStep` takes each step. `parameters` outlive this.
    EditHistory(std::vector<juce::AudioProcessorParameter*> parameters, Now valuesNow,
                std::function<void(EditStep)> onStep);
    ~EditHistory() override;

    /// During its lifetime, gestures record no steps: they are part of a larger one.
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

    /// Returns the differences as a step without presets.
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
