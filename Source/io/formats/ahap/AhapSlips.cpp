#include "io/formats/ahap/AhapSlips.h"

#include "io/JsonText.h"
#include "io/formats/ForeignText.h"
#include "io/formats/ahap/AhapFormat.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
using Json = nlohmann::json;

/// The parameters of events that readAhap() knows.
bool isKnownParameter(std::string_view id)
{
    constexpr std::array<std::string_view, 6> known{"HapticIntensity", "HapticSharpness", "AttackTime",
                                                    "DecayTime",       "ReleaseTime",     "Sustained"};
    return std::find(known.begin(), known.end(), id) != known.end();
}

Json* memberOf(Json& object, const char* name)
{
    const auto found = object.is_object() ? object.find(name) : object.end();
    return object.is_object() && found != object.end() ? &*found : nullptr;
}

/// Takes the elements out of a list that are null.
void leaveOutNull(Json& list, std::set<std::string>& told, std::string_view name)
{
    if (!list.is_array())
        return;
    auto& elements = list.get_ref<Json::array_t&>();
    if (std::erase_if(elements, [](const Json& element) { return element.is_null(); }) > 0)
        told.insert(fmt::format("Pattern: null in {} is left out", name));
}

/// Puts one parameter of an event right; false if it is to be left out.
bool mendParameter(Json& parameter, std::set<std::string>& told)
{
    const Json* id = memberOf(parameter, "ParameterID");
    Json* value = memberOf(parameter, "ParameterValue");
    if (id == nullptr || value == nullptr)
        return true;
    if (id->is_null())
    {
        told.insert("Pattern: a parameter whose name is null is left out");
        return false;
    }
    if (!id->is_string() || !(value->is_null() || value->is_boolean()))
        return true;
    const auto& name = id->get_ref<const std::string&>();
    if (name == "Sustained" && value->is_boolean())
    {
        *value = value->get<bool>() ? 1 : 0;
        told.insert("Pattern: Sustained is true or false instead of 1 or 0");
        return true;
    }
    if (isKnownParameter(name) && !value->is_null())
        return true; // readAhap() refuses it
    told.insert(fmt::format("Pattern: the parameter {} is {} and left out", shownText(name), value->dump()));
    return false;
}

/// Puts all slips right; says which there were.
std::set<std::string> mend(Json& tree)
{
    std::set<std::string> told;
    Json* const pattern = memberOf(tree, "Pattern");
    if (pattern == nullptr || !pattern->is_array())
        return told;
    leaveOutNull(*pattern, told, "the list Pattern");
    for (Json& entry : *pattern)
    {
        Json* const event = memberOf(entry, "Event");
        Json* const parameters = event != nullptr ? memberOf(*event, "EventParameters") : nullptr;
        if (parameters == nullptr || !parameters->is_array())
            continue;
        leaveOutNull(*parameters, told, "EventParameters");
        std::erase_if(parameters->get_ref<Json::array_t&>(),
                      [&](Json& parameter) { return !mendParameter(parameter, told); });
    }
    return told;
}
} // namespace

Result<ImportedClip> readAhapWithSlips(std::string_view bytes)
{
    const auto has = [&](std::string_view word)
    {
        return bytes.find(word) != std::string_view::npos;
    };
    if (!has("true") && !has("false") && !has("null"))
        return readAhap(bytes);
    std::vector<std::string> warnings;
    auto tree = readForeignTree(bytes, warnings);
    auto told = tree ? mend(*tree) : std::set<std::string>();
    if (told.empty())
        return readAhap(bytes);
    auto imported = readAhap(tree->dump());
    constexpr std::size_t most = 50;
    if (imported)
        for (const std::string& what : told)
            if (imported->warnings.size() < most)
                imported->warnings.push_back(what);
    return imported;
}

} // namespace pacini
