#include "io/PlaybackSettings.h"

#include "io/Settings.h"

#include <algorithm>
#include <utility>

namespace pacini
{

namespace
{
template <typename Table, typename Params>
nlohmann::ordered_json entriesOf(const Table& table, const Params& params)
{
    auto entries = nlohmann::ordered_json::object();
    for (const auto& parameter : table)
        if (const auto value = jsonOf(parameter, parameter.get(params)))
            entries[std::string(parameter.name)] = *value;
    return entries;
}

/// These are no options of the command.
template <typename Table>
nlohmann::ordered_json entryDescriptions(const Table& table)
{
    auto all = descriptionsJson(infosOf(table));
    for (auto& one : all)
        one.erase("option");
    return all;
}
} // namespace

CharacterSettings characterOf(const TranslatorParams& params)
{
    CharacterSettings character;
    character.gain = std::clamp(params.intensity, CharacterSettings::leastGain, CharacterSettings::mostGain);
    character.transposition =
        std::clamp(params.transposition, -CharacterSettings::mostTransposition, CharacterSettings::mostTransposition);
    return character;
}

void readPlaybackSettings(FieldsReader& reader, PlaybackSettings& settings)
{
    OutputSettings outputs;
    readParametersOf(reader, panParameters, outputs);
    reader.list("outputs", outputs.outputs, OutputSettings::most, "outputs",
                [&](HapticOutput& output)
                {
                    reader.optionalText("actuator", output.actuator);
                    readParametersOf(reader, outputParameters, output);
                });
    if (!outputs.outputs.empty())
        settings.outputs = std::move(outputs);
    reader.optionalObject("character", settings.character,
                          [&](CharacterSettings& character)
                          { readParametersOf(reader, characterParameters, character); });
    reader.optionalObject("live", settings.live,
                          [&](TranslatorParams& params) { readParametersOf(reader, translatorParameters, params); });
}

nlohmann::ordered_json playbackSettingsJson(const PlaybackSettings& settings)
{
    nlohmann::ordered_json document{{"format", settingsFormat.name}, {"version", settingsFormat.version}};
    if (settings.outputs)
    {
        document.update(entriesOf(panParameters, *settings.outputs));
        auto& list = document["outputs"] = nlohmann::ordered_json::array();
        for (const HapticOutput& output : settings.outputs->outputs)
        {
            list.push_back(entriesOf(outputParameters, output));
            list.back()["actuator"] = output.actuator;
        }
    }
    if (settings.character)
        document["character"] = entriesOf(characterParameters, *settings.character);
    if (settings.live)
        document["live"] = entriesOf(translatorParameters, *settings.live);
    return document;
}

nlohmann::ordered_json playbackDescriptionsJson()
{
    auto outputs = entryDescriptions(outputParameters);
    outputs.push_back({{"name", "actuator"}, {"kind", "text"}, {"text", outputActuatorText}});
    return {{"pan", entryDescriptions(panParameters)},
            {"outputs", outputs},
            {"most", OutputSettings::most},
            {"character", entryDescriptions(characterParameters)},
            {"live", descriptionsJson(infosOf(translatorParameters))}};
}

} // namespace pacini
