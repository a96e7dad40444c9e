// std::to_chars() of a double in the forms that Pacini calls, which the C++ library makes with tables of 100 kB. These
// are linked before it and give the same text: as few digits as read back as the number, or as many as are asked for.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <system_error>

namespace
{
/// Digits d and exponent e as 0.ddd, ddd000, d.dd or d.dde+ee: the shortest, without an exponent if that is as short or
/// `isFixed`.
std::string textOf(double value, bool isFixed)
{
    if (!std::isfinite(value))
        return std::isnan(value) ? "nan" : value < 0.0 ? "-inf" : "inf";
    std::string sign = std::signbit(value) ? "-" : "";
    const double size = std::fabs(value);
    if (size == 0.0)
        return sign + "0";
    constexpr double exactBelow = 18446744073709551616.0; // 2^64: larger ones are shorter with an exponent
    const auto decimal = fmt::detail::dragonbox::to_decimal(size);
    const std::string digits = fmt::to_string(decimal.significand);
    const auto count = static_cast<int>(digits.size());
    const int exponent = decimal.exponent + count - 1;
    std::string scientific = digits.substr(0, 1);
    if (count > 1)
        scientific += "." + digits.substr(1);
    scientific += fmt::format("e{}{:02}", exponent < 0 ? '-' : '+', std::abs(exponent));
    std::string fixed;
    if (exponent < 0)
        fixed = "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
    else if (exponent + 1 < count)
        fixed = digits.substr(0, static_cast<std::size_t>(exponent) + 1) + "." +
                digits.substr(static_cast<std::size_t>(exponent) + 1);
    else if (size < exactBelow)
        fixed = fmt::to_string(static_cast<std::uint64_t>(size)); // a whole number has all its digits
    else if (isFixed)
        fixed = fmt::format("{:.0f}", size);
    else
        return sign + scientific;
    return sign + (isFixed || fixed.size() <= scientific.size() ? fixed : scientific);
}

std::to_chars_result put(const std::string& text, char* first, char* last)
{
    if (static_cast<std::size_t>(last - first) < text.size())
        return {last, std::errc::value_too_large};
    return {std::copy(text.begin(), text.end(), first), std::errc()};
}
} // namespace

_LIBCPP_BEGIN_NAMESPACE_STD
to_chars_result to_chars(char* first, char* last, double value)
{
    return put(textOf(value, false), first, last);
}

to_chars_result to_chars(char* first, char* last, double value, chars_format form)
{
    return put(textOf(value, form == chars_format::fixed), first, last);
}

to_chars_result to_chars(char* first, char* last, double value, chars_format form, int digits)
{
    return put(form == chars_format::fixed ? fmt::format("{:.{}f}", value, digits)
                                           : fmt::format("{:.{}g}", value, digits),
               first, last);
}
_LIBCPP_END_NAMESPACE_STD
