#pragma once

// Options of described parameters, as Python gives them.

#include "io/GivenParameters.h"
#include "python/native/Support.h"

#include <pacini/foundation/Description.h>

#include <nanobind/stl/string.h>
#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <type_traits>
#include <utility>

namespace pacini::python
{

/// A value of Python as JSON: true, a number of any type, or a text.
[[nodiscard]] inline nlohmann::json jsonOf(nb::handle value)
{
    if (nb::isinstance<nb::bool_>(value))
        return nb::cast<bool>(value);
    if (nb::isinstance<nb::str>(value))
        return nb::cast<std::string>(value);
    const nb::object number = nb::steal(PyNumber_Float(value.ptr()));
    if (!number.is_valid())
        throw nb::python_error();
    return nb::cast<double>(number);
}

/// The value, or pacini.Error at the name that Python has for a parameter.
template <typename T>
T takeNamed(Result<T>&& result)
{
    if (!result)
        raise({result.error().code, separatedName(result.error().where, '_'), result.error().message});
    if constexpr (!std::is_void_v<T>)
        return std::move(result).value();
}

/// The values of those of `parameters` that are in `options`; None is not given. Raises pacini.Error.
[[nodiscard]] inline GivenParameters givenOptions(const nb::dict& options,
                                                  std::span<const ParameterInfo* const> parameters)
{
    auto entries = nlohmann::json::object();
    for (const ParameterInfo* parameter : parameters)
        for (const auto& [name, value] : options)
            if (!value.is_none() && nb::cast<std::string>(name) == separatedName(parameter->name, '_'))
                entries[std::string(parameter->name)] = jsonOf(value);
    FieldsReader reader(entries);
    GivenParameters given;
    readParameters(reader, parameters, given);
    return takeNamed(reader.error ? Result<GivenParameters>(*reader.error) : Result<GivenParameters>(given));
}

} // namespace pacini::python
