#pragma once

// What option values must be. Like CLI::Range, but NaN is refused and the messages read well.

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>

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

/// A whole number of 64 bits; a minus sign, which unsigned types would wrap around, is refused.
[[nodiscard]] inline CLI::Validator countingNumber()
{
    const auto range = fmt::format("0 to {}", std::numeric_limits<std::uint64_t>::max());
    return CLI::Validator(
        [=](std::string& text)
        {
            std::uint64_t value = 0;
            const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool good = failure == std::errc() && end == text.data() + text.size();
            return good ? std::string() : fmt::format("{} is not a whole number from {}", text, range);
        },
        range);
}

} // namespace pacini::cli
