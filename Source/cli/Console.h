#pragma once

// Output of the command line: results on stdout, messages and progress on stderr; with --json one object on stdout and
// no other text.

#include "cli/JsonReport.h"

#include <pacini/foundation/NumberText.h>
#include <pacini/foundation/Result.h>

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace fs = std::filesystem;

/// Exit codes of the command.
enum class Exit
{
    ok = 0,
    failed = 1, ///< something was wrong with the input or the output
    usage = 2,  ///< something was wrong with the command line
};

/// Writes whole lines from any thread. Messages replace the progress line on a terminal. No colours; a screen reader
/// gets whole lines, and progress only where a terminal is watched.
class Console
{
public:
    /// No notes and no progress from now on; results, warnings and errors stay.
    void beQuiet() { quiet = true; }

    /// Clips, scenes and profiles with keys that are not known are to be refused.
    void beStrict() { strict = true; }
    [[nodiscard]] bool isStrict() const { return strict; }

    /// Collects everything for one JSON object from now on; no text goes to stdout.
    void beJson(std::string command) { report.emplace(std::move(command)); }

    /// Whether text would not be seen, as a program asked.
    [[nodiscard]] bool isJson() const { return report.has_value(); }

    /// Members of the JSON object; nothing unless one is wanted.
    void addToReport(const JsonReport::Json& members);

    /// Prints the JSON object, if one is wanted; nothing may follow.
    void endReport(bool ok);

    /// Standard output takes a result of another kind: notes go to stderr from now on.
    void keepStdoutFree() { stdoutFree = true; }

    /// A result for people: a line on stdout.
    void print(std::string_view line);

    /// A text that is the whole result: printed, or the report's `text`.
    Exit printText(const std::string& text);

    /// Prints a line on stdout about finished work, for people.
    void note(std::string_view line);

    /// Notes that the file at `path` was written, and `details` of it.
    void wrote(const std::filesystem::path& path, std::string_view details = "");

    /// Notes that the file at `path` exists and was kept.
    void kept(const std::filesystem::path& path);

    /// `pacini: FILE: where: what` on stderr, always one line; `file` may be empty.
    void error(std::string_view file, const Error& error);

    /// The same as the last thing that a command does: gives `exit`.
    [[nodiscard]] Exit fail(std::string_view file, const Error& reason, Exit exit = Exit::failed);

    /// Reports an error that was already printed for another file: only the JSON report names this file too.
    void repeatedError(std::string_view file, const Error& error);

    /// `pacini: FILE: warning: what` on stderr, always one line.
    void warning(std::string_view file, std::string_view what);

    /// Each of them as a warning.
    void warnings(std::string_view file, const std::vector<std::string>& all);

    /// Shows the `share` that is done (0 to 1) with a text, on a terminal only: first after half a second, then at
    /// most twice a second.
    void progress(double share, std::string_view text);

    /// Shows a line of the same kind with something that has no end, such as a level; at most ten times a second.
    void status(std::string_view line);

    /// Removes the progress line.
    void endProgress();

    /// Why something could not be printed on stdout, if so.
    [[nodiscard]] std::optional<Error> printFailure();

private:
    void put(std::string_view line);
    void message(std::string_view line);
    void clearLine();
    [[nodiscard]] bool isDue(double delay, double interval);
    void showLine(std::string_view line);

    std::mutex mutex;
    std::optional<JsonReport> report;
    bool quiet = false;
    bool strict = false;
    bool stdoutFree = false;
    bool lineShown = false;
    double nextProgress = -1.0; ///< s of the steady clock; negative before the first call
    int printErrno = 0;
};

/// `text` on one line of a terminal: control characters, which a file's name may hold, as \n or \x1b.
[[nodiscard]] std::string printable(std::string_view text);

/// decimalText() with a plus sign for numbers above zero: a difference.
[[nodiscard]] std::string signedText(double value, int decimals);

/// A size such as "412 B" or "1.3 kB".
[[nodiscard]] std::string bytesText(double bytes);

/// A duration such as "0.52 s" or "12:03 min".
[[nodiscard]] std::string durationText(double seconds);

} // namespace pacini::cli
