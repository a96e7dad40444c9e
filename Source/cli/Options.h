#pragma once

// Declaration of options, and validators of their values. The validators are like those of CLI11, but NaN is refused,
// the nearest name is suggested, and the messages read well.

#include "io/NearestName.h"

#include <pacini/foundation/ParseNumber.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

/// Accepts a number from `lowest` to `highest`; never NaN. `comment` explains the range, such as "24 h" for 86400
/// seconds.
[[nodiscard]] inline CLI::Validator numberFrom(double lowest, double highest, const std::string& comment = "")
{
    const auto range = fmt::format("{} to {}{}", lowest, highest, comment.empty() ? "" : " = " + comment);
    return CLI::Validator(
        [=](std::string& text)
        {
            double value = 0.0;
            const bool good =
                CLI::detail::lexical_cast(text, value) && value >= lowest && value <= highest; // false for NaN
            return good ? std::string() : fmt::format("'{}' is not a number from {}", text, range);
        },
        range);
}

/// A whole number; a minus sign, which unsigned types would wrap around, is refused unless `lowest` has one.
template <typename Integer>
[[nodiscard]] CLI::Validator wholeNumberFrom(Integer lowest, Integer highest, std::string range = "")
{
    if (range.empty())
        range = fmt::format("{} to {}", lowest, highest);
    return CLI::Validator(
        [=](std::string& text)
        {
            const auto value = parseNumber<Integer>(text);
            return value && *value >= lowest && *value <= highest
                       ? std::string()
                       : fmt::format("'{}' is not a whole number from {}", text, range);
        },
        range);
}

/// Any whole number of 64 bits.
[[nodiscard]] inline CLI::Validator countingNumber()
{
    return wholeNumberFrom(std::uint64_t(0), std::numeric_limits<std::uint64_t>::max(), "0 to 2^64 - 1");
}

/// Accepts one of these names; for others, the error names the nearest.
[[nodiscard]] inline CLI::Validator oneOf(std::vector<std::string> names)
{
    auto set = fmt::format("{{{}}}", fmt::join(names, ","));
    return CLI::Validator(
        [names = std::move(names)](std::string& text)
        {
            for (const std::string& name : names)
                if (text == name)
                    return std::string();
            const std::string meant = meantText(text, names);
            return fmt::format("'{}' is not one of {}{}", text, fmt::join(names, ", "), meant);
        },
        std::move(set));
}

/// One of the names of `choices`, with others before them.
template <typename Choices>
[[nodiscard]] CLI::Validator oneOf(const Choices& choices, std::same_as<const char*> auto... before)
{
    std::vector<std::string> names{before...};
    for (const auto& choice : choices)
        names.emplace_back(choice.name);
    return oneOf(std::move(names));
}

/// Adds an option to `command`. Help texts show `valueName` for its value.
template <typename T>
CLI::Option* addOption(CLI::App& command, const std::string& names, T& value, const std::string& description,
                       const std::string& valueName)
{
    return command.add_option(names, value, description)->type_name(valueName);
}

/// The same for values that `check` takes; without a `valueName` help texts show the type.
template <typename T>
CLI::Option* addOption(CLI::App& command, const std::string& names, T& value, const std::string& description,
                       const CLI::Validator& check, const std::string& valueName = "")
{
    auto* option = command.add_option(names, value, description)->check(check);
    return valueName.empty() ? option : option->type_name(valueName);
}

/// Like addOption(), for a `value` that is the default and is shown in help texts.
template <typename T, typename... More>
CLI::Option* addPreset(CLI::App& command, const std::string& names, T& value, const std::string& description,
                       const More&... more)
{
    return addOption(command, names, value, description, more...)->capture_default_str();
}

} // namespace pacini::cli
