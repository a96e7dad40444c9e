#pragma once

// Number to text.

#include <array>
#include <charconv>
#include <string>

namespace pacini
{

/// A number as text, whatever the locale: the shortest that reads back as the number, or as std::to_chars() writes it
/// with these forms (a std::chars_format, and digits).
template <typename... Forms>
[[nodiscard]] std::string numberText(double value, Forms... forms)
{
    std::array<char, 400> text; // 309 digits and the decimals
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, forms...).ptr};
}

/// Returns a number with the given number of decimals. Numbers that round to zero have no sign, so never "-0.0".
[[nodiscard]] inline std::string decimalText(double value, int decimals)
{
    std::string text = numberText(value, std::chars_format::fixed, decimals);
    if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos)
        text.erase(0, 1);
    return text;
}

/// The same without needless zeros.
[[nodiscard]] inline std::string shortDecimalText(double value, int decimals)
{
    std::string text = decimalText(value, decimals);
    if (text.find('.') != std::string::npos)
        text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
        text.pop_back();
    return text;
}

} // namespace pacini
