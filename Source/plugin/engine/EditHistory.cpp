// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/EditHistory.h"

#include <utility>

namespace pacini::plugin
{

void StepList::add(EditStep step)
{
    if (step.changes.empty() && step.presetBefore == step.presetAfter)
        return;
    steps.resize(done);
    if (goesOn(step))
    {
        steps.back().changes[0].after = step.changes[0].after;
        steps.back().milliseconds = step.milliseconds;
        return;
    }
    steps.push_back(std::move(step));
    if (steps.size() > mostSteps)
        steps.erase(steps.begin());
    done = steps.size();
}

/// Whether a step continues the last one: both turn one and the same knob, a moment apart.
bool StepList::goesOn(const EditStep& step) const
{
    constexpr std::uint32_t pause = 500; // ms
    if (steps.empty() || !step.instant || step.changes.size() != 1 || isDiscrete(rowOf(step.changes[0].parameter)))
        return false;
    const EditStep& last = steps.back();
    return last.instant && last.changes.size() == 1 && last.changes[0].parameter == step.changes[0].parameter &&
           last.presetAfter == step.presetBefore && step.milliseconds - last.milliseconds < pause;
}

const EditStep* StepList::undo()
{
    return done == 0 ? nullptr : &steps[--done];
}

const EditStep* StepList::redo()
{
    return done == steps.size() ? nullptr : &steps[done++];
}

void StepList::clear() noexcept
{
    steps.clear();
    done = 0;
}

EditHistory::EditHistory(std::vector<juce::AudioProcessorParameter*> parameters, Now valuesNow,
                         std::function<void(EditStep)> onStep)
    : watched(std::move(parameters)), now(std::move(valuesNow)), take(std::move(onStep))
{
    for (auto* each : watched)
        each->addListener(this);
}

EditHistory::~EditHistory()
{
    for (auto* each : watched)
        each->removeListener(this);
}

EditStep EditHistory::stepBetween(const ParameterValues& before, const ParameterValues& after)
{
    EditStep step;
    for (const ParameterRow& row : parameterTable)
        if (before[row.parameter] != after[row.parameter])
            step.changes.push_back({row.parameter, before[row.parameter], after[row.parameter]});
    return step;
}

void EditHistory::parameterGestureChanged(int parameter, bool begins)
{
    if (pauses > 0)
        return;
    if (begins)
    {
        if (open++ == 0)
        {
            before = now();
            touched.reset();
            begun = juce::Time::getMillisecondCounter();
        }
        if (parameter >= 0 && static_cast<std::size_t>(parameter) < touched.size())
            touched.set(static_cast<std::size_t>(parameter));
        return;
    }
    if (open == 0 || --open > 0)
        return;
    // What the host moved meanwhile is no part of it.
    EditStep step = stepBetween(before, now());
    std::erase_if(step.changes, [this](const EditStep::Change& change)
                  { return !touched.test(static_cast<std::size_t>(change.parameter)); });
    step.milliseconds = begun;
    constexpr std::uint32_t shortestDrag = 20; // ms
    step.instant = juce::Time::getMillisecondCounter() - begun < shortestDrag;
    take(std::move(step));
}

} // namespace pacini::plugin
