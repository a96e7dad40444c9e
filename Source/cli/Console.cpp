#include "cli/Console.h"

#include "cli/Terminal.h"
#include "io/FileHandle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace pacini::cli
{

namespace
{
// What a stream refuses must not end the work on the files.
void write(std::FILE* stream, std::string_view text)
{
    std::fwrite(text.data(), 1, text.size(), stream);
}
} // namespace

void Console::addToReport(const JsonReport::Json& members)
{
    const std::lock_guard lock(mutex);
    if (report)
        report->add(members);
}

void Console::endReport(bool ok)
{
    const std::lock_guard lock(mutex);
    if (report)
        put(report->text(ok));
}

void Console::print(std::string_view line)
{
    const std::lock_guard lock(mutex);
    if (!report)
        put(line);
}

Exit Console::printText(const std::string& text)
{
    addToReport({{"text", text}});
    print(text);
    return Exit::ok;
}

void Console::put(std::string_view line)
{
    clearLine();
    errno = 0;
    write(stdout, fmt::format("{}\n", line));
    if ((std::fflush(stdout) != 0 || std::ferror(stdout) != 0) && printErrno == 0)
        printErrno = errno != 0 ? errno : EIO;
}

void Console::note(std::string_view line)
{
    if (quiet)
        return;
    if (!stdoutFree)
        return print(line);
    const std::lock_guard lock(mutex);
    clearLine();
    write(stderr, fmt::format("{}\n", line));
}

void Console::wrote(const std::filesystem::path& path, std::string_view details)
{
    if (const std::lock_guard lock(mutex); report)
        report->addWritten(path);
    if (path == "-")
        return;
    note(fmt::format("wrote {}{}{}", printable(path.string()), details.empty() ? "" : ": ", details));
}

void Console::kept(const std::filesystem::path& path)
{
    note(printable(path.string()) + " exists and was kept");
}

void Console::error(std::string_view file, const Error& error)
{
    if (const std::lock_guard lock(mutex); report)
        report->addFailure(file, error);
    message(file.empty() ? error.text() : fmt::format("{}: {}", file, error.text()));
}

Exit Console::fail(std::string_view file, const Error& reason, Exit exit)
{
    error(file, reason);
    return exit;
}

void Console::repeatedError(std::string_view file, const Error& error)
{
    const std::lock_guard lock(mutex);
    if (report)
        report->addFailure(file, error);
}

void Console::warning(std::string_view file, std::string_view what)
{
    if (const std::lock_guard lock(mutex); report)
        report->addWarning(file, what);
    message(file.empty() ? fmt::format("warning: {}", what) : fmt::format("{}: warning: {}", file, what));
}

void Console::warnings(std::string_view file, const std::vector<std::string>& all)
{
    for (const std::string& what : all)
        warning(file, what);
}

void Console::message(std::string_view line)
{
    const std::lock_guard lock(mutex);
    clearLine();
    write(stderr, fmt::format("pacini: {}\n", printable(line)));
}

void Console::progress(double share, std::string_view text)
{
    if (quiet || !terminal::canRedraw())
        return;
    const std::lock_guard lock(mutex);
    if (!isDue(0.5, 0.5))
        return;
    constexpr int width = 30;
    const double done = std::clamp(share, 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(std::lround(done * width));
    const auto bar = fmt::format("[{}{}] {:3.0f} %  {}", std::string(filled, '#'), std::string(width - filled, '-'),
                                 100.0 * done, printable(text));
    showLine(bar);
}

void Console::status(std::string_view line)
{
    if (quiet || !terminal::canRedraw())
        return;
    const std::lock_guard lock(mutex);
    if (isDue(0.0, 0.1))
        showLine(printable(line));
}

bool Console::isDue(double delay, double interval)
{
    const double now = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    if (nextProgress < 0.0)
        nextProgress = now + delay;
    if (now < nextProgress)
        return false;
    nextProgress = now + interval;
    return true;
}

void Console::showLine(std::string_view line)
{
    // A line that wraps could not be taken back.
    write(stderr, "\r\x1b[K" + terminal::cutToWidth(line, terminal::columns() - 1));
    std::fflush(stderr);
    lineShown = true;
}

void Console::endProgress()
{
    const std::lock_guard lock(mutex);
    clearLine();
}

std::optional<Error> Console::printFailure()
{
    const std::lock_guard lock(mutex);
    if (printErrno == 0)
        return {};
    if (printErrno == EBADF)
        return Error{ErrorCode::io, "", "is closed; open it or send it to a file"};
    return fileError(printErrno);
}

void Console::clearLine()
{
    if (!lineShown)
        return;
    write(stderr, "\r\x1b[K");
    std::fflush(stderr);
    lineShown = false;
}

std::string printable(std::string_view text)
{
    std::string shown;
    for (const char c : text)
    {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\n')
            shown += "\\n";
        else if (byte < 0x20 || byte == 0x7F)
            shown += fmt::format("\\x{:02x}", byte);
        else
            shown += c;
    }
    return shown;
}

std::string signedText(double value, int decimals)
{
    const std::string text = decimalText(value, decimals);
    return text.find_first_of("123456789") == std::string::npos || text.starts_with('-') ? text : "+" + text;
}

std::string bytesText(double bytes)
{
    if (bytes < 1000.0)
        return fmt::format("{:.0f} B", bytes);
    if (bytes < 1e6)
        return fmt::format("{:.1f} kB", bytes / 1e3);
    return fmt::format("{:.1f} MB", bytes / 1e6);
}

std::string durationText(double seconds)
{
    if (seconds < 120.0)
        return fmt::format("{:.2f} s", seconds);
    const auto whole = static_cast<long long>(std::llround(seconds));
    return fmt::format("{}:{:02} min", whole / 60, whole % 60);
}

} // namespace pacini::cli
