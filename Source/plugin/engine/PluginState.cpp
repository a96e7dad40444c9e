// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/PluginState.h"

#include "io/JsonTree.h"
#include "io/ProfileJson.h"
#include "io/Settings.h"

#include <pacini/foundation/Clamp.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini::plugin
{

namespace
{
using Json = nlohmann::json;

constexpr std::size_t longestControllerName = 256; // bytes; a device gives one of at most 126 characters

int sizeOf(const Json& tree, const char* name)
{
    const auto found = tree.find(name);
    if (found == tree.end() || !found->is_number())
        return 0;
    return static_cast<int>(clampTo(found->get<double>(), 0.0, 10000.0));
}

/// Channels are counted from 1 for people.
std::string channelName(std::size_t further)
{
    return std::to_string(further + 2);
}

void addNote(std::string& note, const std::string& more)
{
    note += (note.empty() ? "" : "; ") + more;
}

void readValues(const Json& named, ParameterValues& values, std::string& note)
{
    for (const ParameterRow& row : parameterTable)
    {
        const auto found = named.find(row.id);
        if (found == named.end())
        {
            // Before there was such a parameter, actuators were played as flat as can be.
            if (row.parameter == ParameterId::strength)
                values.set(row.parameter, 0.0);
            // And nothing above the range of touch was felt by its loudness.
            if (row.parameter == ParameterId::audible)
                values.set(row.parameter, 0.0);
            continue;
        }
        if (!found->is_number() || !std::isfinite(found->get<double>()))
        {
            addNote(note, std::string(row.name) + " is not a number; the default is used");
            continue;
        }
        const double value = clampTo(found->get<double>(), row.low, row.high);
        values.set(row.parameter, isDiscrete(row) ? std::round(value) : value);
    }
}

void readSettings(const Json& tree, PluginSettings& settings, std::string& note)
{
    if (const auto named = tree.find("parameters"); named != tree.end() && named->is_object())
        readValues(*named, settings.values, note);
    settings.preset.program = sizeOf(tree, "program");
    if (const auto user = tree.find("preset"); user != tree.end() && user->is_string())
        if (auto name = user->get<std::string>(); name.size() <= SettingsPresets::longestName)
            settings.preset.user = std::move(name);
    const auto readContent = [&note](const Json& from, const std::string& name, const std::string& what)
    {
        std::optional<Profile> found;
        const auto content = from.find(name);
        if (content == from.end() || content->is_null())
            return found;
        if (auto profile = readProfileJson(content->dump()))
            found = std::move(profile).value();
        else
            addNote(note, what + " of the session cannot be read: " + profile.error().text());
        return found;
    };
    settings.profile = readContent(tree, "profile", "the actuator");
    if (const auto further = tree.find("furtherProfiles"); further != tree.end() && further->is_object())
        for (std::size_t i = 0; i < settings.furtherProfiles.size(); ++i)
            settings.furtherProfiles[i] = readContent(*further, channelName(i), "actuator " + channelName(i));
}

Json settingsTree(const PluginSettings& settings)
{
    Json tree;
    Json& named = tree["parameters"];
    for (const ParameterRow& row : parameterTable)
        named[row.id] = settings.values[row.parameter];
    tree["program"] = settings.preset.program;
    if (!settings.preset.user.empty())
        tree["preset"] = settings.preset.user;
    if (settings.profile)
        tree["profile"] = Json::parse(profileJson(*settings.profile));
    for (std::size_t i = 0; i < settings.furtherProfiles.size(); ++i)
        if (const auto& profile = settings.furtherProfiles[i])
            tree["furtherProfiles"][channelName(i)] = Json::parse(profileJson(*profile));
    return tree;
}
} // namespace

std::string stateText(const PluginState& state)
{
    Json tree = settingsTree(state);
    tree["format"] = stateFormatName;
    tree["version"] = stateFormatVersion;
    if (state.side == Side::b)
        tree["side"] = "B";
    if (state.other)
        tree["otherSide"] = settingsTree(*state.other);
    if (state.windowWidth > 0 && state.windowHeight > 0)
        tree["window"] = {{"width", state.windowWidth}, {"height", state.windowHeight}};
    if (!state.keepsCaptures)
        tree["keepsCaptures"] = false;
    if (!state.controller.empty())
        tree["controller"] = state.controller;
    if (!state.clips.empty())
        tree["clips"] = Json::parse(state.clips);
    return tree.dump(-1, ' ', false, Json::error_handler_t::replace); // a controller gives itself any name
}

Result<ReadState> readState(std::string_view text)
{
    auto tree = readJsonTree(text, largestState);
    if (!tree)
        return tree.error();
    if (!tree->is_object() || tree->value("format", Json()) != Json(stateFormatName))
        return Error{ErrorCode::invalidData, "format", "is not a state of Pacini's plugin"};
    const auto version = tree->find("version");
    if (version == tree->end() || !version->is_number() || !(version->get<double>() >= 1.0))
        return Error{ErrorCode::invalidData, "version", "is missing or no version"};
    if (version->get<double>() > stateFormatVersion)
        return Error{ErrorCode::unsupportedVersion, "version", "was written by a newer version of the plugin"};

    ReadState read;
    readSettings(*tree, read.state, read.note);
    if (tree->value("side", Json()) == Json("B"))
        read.state.side = Side::b;
    if (const auto other = tree->find("otherSide"); other != tree->end() && other->is_object())
        readSettings(*other, read.state.other.emplace(), read.note);
    if (const auto window = tree->find("window"); window != tree->end() && window->is_object())
    {
        read.state.windowWidth = sizeOf(*window, "width");
        read.state.windowHeight = sizeOf(*window, "height");
    }
    if (const auto keeps = tree->find("keepsCaptures"); keeps != tree->end() && keeps->is_boolean())
        read.state.keepsCaptures = keeps->get<bool>();
    if (const auto controller = tree->find("controller"); controller != tree->end() && controller->is_string())
        if (auto name = controller->get<std::string>(); name.size() <= longestControllerName)
            read.state.controller = std::move(name);
    if (const auto clips = tree->find("clips"); clips != tree->end() && clips->is_object())
        read.state.clips = clips->dump();
    return read;
}

Result<TranslatorParams> readPreset(std::string_view text)
{
    const auto tree = readJsonTree(text, largestSettingsText);
    if (!tree)
        return tree.error();
    if (!tree->is_object() || tree->value("format", Json()) != Json(stateFormatName))
        return readLiveSettings(text);
    const auto read = readState(text);
    if (!read)
        return read.error();
    if (!read->note.empty())
        return Error{ErrorCode::invalidData, "parameters", read->note};
    return read->state.values.translator();
}

PresetListing presetsIn(const SettingsPresets& files)
{
    PresetListing found;
    found.broken = files.misnamed();
    for (std::string& name : files.names())
    {
        const auto text = files.text(name);
        if (const auto params = text ? readPreset(*text) : Result<TranslatorParams>(text.error()))
            found.presets.push_back({std::move(name), *params});
        else
            found.broken.push_back({params.error().code, name + ".json", params.error().text()});
    }
    return found;
}

} // namespace pacini::plugin
