#pragma once

// Options of the overwrite policy (see io/Overwrite.h), and errors for files that are not replaced.
//
// A file that -o names is replaced, unless it is one of the inputs or their source. -n keeps all existing files, -y
// replaces them.

#include "io/Overwrite.h"

#include <pacini/foundation/Result.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <initializer_list>
#include <string>

namespace pacini::cli
{

class Console;

/// The error of an output that is the input.
inline constexpr const char* alsoInput = "is also the input; choose another output with -o";

/// -n and -y, declared once per command.
class OverwriteOptions
{
public:
    void declare(CLI::App& command);

    [[nodiscard]] bool keepsAll() const noexcept { return keep; }

    /// Whether one of `outputs` (empty names aside) exists and is kept, which is said.
    [[nodiscard]] bool keeps(Console& console, std::initializer_list<std::filesystem::path> outputs) const;
    [[nodiscard]] bool replacesAll() const noexcept { return replace; }

    /// For a file that the user named, or did not.
    [[nodiscard]] Replaceable of(bool named) const noexcept;

private:
    bool keep = false;
    bool replace = false;
};

/// Returns the reason why the file at `output` is not replaced: "exists and `reason`; ...", with advice.
[[nodiscard]] Error notReplaced(const std::filesystem::path& output, const std::string& reason);

/// Checks that a stream such as standard output gets at most one file. Errors: invalidArgument, with advice.
[[nodiscard]] Result<void> checkStream(const std::filesystem::path& output, const ExportedClip& exported);

/// See mayOverwrite(); the error also suggests a remedy.
template <typename Made>
[[nodiscard]] Result<Existing> mayReplace(const std::filesystem::path& output, const Made& made, Replaceable allowed)
{
    auto answer = mayOverwrite(output, made, allowed);
    return answer ? answer : notReplaced(answer.error().where, answer.error().message);
}

} // namespace pacini::cli
