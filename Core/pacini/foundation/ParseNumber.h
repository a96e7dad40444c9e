#pragma once

// Text to number, the same in every locale.

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace pacini
{

namespace detail
{

template <typename Number>
concept HasFromChars = requires(const char* text, Number& number)
{
    std::from_chars(text, text, number);
};

/// std::from_chars for a whole text, by std::strtod. std::strtod expects the decimal point of the process's locale, so
/// it gets the digits without a point and with an exponent.
inline std::optional<double> parseByStrtod(std::string_view text)
{
    const bool negative = text.starts_with('-');
    std::string_view rest = text.substr(negative ? 1 : 0);
    if (rest == "inf" || rest == "nan")
        return std::strtod(std::string(text).c_str(), nullptr);

    std::string digits;
    std::int64_t exponent = 0;
    for (bool behindPoint = false; !rest.empty(); rest.remove_prefix(1))
        if (rest.front() >= '0' && rest.front() <= '9')
        {
            digits += rest.front();
            exponent -= behindPoint ? 1 : 0;
        }
        else if (rest.front() == '.' && !behindPoint)
            behindPoint = true;
        else
            break;
    if (digits.empty())
        return std::nullopt;
    if (!rest.empty())
    {
        const std::size_t begin = rest.substr(1).starts_with('+') && !rest.substr(2).starts_with('-') ? 2 : 1;
        int written = 0;
        const auto [end, failure] = std::from_chars(rest.data() + begin, rest.data() + rest.size(), written);
        if ((rest.front() != 'e' && rest.front() != 'E') || failure != std::errc() || end != rest.data() + rest.size())
            return std::nullopt;
        exponent += written;
    }
    const double size = std::strtod((digits + 'e' + std::to_string(exponent)).c_str(), nullptr);
    const bool tooSmall = size == 0.0 && digits.find_first_not_of('0') != std::string::npos;
    if (std::isinf(size) || tooSmall)
        return std::nullopt;
    return negative ? -size : size;
}

} // namespace detail

/// Parses the whole text as a number: digits with an optional minus sign, point and exponent, or "inf" or "nan";
/// returns nothing for other text and for numbers beyond the range of a double.
template <typename Number = double>
[[nodiscard]] std::optional<Number> parseNumber(std::string_view text)
{
    // The library of Clang has it for whole numbers only before version 20.
    if constexpr (detail::HasFromChars<Number>)
    {
        Number number{};
        const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
        return failure == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
    }
    else
        return detail::parseByStrtod(text);
}

} // namespace pacini
