#include "cli/Process.h"

#include "io/SoundLibraryCall.h"
#include "io/TemporaryFiles.h"

#include <cstdio>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>

#include <cstdlib>
#include <string>

// clang-format off
#include <windows.h>
#include <shellapi.h> // needs the former
// clang-format on
#else
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>
#endif

namespace pacini::cli
{

#if defined(_WIN32)
namespace
{
UINT formerCodePage = 0;
}
#endif

void prepareProcess() noexcept
{
#if defined(_WIN32)
    formerCodePage = GetConsoleOutputCP();
    if (formerCodePage != 0 && SetConsoleOutputCP(CP_UTF8) != 0)
        std::atexit([] { SetConsoleOutputCP(formerCodePage); });
    for (std::FILE* stream : {stdout, stderr})
        _setmode(_fileno(stream), _O_BINARY);
#else
    // Opening takes the lowest free number, so going upwards fills each gap. What is printed on a stream that was
    // closed must fail: stdout gets a stand-in for reading only.
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0)
            static_cast<void>(::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
    ::signal(SIGXFSZ, SIG_IGN);
    ::signal(SIGPIPE, SIG_IGN);
#endif
    muteSoundLibraries();
    removeTemporariesOnSignals();
}

std::vector<const char*> commandWords([[maybe_unused]] int argc, [[maybe_unused]] const char* const* argv)
{
#if defined(_WIN32)
    static std::vector<std::string> words;
    int count = 0;
    wchar_t** const wide = CommandLineToArgvW(GetCommandLineW(), &count);
    for (int i = 0; i < count; ++i)
    {
        const int size = WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, nullptr, 0, nullptr, nullptr);
        std::string word(static_cast<std::size_t>(size), '\0');
        WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, word.data(), size, nullptr, nullptr);
        words.push_back(word.c_str());
    }
    LocalFree(wide);
    std::vector<const char*> found;
    for (const std::string& word : words)
        found.push_back(word.c_str());
    return found;
#else
    return {argv, argv + argc};
#endif
}

} // namespace pacini::cli
