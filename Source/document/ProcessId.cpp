#include "document/ProcessId.h"

#if defined(_WIN32)
#include <windows.h>
#else
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#endif

namespace pacini
{

#if defined(_WIN32)

std::int64_t processId() noexcept
{
    return static_cast<std::int64_t>(GetCurrentProcessId());
}

bool isRunning(std::int64_t process) noexcept
{
    const HANDLE handle = OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, static_cast<DWORD>(process));
    if (handle == nullptr)
        return false;
    DWORD code = 0;
    const bool running = GetExitCodeProcess(handle, &code) != 0 && code == STILL_ACTIVE;
    CloseHandle(handle);
    return running;
}

#else

std::int64_t processId() noexcept
{
    return static_cast<std::int64_t>(getpid());
}

bool isRunning(std::int64_t process) noexcept
{
    // Ids of 0 and below mean groups of processes.
    return process > 0 && (kill(static_cast<pid_t>(process), 0) == 0 || errno == EPERM);
}

#endif

} // namespace pacini
