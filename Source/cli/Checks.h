#pragma once

// What option values must be. Like CLI::Range, but NaN is refused and the messages read well.

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace pacini::cli
{

/// A number from `lowest` to `highest`; never NaN.
[[nodiscard]] inline CLI::Validator numberFrom(double lowest, double highest)
{
    const auto range = fmt::format("{} to {}", lowest, highest);
    return CLI::Validator(
        [=](std::string& text)
        {
            double value = 0.0;
            const bool good =
                CLI::detail::lexical_cast(text, value) && value >= lowest && value <= highest; // false for NaN
            return good ? std::string() : fmt::format("{} is not a number from {}", text, range);
        },
        range);
}

/// A whole number of 0 or more; a minus sign, which unsigned types would wrap around, is refused.
[[nodiscard]] inline CLI::Validator countingNumber()
{
    return CLI::Validator(
        [](std::string& text)
        {
            const bool good = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
            return good ? std::string() : fmt::format("{} is not a whole number of 0 or more", text);
        },
        "0 or more");
}

} // namespace pacini::cli
