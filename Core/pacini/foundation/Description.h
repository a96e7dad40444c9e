#pragma once

// Descriptions of parameters: name, unit, range, choices and a sentence of each field that users set.
//
// Each struct of parameters has a table of descriptions. The command, Python, the web package, settings files,
// projects, the editor, records in clips, the JSON schema and the tables of the documentation are made from it; ranges,
// defaults and sentences are written nowhere else.

#include <pacini/foundation/NumberText.h>
#include <pacini/foundation/Result.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace pacini
{

/// Kind of the values of a parameter.
enum class ParameterKind
{
    number,
    whole,
    truth,
    choice,
};

/// Lowest and highest value of a parameter, both allowed.
struct DescribedRange
{
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
};

/// Description of a parameter as its author writes it.
struct ParameterText
{
    /// In settings, JavaScript and, with `_` before what were capitals, Python; `--minimum-gap` for the command.
    std::string_view name;
    std::string_view option = {}; ///< of the command, where that has another name
    std::string_view member = {}; ///< of the struct, in project files; empty: `name`
    std::string_view text;        ///< one sentence without its full stop
    std::string_view unit = {};
    DescribedRange range = {};
    std::span<const std::string_view> choices = {};       ///< in the order of the enumeration
    std::span<const std::string_view> memberChoices = {}; ///< in project files; empty: `choices`
    std::string_view usualText = {};                      ///< default in words, where the struct has none
    std::string_view unsetWord = {};                      ///< of the command: "auto" leaves an optional choice open
    std::string_view group = {};                          ///< heading in help texts and documentation
    std::string_view since = "0.1";                       ///< first version that has it
    bool negated = false;                                 ///< `name` is true where the member is false
    bool alwaysRecorded = false;                          ///< in a clip's record also where it is the default
};

/// Description of a parameter without the struct that holds it. Values of all kinds are numbers here: 1 is true, a
/// choice is its index, NaN is not set.
struct ParameterInfo : ParameterText
{
    ParameterKind kind = ParameterKind::number;
    bool optional = false;       ///< may be unset, and is by default
    double (*usual)() = nullptr; ///< default
};

/// Description of a parameter of `Params`.
template <typename Params>
struct Parameter : ParameterInfo
{
    double (*get)(const Params&) = nullptr;
    void (*set)(Params&, double) = nullptr; ///< takes allowed values, see checkValue()
};

namespace detail
{

template <typename Member>
struct OwnerOf;
template <typename Field, typename Owner>
struct OwnerOf<Field Owner::*>
{
    using Type = Owner;
};

template <typename Field>
struct IsOptional : std::false_type
{
};
template <typename Value>
struct IsOptional<std::optional<Value>> : std::true_type
{
};

template <typename Field>
struct ValueOf
{
    using Type = Field;
};
template <typename Value>
struct ValueOf<std::optional<Value>>
{
    using Type = Value;
};

template <typename Field>
constexpr ParameterKind kindOf() noexcept
{
    if constexpr (IsOptional<Field>::value)
        return kindOf<typename Field::value_type>();
    else if constexpr (std::is_same_v<Field, bool>)
        return ParameterKind::truth;
    else if constexpr (std::is_enum_v<Field>)
        return ParameterKind::choice;
    else
        return std::is_integral_v<Field> ? ParameterKind::whole : ParameterKind::number;
}

template <typename Field>
constexpr double numberOf(const Field& field) noexcept
{
    if constexpr (IsOptional<Field>::value)
        return field ? numberOf(*field) : std::numeric_limits<double>::quiet_NaN();
    else if constexpr (std::is_arithmetic_v<Field> || std::is_enum_v<Field>)
        return static_cast<double>(field);
    else
        return field.value; // Hertz, Seconds, Decibels
}

template <typename Field>
constexpr void assignNumber(Field& field, double value) noexcept
{
    if constexpr (IsOptional<Field>::value)
        assignNumber(field.emplace(), value);
    else if constexpr (std::is_same_v<Field, bool>)
        field = value != 0.0;
    else if constexpr (std::is_enum_v<Field>)
        field = static_cast<Field>(static_cast<std::underlying_type_t<Field>>(value));
    else if constexpr (std::is_arithmetic_v<Field>)
        field = static_cast<Field>(value);
    else
        field = Field(value);
}

/// Type of the field at the end of a path of members; Optional where one on the way is.
template <typename Params, auto First, auto... Rest>
struct FieldAt
{
    using Here = std::remove_cvref_t<decltype(std::declval<Params&>().*First)>;
    static constexpr bool optional = IsOptional<Here>::value;
    using Type = Here;
};
template <typename Params, auto First, auto Second, auto... Rest>
struct FieldAt<Params, First, Second, Rest...>
{
    using Here = std::remove_cvref_t<decltype(std::declval<Params&>().*First)>;
    using Next = FieldAt<typename ValueOf<Here>::Type, Second, Rest...>;
    static constexpr bool optional = IsOptional<Here>::value || Next::optional;
    using Type = typename Next::Type;
};

template <auto First, auto... Rest, typename Params>
constexpr double numberAt(const Params& params) noexcept
{
    const auto& field = params.*First;
    if constexpr (sizeof...(Rest) == 0)
        return numberOf(field);
    else if constexpr (IsOptional<std::remove_cvref_t<decltype(field)>>::value)
        return field ? numberAt<Rest...>(*field) : std::numeric_limits<double>::quiet_NaN();
    else
        return numberAt<Rest...>(field);
}

template <auto First, auto... Rest, typename Params>
constexpr void assignAt(Params& params, double value) noexcept
{
    auto& field = params.*First;
    if constexpr (sizeof...(Rest) == 0)
        assignNumber(field, value);
    else if constexpr (IsOptional<std::remove_cvref_t<decltype(field)>>::value)
    {
        if (!field)
            field.emplace();
        assignAt<Rest...>(*field, value);
    }
    else
        assignAt<Rest...>(field, value);
}

template <typename Params, auto... Path>
struct FieldAccess
{
    static constexpr double get(const Params& params) { return numberAt<Path...>(params); }
    static constexpr void set(Params& params, double value) { assignAt<Path...>(params, value); }
    static constexpr double usual() { return get(Params{}); }
    static constexpr double getNegated(const Params& params) { return 1.0 - get(params); }
    static constexpr void setNegated(Params& params, double value) { set(params, 1.0 - value); }
    static constexpr double usualNegated() { return 1.0 - usual(); }
};

} // namespace detail

/// The description `text` of the field at a path of members, such as <&EncoderParams::onsets, &OnsetParams::silence>.
template <auto First, auto... Rest>
[[nodiscard]] constexpr auto described(const ParameterText& text) noexcept
{
    using Params = typename detail::OwnerOf<decltype(First)>::Type;
    using Field = detail::FieldAt<Params, First, Rest...>;
    Parameter<Params> parameter;
    static_cast<ParameterText&>(parameter) = text;
    parameter.kind = detail::kindOf<typename Field::Type>();
    parameter.optional = Field::optional;
    if (parameter.member.empty())
        parameter.member = parameter.name;
    if (parameter.kind == ParameterKind::truth)
        parameter.range = {0.0, 1.0};
    if (parameter.kind == ParameterKind::choice)
        parameter.range = {0.0, static_cast<double>(parameter.choices.size()) - 1.0};
    using Access = detail::FieldAccess<Params, First, Rest...>;
    parameter.get = text.negated ? &Access::getNegated : &Access::get;
    parameter.set = text.negated ? &Access::setNegated : &Access::set;
    parameter.usual = text.negated ? &Access::usualNegated : &Access::usual;
    return parameter;
}

/// The same description for another field, which has a default of its own.
template <auto First, auto... Rest>
[[nodiscard]] constexpr auto describedAs(const ParameterText& text) noexcept
{
    ParameterText own = text;
    own.member = {};
    return described<First, Rest...>(own);
}

/// The description of this name in a table that has it.
template <typename Table>
[[nodiscard]] constexpr const auto& parameterNamed(const Table& table, std::string_view name) noexcept
{
    std::size_t i = 0;
    while (table[i].name != name)
        ++i;
    return table[i];
}

/// The descriptions of a table, without the type of its struct. The table must outlive them.
template <typename Table>
[[nodiscard]] std::vector<const ParameterInfo*> infosOf(const Table& table)
{
    std::vector<const ParameterInfo*> infos;
    for (const ParameterInfo& parameter : table)
        infos.push_back(&parameter);
    return infos;
}

/// A name in words that `between` separates: minimum-gap of minimumGap.
[[nodiscard]] inline std::string separatedName(std::string_view name, char between)
{
    std::string text;
    for (const char c : name)
        if (c >= 'A' && c <= 'Z')
            (text += between) += static_cast<char>(c - 'A' + 'a');
        else
            text += c;
    return text;
}

/// The option of the command: --minimum-gap.
[[nodiscard]] inline std::string optionName(const ParameterInfo& parameter)
{
    return "--" + separatedName(parameter.option.empty() ? parameter.name : parameter.option, '-');
}

/// "1 to 1700 Hz", "log or linear", "true or false".
[[nodiscard]] inline std::string allowedText(const ParameterInfo& parameter)
{
    if (parameter.kind == ParameterKind::truth)
        return "true or false";
    if (parameter.kind == ParameterKind::choice)
    {
        std::string names;
        for (const std::string_view& name : parameter.choices)
            names.append(names.empty() ? "" : &name == &parameter.choices.back() ? " or " : ", ").append(name);
        return names;
    }
    std::string text = numberText(parameter.range.lowest, std::chars_format::fixed) + " to " +
                       numberText(parameter.range.highest, std::chars_format::fixed);
    if (!parameter.unit.empty())
        text.append(" ").append(parameter.unit);
    return text;
}

/// A value as people read and type it: 20, linear, true; empty where nothing is set.
[[nodiscard]] inline std::string valueText(const ParameterInfo& parameter, double value)
{
    if (std::isnan(value))
        return {};
    if (parameter.kind == ParameterKind::truth)
        return value != 0.0 ? "true" : "false";
    if (parameter.kind == ParameterKind::choice)
        return std::string(parameter.choices[static_cast<std::size_t>(value)]);
    return numberText(value, std::chars_format::fixed);
}

/// Errors: invalidArgument at the parameter's name for a value that is not allowed.
[[nodiscard]] inline Result<void> checkValue(const ParameterInfo& parameter, double value)
{
    const bool within = value >= parameter.range.lowest && value <= parameter.range.highest; // not NaN
    const bool whole = parameter.kind == ParameterKind::number || value == std::floor(value);
    if (within && whole)
        return {};
    return Error{ErrorCode::invalidArgument, std::string(parameter.name),
                 (whole ? "must be " : "must be a whole number, ") + allowedText(parameter)};
}

/// Checks the fields of `params` that `table` describes. Errors: those of checkValue().
template <typename Table, typename Params>
[[nodiscard]] Result<void> checkParameters(const Table& table, const Params& params)
{
    for (const auto& parameter : table)
    {
        const double value = parameter.get(params);
        if (parameter.optional && std::isnan(value))
            continue;
        if (auto allowed = checkValue(parameter, value); !allowed)
            return allowed;
    }
    return {};
}

} // namespace pacini
