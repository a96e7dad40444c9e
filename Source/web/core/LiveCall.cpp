// The calls `live`, from options and settings to what the live translator begins with, and `liveParameters`, its
// parameters.

#include "io/LiveSettings.h"
#include "web/core/Call.h"

#include <pacini/realtime/TranslatorSetupParameters.h>

#include <optional>

namespace pacini::web
{

Result<void> readLive(Call& call)
{
    std::optional<Settings> settings;
    call.reader.optionalObject("settings", settings, [&](Settings& into) { readSettingsFields(call.reader, into); });
    TranslatorParams params;
    if (settings && !call.reader.error)
    {
        auto live = liveParamsOf(*settings);
        if (!live)
            return Error{live.error().code, "settings." + live.error().where, live.error().message};
        params = *live;
    }
    readParametersOf(call.reader, translatorParameters, params);
    TranslatorSetup setup;
    readParametersOf(call.reader, translatorSetupParameters, setup);
    if (auto known = call.finishOptions(); !known)
        return known;
    auto& numbers = call.value["setup"] = Json::array();
    for (const auto& parameter : translatorSetupParameters)
        numbers.push_back(parameter.get(setup));
    auto& values = call.value["values"] = Json::array();
    for (const auto& parameter : translatorParameters)
        values.push_back(parameter.get(params));
    return {};
}

Result<void> describeLive(Call& call)
{
    call.value["parameters"] = descriptionsJson(infosOf(translatorParameters));
    return {};
}

} // namespace pacini::web
