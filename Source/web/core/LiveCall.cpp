// The calls `live`, from options and settings to what the live translator begins with, and `liveParameters`, its
// parameters.

#include "io/LiveSettings.h"
#include "web/core/Call.h"

#include <pacini/realtime/TranslatorSetup.h>

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
    const TranslatorSetup usual;
    constexpr double mostBoost = 40.0;
    const double bands = call.number("bands", static_cast<double>(usual.bands.bands), 1.0, maxTranslatorBands);
    if (bands != static_cast<double>(static_cast<int>(bands)))
        call.reader.fail("bands", "must be a whole number", ErrorCode::invalidArgument);
    const double maxBoost = call.number("maxBoost", usual.maxBoost.value, 0.0, mostBoost);
    const double strength = call.number("strength", usual.strength, 0.0, 1.0);
    if (auto known = call.finishOptions(); !known)
        return known;
    call.value["setup"] = {bands, maxBoost, strength};
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
