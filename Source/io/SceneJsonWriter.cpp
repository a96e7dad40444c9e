#include "io/ClipJson.h"
#include "io/SceneJson.h"
#include "io/SceneJsonRules.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pacini
{

namespace
{
std::string jsonText(std::string_view text)
{
    using nlohmann::json;
    return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Minus zero would come back as an integer zero.
std::string number(double value)
{
    return fmt::format("{}", value == 0.0 ? 0.0 : value);
}

/// A text whose lines after the first are moved in.
std::string indented(const std::string& text, std::size_t spaces)
{
    std::string result;
    for (char c : text)
    {
        result += c;
        if (c == '\n')
            result.append(spaces, ' ');
    }
    result.erase(result.find_last_not_of(" \n") + 1);
    return result;
}

template <typename Items, typename Write>
std::string list(const Items& items, Write&& write)
{
    std::string text = "[";
    for (const auto& item : items)
        text += (text.size() > 1 ? ",\n    " : "\n    ") + write(item);
    return text + (items.empty() ? "]" : "\n  ]");
}

std::string variationText(const VariationParams& v)
{
    const std::string seed = std::to_string(v.seed);
    return fmt::format("{{\"amount\": {}, \"scope\": \"{}\", \"seed\": {}}}", number(v.amount),
                       sceneJson::variationScopes[static_cast<std::size_t>(v.scope)],
                       v.seed <= sceneJson::largestNumberSeed ? seed : jsonText(seed));
}
} // namespace

std::string writeSceneJson(const Scene& scene)
{
    const auto clip = [](const Clip& c)
    {
        return fmt::format("{{\n      \"clip\": {}\n    }}", indented(writeClipJson(c), 6));
    };
    const auto play = [](const ScenePlay& p)
    {
        return fmt::format("{{\"name\": {}, \"clip\": {}, \"start\": {}, \"loop\": {}, \"passes\": {}, \"gain\": {}, "
                           "\"pan\": {}, \"transposition\": {}, \"stretch\": {}, \"priority\": {}, \"variation\": {}}}",
                           jsonText(p.name), p.clip, number(p.start), number(p.loop), p.passes, number(p.gain),
                           number(p.pan), number(p.transposition), number(p.stretch), p.priority,
                           variationText(p.variation));
    };
    const auto change = [](const SceneChange& c)
    {
        return fmt::format("{{\"time\": {}, \"play\": {}, \"parameter\": \"{}\", \"value\": {}, \"glide\": {}}}",
                           number(c.time), c.play, sceneJson::parameters[static_cast<std::size_t>(c.parameter)],
                           number(c.value), number(c.glide));
    };
    return fmt::format("{{\n  \"format\": \"{}\",\n  \"version\": {},\n  \"name\": {},\n  \"duration\": {},\n"
                       "  \"gain\": {},\n  \"actuators\": {},\n  \"panLaw\": \"{}\",\n  \"panDelay\": {},\n"
                       "  \"clips\": {},\n  \"plays\": {},\n  \"changes\": {}\n}}\n",
                       sceneFormatName, sceneFormatVersion, jsonText(scene.name), number(scene.duration),
                       number(scene.gain), scene.actuators, sceneJson::panLaws[static_cast<std::size_t>(scene.panLaw)],
                       number(scene.panDelay), list(scene.clips, clip), list(scene.plays, play),
                       list(scene.changes, change));
}

} // namespace pacini
