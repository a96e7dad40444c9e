// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/ParameterText.h"

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/NumberText.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pacini::plugin
{

namespace
{
/// The power that brings `centre` into the middle of the way.
double bend(const ParameterRow& row) noexcept
{
    if (row.centre == 0.0)
        return 1.0;
    return std::log(0.5) / std::log((row.centre - row.low) / (row.high - row.low));
}

/// Text with a fixed number of decimals; halves are rounded away from zero.
std::string decimals(double value, int count)
{
    const double unit = std::pow(10.0, count);
    return decimalText(std::round(value * unit) / unit, count);
}

std::string lowerCase(std::string_view text)
{
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// A number and its unit.
struct Measured
{
    double number = 0.0;
    std::string unit;
};

std::optional<Measured> measured(std::string_view text)
{
    constexpr std::string_view minusSign = "\xE2\x88\x92";
    std::string plain;
    if (text.starts_with(minusSign))
    {
        plain.push_back('-');
        text.remove_prefix(minusSign.size());
    }
    plain.append(text);
    std::replace(plain.begin(), plain.end(), ',', '.');
    const auto end = plain.find_first_not_of("+-.0123456789");
    std::istringstream in(plain.substr(0, end));
    in.imbue(std::locale::classic());
    Measured result;
    if (!(in >> result.number) || !in.eof())
        return std::nullopt;
    if (end != std::string::npos)
        result.unit = lowerCase(trimmed(std::string_view(plain).substr(end)));
    return result;
}

std::optional<double> choiceOf(const ParameterRow& row, const std::string& text)
{
    for (std::size_t i = 0; i < row.choices.size(); ++i)
        if (lowerCase(row.choices[i]) == text)
            return static_cast<double>(i);
    for (std::size_t i = 0; i < row.choices.size(); ++i)
        if (lowerCase(row.choices[i]).starts_with(text))
            return static_cast<double>(i);
    return std::nullopt;
}
} // namespace

double normalOf(const ParameterRow& row, double value) noexcept
{
    double limited = clampTo(value, row.low, row.high);
    if (isDiscrete(row))
        limited = std::round(limited);
    const double share = (limited - row.low) / (row.high - row.low);
    return row.centre == 0.0 ? share : std::pow(share, bend(row));
}

double valueAt(const ParameterRow& row, double normal) noexcept
{
    const double place = clampTo(normal, 0.0, 1.0);
    const double share = row.centre == 0.0 ? place : std::pow(place, 1.0 / bend(row));
    const double value = row.low + share * (row.high - row.low);
    return isDiscrete(row) ? std::round(value) : value;
}

std::string textOf(const ParameterRow& row, double value)
{
    const double limited = clampTo(value, row.low, row.high);
    switch (row.unit)
    {
    case ParameterUnit::decibels:
        return decimals(limited, 1) + " dB";
    case ParameterUnit::semitones:
        return decimals(limited, 2) + " st";
    case ParameterUnit::milliseconds:
        return decimals(limited, limited < 9.995 ? 2 : (limited < 99.95 ? 1 : 0)) + " ms";
    case ParameterUnit::percent:
        return decimals(100.0 * limited, 0) + " %";
    case ParameterUnit::number:
        return decimals(limited, 0);
    case ParameterUnit::choice:
        return std::string(row.choices[static_cast<std::size_t>(std::lround(limited))]);
    case ParameterUnit::toggle:
        return limited >= 0.5 ? "On" : "Off";
    }
    return {};
}

std::optional<double> valueOf(const ParameterRow& row, std::string_view text)
{
    const std::string word = lowerCase(trimmed(text));
    if (word.empty())
        return std::nullopt;
    const auto inRange = [&row](double typed)
    {
        const double value = isDiscrete(row) ? std::round(typed) : typed;
        return value >= row.low && value <= row.high ? std::optional(value) : std::nullopt;
    };
    if (row.unit == ParameterUnit::choice)
        if (const auto choice = choiceOf(row, word))
            return choice;
    if (row.unit == ParameterUnit::toggle)
    {
        constexpr std::array<std::string_view, 3> yes{"on", "yes", "true"};
        constexpr std::array<std::string_view, 3> no{"off", "no", "false"};
        if (std::find(yes.begin(), yes.end(), word) != yes.end())
            return 1.0;
        if (std::find(no.begin(), no.end(), word) != no.end())
            return 0.0;
    }
    if (row.unit == ParameterUnit::decibels && (word.starts_with("-inf") || word == "-\xE2\x88\x9E"))
        return row.low;
    const auto typed = measured(word);
    if (!typed)
        return std::nullopt;
    const auto& [number, unit] = *typed;
    switch (row.unit)
    {
    case ParameterUnit::decibels:
        return unit.empty() || unit == "db" ? inRange(number) : std::nullopt;
    case ParameterUnit::semitones:
        return unit.empty() || unit == "st" || unit.starts_with("semi") ? inRange(number) : std::nullopt;
    case ParameterUnit::milliseconds:
        if (unit == "s")
            return inRange(1000.0 * number);
        return unit.empty() || unit == "ms" ? inRange(number) : std::nullopt;
    case ParameterUnit::percent:
        return unit.empty() || unit == "%" ? inRange(0.01 * number) : std::nullopt;
    case ParameterUnit::number:
    case ParameterUnit::choice:
    case ParameterUnit::toggle:
        return unit.empty() ? inRange(number) : std::nullopt;
    }
    return std::nullopt;
}

} // namespace pacini::plugin
