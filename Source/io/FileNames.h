#pragma once

// Names of the user's own things as names of files, on all systems.

#include <pacini/foundation/Result.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pacini
{

/// Names that are devices in Windows, whatever their ending.
[[nodiscard]] inline bool isDeviceName(std::string_view name)
{
    std::string upper(name.substr(0, name.find('.')));
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
    constexpr std::array<std::string_view, 4> names{"CON", "PRN", "AUX", "NUL"};
    const bool numbered = upper.size() == 4 && (upper.starts_with("COM") || upper.starts_with("LPT"));
    return numbered || std::find(names.begin(), names.end(), upper) != names.end();
}

/// Why a preset cannot be called so, as its name is that of its file: empty, longer than `longest` bytes, or not
/// allowed for files by all systems. None: it can.
[[nodiscard]] inline std::optional<Error> presetNameDefect(std::string_view name, std::size_t longest)
{
    const auto defect = [&name](const char* what)
    {
        return Error{ErrorCode::invalidArgument, std::string(name), what};
    };
    if (name.empty())
        return defect("is no name for a preset");
    if (name.size() > longest)
        return defect("is too long for a preset's name");
    const bool hasOthers = std::any_of(name.begin(), name.end(),
                                       [](char c)
                                       {
                                           constexpr std::string_view reserved = "<>:\"/\\|?*";
                                           return static_cast<unsigned char>(c) < 0x20 || c == 0x7f ||
                                                  reserved.find(c) != std::string_view::npos;
                                       });
    if (hasOthers || name.front() == '.' || name.front() == ' ' || name.back() == '.' || name.back() == ' ' ||
        isDeviceName(name))
        return defect("cannot be the name of a file");
    return std::nullopt;
}

} // namespace pacini
