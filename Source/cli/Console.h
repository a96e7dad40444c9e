#pragma once

// What the command line says, and where: results on stdout, messages and progress on stderr.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

namespace pacini::cli
{

/// Exit codes of the command.
enum class Exit
{
    ok = 0,
    failed = 1, ///< something was wrong with the input or the output
    usage = 2,  ///< something was wrong with the command line
};

/// Writes whole lines from any thread. A progress line, if one stands on the terminal, gives way to messages.
class Console
{
public:
    /// A line on stdout.
    void print(std::string_view line);

    /// `pacini: FILE: where: what` on stderr; `file` may be empty.
    void error(std::string_view file, const Error& error);

    /// `pacini: FILE: warning: what` on stderr.
    void warning(std::string_view file, std::string_view what);

    /// Shows `done` of `total` (0-1 each share) with a text, on a terminal only; at most ten times a second.
    void progress(double share, std::string_view text);

    /// Removes the progress line.
    void endProgress();

    /// True when stderr is a terminal.
    [[nodiscard]] static bool isTerminal();

private:
    void clearLine();

    std::mutex mutex;
    bool lineShown = false;
    double lastShown = -1.0;
};

/// A size such as "412 B" or "1.3 kB".
[[nodiscard]] std::string bytesText(double bytes);

/// A duration such as "0.52 s" or "12:03 min".
[[nodiscard]] std::string durationText(double seconds);

} // namespace pacini::cli
