#pragma once

// Names of error codes, as other languages know them.

#include <pacini/foundation/Result.h>

#include <array>
#include <cstddef>
#include <string_view>

namespace pacini
{

[[nodiscard]] constexpr std::string_view errorCodeName(ErrorCode code) noexcept
{
    constexpr std::array<std::string_view, 9> names{
        "invalidArgument", "invalidData", "unsupportedVersion", "truncated", "notFinite",
        "tooLarge",        "io",          "diskFull",           "cancelled"};
    static_assert(names.size() == static_cast<std::size_t>(ErrorCode::cancelled) + 1);
    return names[static_cast<std::size_t>(code)];
}

} // namespace pacini
