#include "cli/Terminal.h"

#include <algorithm>
#include <cstdlib>

#if defined(_WIN32)
#include <windows.h>
#else
#include <sys/ioctl.h>
#include <unistd.h>
#endif

namespace pacini::cli::terminal
{

bool canRedraw()
{
#if defined(_WIN32)
    // A console of Windows 10 and later knows escape sequences once it is asked to.
    static const bool watched = []
    {
        const HANDLE console = GetStdHandle(STD_ERROR_HANDLE);
        DWORD mode = 0;
        return GetConsoleMode(console, &mode) != 0 &&
               SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
    }();
#else
    static const bool watched = isatty(STDERR_FILENO) != 0;
#endif
    static const char* kind = std::getenv("TERM");
    return watched && (kind == nullptr || std::string_view(kind) != "dumb");
}

std::size_t columns()
{
#if defined(_WIN32)
    CONSOLE_SCREEN_BUFFER_INFO size{};
    if (GetConsoleScreenBufferInfo(GetStdHandle(STD_ERROR_HANDLE), &size) != 0)
        return static_cast<std::size_t>(size.srWindow.Right - size.srWindow.Left + 1);
#else
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
#endif
    return 80;
}

std::size_t textWidth()
{
    return std::clamp<std::size_t>(columns(), 60, 100);
}

std::string cutToWidth(std::string_view text, std::size_t columns)
{
    std::size_t used = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte & 0xC0u) == 0x80u)
            continue; // belongs to the character before
        used += byte < 0x80 ? 1 : 2;
        if (used > columns)
            return std::string(text.substr(0, i));
    }
    return std::string(text);
}

} // namespace pacini::cli::terminal
