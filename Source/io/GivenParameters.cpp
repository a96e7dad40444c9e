#include "io/GivenParameters.h"

#include "io/Fields.h"
#include "io/NearestName.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace pacini
{

namespace
{
constexpr std::array<Choice<ParameterKind>, 4> kinds{{{"number", ParameterKind::number},
                                                      {"whole", ParameterKind::whole},
                                                      {"truth", ParameterKind::truth},
                                                      {"choice", ParameterKind::choice}}};

/// The value of a parameter in the current object, if it has one. Programs may give NaN, which no range allows.
std::optional<double> readValue(FieldsReader& reader, const ParameterInfo& parameter)
{
    const char* name = parameter.name.data(); // of a literal
    std::optional<double> value;
    if (parameter.kind == ParameterKind::truth)
        reader.optionalTruth(name, value);
    else if (parameter.kind == ParameterKind::choice)
    {
        std::optional<std::string> chosen;
        reader.optionalText(name, chosen);
        if (!chosen)
            return std::nullopt;
        const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), *chosen);
        if (found != parameter.choices.end())
            return static_cast<double>(found - parameter.choices.begin());
        reader.fail(name,
                    fmt::format("must be {}, not '{}'{}", allowedText(parameter), shownText(*chosen),
                                meantText(*chosen, {parameter.choices.begin(), parameter.choices.end()})),
                    ErrorCode::invalidArgument);
    }
    else
        reader.optionalNumber(name, value);
    return value;
}
} // namespace

void GivenParameters::set(const ParameterInfo& parameter, double value)
{
    for (GivenValue& one : given)
        if (one.parameter->name == parameter.name)
        {
            one.value = value;
            return;
        }
    given.push_back({&parameter, value});
}

double GivenParameters::find(std::string_view name) const noexcept
{
    for (const GivenValue& one : given)
        if (one.parameter->name == name)
            return one.value;
    return std::numeric_limits<double>::quiet_NaN();
}

void readParameters(FieldsReader& reader, std::span<const ParameterInfo* const> parameters, GivenParameters& given)
{
    for (const ParameterInfo* parameter : parameters)
    {
        const auto value = readValue(reader, *parameter);
        if (!value)
            continue;
        if (const auto allowed = checkValue(*parameter, *value); !allowed)
            reader.fail(parameter->name, allowed.error().message, ErrorCode::invalidArgument);
        given.set(*parameter, *value);
    }
}

std::optional<nlohmann::ordered_json> jsonOf(const ParameterInfo& parameter, double value)
{
    if (!std::isfinite(value))
        return std::nullopt;
    if (parameter.kind == ParameterKind::truth)
        return value != 0.0;
    if (parameter.kind == ParameterKind::choice)
        return valueText(parameter, value);
    if (value == std::floor(value) && std::abs(value) < 0x1p53)
        return static_cast<std::int64_t>(value);
    return value;
}

nlohmann::ordered_json descriptionJson(const ParameterInfo& parameter)
{
    nlohmann::ordered_json one{{"name", parameter.name},
                               {"option", optionName(parameter)},
                               {"kind", nameOf(parameter.kind, kinds)},
                               {"unit", parameter.unit}};
    if (parameter.kind == ParameterKind::choice)
        one["choices"] = parameter.choices;
    else if (parameter.kind != ParameterKind::truth)
    {
        one["lowest"] = *jsonOf(parameter, parameter.range.lowest);
        one["highest"] = *jsonOf(parameter, parameter.range.highest);
    }
    if (const auto usual = jsonOf(parameter, parameter.usual()))
        one["default"] = *usual;
    if (!parameter.usualText.empty())
        one["usually"] = parameter.usualText;
    one["text"] = parameter.text;
    one["group"] = parameter.group;
    one["since"] = parameter.since;
    return one;
}

nlohmann::ordered_json descriptionsJson(std::span<const ParameterInfo* const> parameters)
{
    auto all = nlohmann::ordered_json::array();
    for (const ParameterInfo* parameter : parameters)
        all.push_back(descriptionJson(*parameter));
    return all;
}

} // namespace pacini
