#pragma once

// Numbers with their noun in the singular or the plural, for messages.

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace pacini::cli
{

/// "1 play" or "3 plays".
[[nodiscard]] inline std::string counted(std::size_t count, std::string_view one, std::string_view several)
{
    return fmt::format("{} {}", count, count == 1 ? one : several);
}

} // namespace pacini::cli
