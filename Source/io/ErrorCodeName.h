#pragma once

// Names of error codes, as other languages know them.

#include <pacini/foundation/Result.h>

#include <string_view>

namespace pacini
{

[[nodiscard]] constexpr std::string_view errorCodeName(ErrorCode code) noexcept
{
    switch (code)
    {
    case ErrorCode::invalidArgument:
        return "invalidArgument";
    case ErrorCode::invalidData:
        return "invalidData";
    case ErrorCode::unsupportedVersion:
        return "unsupportedVersion";
    case ErrorCode::truncated:
        return "truncated";
    case ErrorCode::notFinite:
        return "notFinite";
    case ErrorCode::tooLarge:
        return "tooLarge";
    case ErrorCode::io:
        return "io";
    case ErrorCode::diskFull:
        return "diskFull";
    case ErrorCode::cancelled:
        return "cancelled";
    }
    return "invalidData";
}

} // namespace pacini
