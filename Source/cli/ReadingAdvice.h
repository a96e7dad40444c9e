#pragma once

// Advice in error messages about damaged sounds: the option that reads them as they are.

#include <pacini/foundation/Result.h>

namespace pacini::cli
{

/// The error of reading a sound, with the option that takes the sound as it is; --allow-nan if the command has it.
[[nodiscard]] inline Error withAdvice(Error error, bool hasAllowNan)
{
    if (error.code == ErrorCode::truncated)
        error.message += ", or use the remaining part with --allow-truncated";
    if (error.code == ErrorCode::notFinite && hasAllowNan)
        error.message += ", or replace such samples by 0 with --allow-nan";
    return error;
}

} // namespace pacini::cli
