#include "io/Settings.h"

#include "io/EncoderPresets.h"
#include "io/JsonTree.h"
#include "io/NearestName.h"
#include "io/formats/ExportParameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pacini
{

Result<Method> chosenMethod(std::string_view name)
{
    if (name.empty())
        return Method::a2vt;
    if (const auto method = methodNamed(name))
        return *method;
    std::vector<std::string> names;
    for (const MethodInfo& info : methodTable)
        names.emplace_back(info.name);
    return Error{
        ErrorCode::invalidArgument, "method",
        fmt::format("'{}' is not one of {}{}", shownText(name), fmt::join(names, ", "), meantText(name, names))};
}

namespace
{
bool sets(const EncoderPreset& preset, const Parameter<EncoderParams>& parameter)
{
    return parameter.get(preset.params) != parameter.get(EncoderParams{});
}
} // namespace

Result<void> usePreset(Settings& settings, std::string_view name)
{
    const auto preset = presetNamed(name);
    if (!preset)
        return preset.error();
    settings.preset = optionName(**preset);
    const auto all = encoderPresets();
    for (const auto& parameter : encoderParameters)
        if (std::any_of(all.begin(), all.end(), [&](const EncoderPreset& one) { return sets(one, parameter); }))
            settings.encode.set(parameter, parameter.get((*preset)->params));
    return {};
}

Result<TranslationParams> translationOf(const Settings& settings)
{
    const auto method = chosenMethod(settings.method);
    if (!method)
        return method.error();
    if (!settings.preset.empty() && *method != Method::a2vt)
        return Error{ErrorCode::invalidArgument, "preset",
                     fmt::format("is for the method a2vt, not for {}; leave it out", methodInfo(*method).name)};
    TranslationParams translation;
    translation.method = *method;
    for (const GivenValue& given : settings.encode)
        if (auto set = setParameter(translation, *given.parameter, given.value); !set)
            return set.error();
    if (auto valid = validate(translation); !valid)
        return valid.error();
    return translation;
}

void readEncodeSettings(FieldsReader& reader, Settings& settings)
{
    reader.optionalText("method", settings.method);
    if (const auto known = chosenMethod(settings.method); !known)
        reader.fail("method", known.error().message, ErrorCode::invalidArgument);
    std::optional<std::string> preset;
    reader.optionalText("preset", preset);
    if (preset)
        if (const auto used = usePreset(settings, *preset); !used)
            reader.fail("preset", used.error().message, ErrorCode::invalidArgument);
    readParameters(reader, translationParameters(), settings.encode);
}

void readSettingsFields(FieldsReader& reader, Settings& settings)
{
    reader.format(settingsFormat.name, settingsFormat.version);
    reader.object("encode", settings, Need::optional,
                  [&](Settings& into)
                  {
                      into.hasEncode = true;
                      readEncodeSettings(reader, into);
                  });
    reader.object("export", settings.exporting, Need::optional,
                  [&](GivenParameters& into) { readParameters(reader, exportParameterInfos(), into); });
#if PACINI_PLAYBACK_PASSED_OVER // on the web page, which is loaded for this and plays otherwise
    for (const char* name : {"pan", "outputs", "character", "live"})
        reader.passOver(name);
#else
    readPlaybackSettings(reader, settings.playback);
#endif
}

Result<Settings> readSettings(std::string_view text, ReadWarnings* warnings)
{
    const auto document = readJsonObject(text, largestSettingsText, "must be an object in braces");
    if (!document)
        return document.error();
    FieldsReader reader(*document, warnings);
    Settings settings;
    readSettingsFields(reader, settings);
    reader.finish();
    if (reader.error)
        return *reader.error;
    return settings;
}

nlohmann::ordered_json settingsJson(const TranslationParams& translation, const MethodChoices& usual)
{
    nlohmann::ordered_json encode{{"method", methodInfo(translation.method).name}};
    const TranslationParams standard{translation.method, {}, usual};
    for (const ParameterInfo* parameter : translationParameters())
    {
        if (!hasParameter(translation.method, parameter->name))
            continue;
        const double chosen = valueOf(translation, *parameter);
        if (const auto value = jsonOf(*parameter, std::isnan(chosen) ? valueOf(standard, *parameter) : chosen))
            encode[std::string(parameter->name)] = *value;
    }
    return {{"format", settingsFormat.name}, {"version", settingsFormat.version}, {"encode", encode}};
}

nlohmann::ordered_json presetsJson()
{
    auto all = nlohmann::ordered_json::array();
    for (const EncoderPreset& preset : encoderPresets())
    {
        auto values = nlohmann::ordered_json::object();
        for (const auto& parameter : encoderParameters)
            if (const auto value = jsonOf(parameter, parameter.get(preset.params)); value && sets(preset, parameter))
                values[std::string(parameter.name)] = *value;
        all.push_back({{"name", optionName(preset)}, {"purpose", preset.purpose}, {"values", values}});
    }
    return all;
}

nlohmann::ordered_json translationDescriptionsJson()
{
    auto all = nlohmann::ordered_json::array();
    for (const ParameterInfo* parameter : translationParameters())
    {
        all.push_back(descriptionJson(*parameter));
        for (const MethodInfo& info : methodTable)
            if (hasParameter(info.method, parameter->name))
                all.back()["methods"].push_back(info.name);
    }
    return all;
}

} // namespace pacini
