#include "io/FileLock.h"

#if defined(_WIN32)
#include <windows.h>
#else
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#endif

namespace pacini
{

#if defined(_WIN32)

FileLock::Outcome FileLock::take(const std::filesystem::path& file, IfMissing ifMissing)
{
    release();
    // Others may not open it, but its name can be removed while it is held.
    const HANDLE opened =
        CreateFileW(file.c_str(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_DELETE, nullptr,
                    ifMissing == IfMissing::create ? OPEN_ALWAYS : OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (opened != INVALID_HANDLE_VALUE)
    {
        handle = reinterpret_cast<std::intptr_t>(opened);
        return Outcome::taken;
    }
    switch (GetLastError())
    {
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
        return Outcome::heldElsewhere;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
        return Outcome::missing;
    default:
        return Outcome::unknown;
    }
}

void FileLock::release() noexcept
{
    if (handle != none)
        CloseHandle(reinterpret_cast<HANDLE>(handle));
    handle = none;
}

#else

FileLock::Outcome FileLock::take(const std::filesystem::path& file, IfMissing ifMissing)
{
    release();
    const int flags = O_RDWR | O_NOFOLLOW | O_CLOEXEC | (ifMissing == IfMissing::create ? O_CREAT : 0);
    // Who looks for stale locks may remove the file between opening and locking it: then it is made anew.
    for (int attempt = 0; attempt < 100; ++attempt)
    {
        const int opened = ::open(file.c_str(), flags, 0600);
        if (opened < 0)
            return errno == ENOENT ? Outcome::missing : Outcome::unknown;
        // Not fcntl: its locks are of the process, which would see none of its own, and closing any descriptor of the
        // file gives them up. On network file systems Linux makes it one of fcntl, which other computers see.
        const bool locked = ::flock(opened, LOCK_EX | LOCK_NB) == 0;
        const int reason = errno;
        struct stat status = {};
        const bool named = ::fstat(opened, &status) == 0 && status.st_nlink > 0;
        if (locked && named)
        {
            handle = opened;
            return Outcome::taken;
        }
        ::close(opened);
        if (!locked && reason != EWOULDBLOCK && reason != EAGAIN)
            return Outcome::unknown;
        if (named)
            return Outcome::heldElsewhere;
        if (ifMissing == IfMissing::leave)
            return Outcome::missing;
    }
    return Outcome::unknown;
}

void FileLock::release() noexcept
{
    if (handle != none)
        ::close(static_cast<int>(handle));
    handle = none;
}

#endif

} // namespace pacini
