#pragma once

// Values that users give to described parameters by name, and parameters as JSON.

#include "io/FieldsReader.h"

#include <pacini/foundation/Description.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace pacini
{

/// A value of a parameter, as ParameterInfo counts them.
struct GivenValue
{
    const ParameterInfo* parameter;
    double value;
};

/// Values that were given, each parameter once.
class GivenParameters
{
public:
    /// Replaces the values given before.
    void set(const ParameterInfo& parameter, double value);

    [[nodiscard]] auto begin() const noexcept { return given.begin(); }
    [[nodiscard]] auto end() const noexcept { return given.end(); }
    [[nodiscard]] bool empty() const noexcept { return given.empty(); }

    /// The value of the parameter of this name; NaN where it was not given.
    [[nodiscard]] double find(std::string_view name) const noexcept;

private:
    std::vector<GivenValue> given;
};

/// Takes the values of `parameters` from the reader's current object. Checks numbers, booleans, and names of choices;
/// errors are stored in the reader.
void readParameters(FieldsReader& reader, std::span<const ParameterInfo* const> parameters, GivenParameters& given);

/// The same into a struct that `table` describes.
template <typename Table, typename Params>
void readParametersOf(FieldsReader& reader, const Table& table, Params& params)
{
    GivenParameters given;
    readParameters(reader, infosOf(table), given);
    for (const auto& [parameter, value] : given)
        parameterNamed(table, parameter->name).set(params, value);
}

/// A value as JSON has it; nothing where it is not set.
[[nodiscard]] std::optional<nlohmann::ordered_json> jsonOf(const ParameterInfo& parameter, double value);

/// Description of a parameter for programs: name, option, unit, range, default and so on.
[[nodiscard]] nlohmann::ordered_json descriptionJson(const ParameterInfo& parameter);

/// The descriptions of several parameters, in their order.
[[nodiscard]] nlohmann::ordered_json descriptionsJson(std::span<const ParameterInfo* const> parameters);

} // namespace pacini
