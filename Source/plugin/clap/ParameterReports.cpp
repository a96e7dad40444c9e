// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/clap/ParameterReports.h"

#include "plugin/clap/ClapParameters.h"

#include <utility>

namespace pacini::plugin
{

namespace
{
clap_event_header_t headerOf(std::size_t size, std::uint16_t type) noexcept
{
    return {static_cast<std::uint32_t>(size), 0, CLAP_CORE_EVENT_SPACE_ID, type, CLAP_EVENT_IS_LIVE};
}

bool pushGesture(const clap_output_events_t& events, clap_id id, std::uint16_t type) noexcept
{
    const clap_event_param_gesture_t event{headerOf(sizeof(clap_event_param_gesture_t), type), id};
    return events.try_push(&events, &event.header);
}

bool pushValue(const clap_output_events_t& events, clap_id id, double value) noexcept
{
    clap_event_param_value_t event{};
    event.header = headerOf(sizeof event, CLAP_EVENT_PARAM_VALUE);
    event.param_id = id;
    event.note_id = event.port_index = event.channel = event.key = -1;
    event.value = value;
    return events.try_push(&events, &event.header);
}
} // namespace

ParameterReports::ParameterReports(PluginProcessor& watched, Client wanted)
    : processor(watched), client(std::move(wanted))
{
    processor.addListener(this);
}

ParameterReports::~ParameterReports()
{
    processor.removeListener(this);
}

void ParameterReports::announce()
{
    any.store(true);
    client.onReport();
}

void ParameterReports::audioProcessorParameterChanged(juce::AudioProcessor*, int index, float)
{
    if (pauses.load() > 0)
        return;
    parameters[static_cast<std::size_t>(index)].changed.store(true);
    announce();
}

void ParameterReports::audioProcessorParameterChangeGestureBegin(juce::AudioProcessor*, int index)
{
    parameters[static_cast<std::size_t>(index)].held.store(true);
    parameters[static_cast<std::size_t>(index)].begun.store(true);
    announce();
}

void ParameterReports::audioProcessorParameterChangeGestureEnd(juce::AudioProcessor*, int index)
{
    parameters[static_cast<std::size_t>(index)].held.store(false);
    announce();
}

void ParameterReports::audioProcessorChanged(juce::AudioProcessor*, const ChangeDetails& details)
{
    if (pauses.load() == 0 && (details.programChanged || details.nonParameterStateChanged))
        client.onOtherEdit();
}

void ParameterReports::send(const clap_output_events_t& events) noexcept
{
    if (events.try_push == nullptr || !any.exchange(false))
        return;
    for (std::size_t i = 0; i < parameterCount; ++i)
        if (!sendOne(i, events))
            any.store(true);
}

/// `held` is read first: whatever came before its end is then there.
bool ParameterReports::sendOne(std::size_t index, const clap_output_events_t& events) noexcept
{
    Parameter& parameter = parameters[index];
    const ParameterRow& row = parameterTable[index];
    const clap_id id = clapIdOf(row);
    const bool held = parameter.held.load();
    const bool begun = parameter.begun.exchange(false);
    if ((begun || held) && !parameter.toldHeld)
    {
        if (!pushGesture(events, id, CLAP_EVENT_PARAM_GESTURE_BEGIN))
        {
            parameter.begun.store(true);
            return false;
        }
        parameter.toldHeld = true;
    }
    if (parameter.changed.exchange(false) && !pushValue(events, id, processor.parameter(row.parameter).value()))
    {
        parameter.changed.store(true);
        return false;
    }
    if (!held && parameter.toldHeld)
    {
        if (!pushGesture(events, id, CLAP_EVENT_PARAM_GESTURE_END))
            return false;
        parameter.toldHeld = false;
    }
    return true;
}

} // namespace pacini::plugin
