#pragma once

// Names of C++ as C and Python have them.

#include <algorithm>
#include <string>
#include <string_view>

namespace pacini
{

/// `name` in snake case, `max_plays` for `maxPlays`, if it is a plain name in camel case; else as it is. A path such as
/// `bands[2].lowFrequency` is one of a file, whose keys stay as the file has them.
[[nodiscard]] inline std::string snakeCase(std::string_view name)
{
    const auto isLetter = [](char c)
    {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    };
    if (!std::all_of(name.begin(), name.end(), isLetter))
        return std::string(name);
    std::string snake;
    for (const char c : name)
    {
        const bool isLarge = c >= 'A' && c <= 'Z';
        if (isLarge && !snake.empty())
            snake += '_';
        snake += isLarge ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return snake;
}

} // namespace pacini
