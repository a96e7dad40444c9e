#include "cli/Console.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace pacini::cli
{

void Console::print(std::string_view line)
{
    const std::lock_guard lock(mutex);
    clearLine();
    fmt::print(stdout, "{}\n", line);
    std::fflush(stdout);
}

void Console::error(std::string_view file, const Error& error)
{
    const std::lock_guard lock(mutex);
    clearLine();
    if (file.empty())
        fmt::print(stderr, "pacini: {}\n", error.text());
    else
        fmt::print(stderr, "pacini: {}: {}\n", file, error.text());
}

void Console::warning(std::string_view file, std::string_view what)
{
    const std::lock_guard lock(mutex);
    clearLine();
    fmt::print(stderr, "pacini: {}: warning: {}\n", file, what);
}

void Console::progress(double share, std::string_view text)
{
    if (!isTerminal())
        return;
    const std::lock_guard lock(mutex);
    const double now = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    if (lineShown && now - lastShown < 0.1 && share < 1.0)
        return;
    lastShown = now;
    constexpr int width = 30;
    const int filled = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * width));
    fmt::print(stderr, "\r\x1b[K[{}{}] {:3.0f} %  {}", std::string(static_cast<std::size_t>(filled), '#'),
               std::string(static_cast<std::size_t>(width - filled), '-'), 100.0 * std::clamp(share, 0.0, 1.0), text);
    std::fflush(stderr);
    lineShown = true;
}

void Console::endProgress()
{
    const std::lock_guard lock(mutex);
    clearLine();
}

bool Console::isTerminal()
{
#if defined(_WIN32)
    return _isatty(_fileno(stderr)) != 0;
#else
    return isatty(STDERR_FILENO) != 0;
#endif
}

void Console::clearLine()
{
    if (!lineShown)
        return;
    fmt::print(stderr, "\r\x1b[K");
    lineShown = false;
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
