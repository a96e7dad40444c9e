// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/clap/ClapParameters.h"

#include "plugin/clap/ClapPlugin.h"
#include "plugin/engine/ParameterGroups.h"
#include "plugin/engine/ParameterText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace pacini::plugin
{

namespace
{
struct Identified
{
    clap_id id;
    std::size_t index;
};

/// All parameters, by their identifiers.
constexpr auto identified = []
{
    std::array<Identified, parameterCount> all{};
    for (std::size_t i = 0; i < parameterCount; ++i)
        all[i] = {clapIdOf(parameterTable[i]), i};
    std::sort(all.begin(), all.end(), [](const Identified& a, const Identified& b) { return a.id < b.id; });
    return all;
}();
static_assert(std::adjacent_find(identified.begin(), identified.end(),
                                 [](const Identified& a, const Identified& b)
                                 { return a.id == b.id; }) == identified.end());

template <std::size_t size>
void copyText(std::string_view text, char (&to)[size]) noexcept
{
    const std::size_t length = std::min(text.size(), size - 1);
    std::memcpy(to, text.data(), length);
    to[length] = 0;
}

clap_param_info_flags flagsOf(const ParameterRow& row) noexcept
{
    clap_param_info_flags flags = CLAP_PARAM_IS_AUTOMATABLE;
    if (isDiscrete(row))
        flags |= CLAP_PARAM_IS_STEPPED;
    if (row.unit == ParameterUnit::choice || row.unit == ParameterUnit::toggle)
        flags |= CLAP_PARAM_IS_ENUM;
    if (row.parameter == ParameterId::bypass)
        flags |= CLAP_PARAM_IS_BYPASS;
    if (isModulatable(row))
        flags |= CLAP_PARAM_IS_MODULATABLE;
    return flags;
}

/// Bytes of a text that fit into `room`, without the rest of a character that does not.
std::size_t wholeCharacters(std::string_view text, std::size_t room) noexcept
{
    if (text.size() <= room)
        return text.size();
    while (room > 0 && (static_cast<unsigned char>(text[room]) & 0xC0u) == 0x80u)
        --room;
    return room;
}
} // namespace

const ParameterRow* rowOfClapId(clap_id id) noexcept
{
    const auto found = std::lower_bound(identified.begin(), identified.end(), id,
                                        [](const Identified& each, clap_id wanted) { return each.id < wanted; });
    return found != identified.end() && found->id == id ? &parameterTable[found->index] : nullptr;
}

bool describeParameter(std::uint32_t index, clap_param_info_t& info) noexcept
{
    if (index >= parameterCount)
        return false;
    const ParameterRow& row = parameterTable[index];
    info = {};
    info.id = clapIdOf(row);
    info.flags = flagsOf(row);
    copyText(row.name, info.name);
    copyText(groupOf(row.id).name, info.module);
    info.min_value = row.low;
    info.max_value = row.high;
    info.default_value = row.standard;
    return true;
}

bool parameterText(clap_id id, double value, char* text, std::uint32_t capacity)
{
    const ParameterRow* row = rowOfClapId(id);
    if (row == nullptr || text == nullptr || capacity == 0 || !std::isfinite(value))
        return false;
    const std::string whole = textOf(*row, value);
    const std::size_t length = wholeCharacters(whole, capacity - 1);
    std::memcpy(text, whole.data(), length);
    text[length] = 0;
    return true;
}

bool parameterValue(clap_id id, const char* text, double& value)
{
    const ParameterRow* row = rowOfClapId(id);
    if (row == nullptr || text == nullptr)
        return false;
    const auto read = valueOf(*row, text);
    if (read)
        value = *read;
    return read.has_value();
}

void applyEvent(const PluginProcessor& processor, const clap_event_header_t& event) noexcept
{
    if (event.space_id != CLAP_CORE_EVENT_SPACE_ID)
        return;
    if (event.type == CLAP_EVENT_PARAM_VALUE && event.size >= sizeof(clap_event_param_value_t))
    {
        const auto& change = reinterpret_cast<const clap_event_param_value_t&>(event);
        if (const ParameterRow* row = rowOfClapId(change.param_id))
            processor.parameter(row->parameter).setPlain(change.value);
    }
    else if (event.type == CLAP_EVENT_PARAM_MOD && event.size >= sizeof(clap_event_param_mod_t))
    {
        const auto& change = reinterpret_cast<const clap_event_param_mod_t&>(event);
        if (const ParameterRow* row = rowOfClapId(change.param_id); row != nullptr && isModulatable(*row))
            processor.parameter(row->parameter).setModulation(change.amount);
    }
}

const clap_plugin_params_t& paramsExtension() noexcept
{
    static constexpr clap_plugin_params_t extension{
        [](const clap_plugin_t*) -> std::uint32_t { return parameterCount; },
        [](const clap_plugin_t*, std::uint32_t index, clap_param_info_t* info)
        { return info != nullptr && describeParameter(index, *info); },
        [](const clap_plugin_t* plugin, clap_id id, double* value)
        {
            const ParameterRow* row = rowOfClapId(id);
            if (row == nullptr || value == nullptr)
                return false;
            *value = ClapPlugin::of(plugin).processor().parameter(row->parameter).value();
            return true;
        },
        [](const clap_plugin_t*, clap_id id, double value, char* text, std::uint32_t capacity)
        { return parameterText(id, value, text, capacity); },
        [](const clap_plugin_t*, clap_id id, const char* text, double* value)
        { return value != nullptr && parameterValue(id, text, *value); },
        [](const clap_plugin_t* plugin, const clap_input_events_t* in, const clap_output_events_t* out)
        {
            ClapPlugin::of(plugin).flush(in, out);
        }};
    return extension;
}

} // namespace pacini::plugin
