#pragma once

// Overwriting rules of the steps of `pacini texture`, whose output is always named.

#include "cli/Console.h"
#include "cli/Overwrite.h"

#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// Whether `output` may be written: none if so, else what the command ends with, which has been said. Inputs are never
/// written over.
[[nodiscard]] inline std::optional<Exit> checkTextureOutput(Console& console, const std::string& output,
                                                            const std::vector<std::string>& inputs,
                                                            const OverwriteOptions& overwriting)
{
    for (const std::string& input : inputs)
        if (!isStandardOutput(output) && !isStream(input) && isSameFile(output, input))
            return console.fail(input, {ErrorCode::invalidArgument, "", alsoInput});
    if (overwriting.keeps(console, {output}))
        return Exit::ok;
    if (isStandardOutput(output))
        console.keepStdoutFree();
    return std::nullopt;
}

} // namespace pacini::cli
