#include "io/FileHandle.h"

#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <windows.h>
#else
#include <fcntl.h>
#include <unistd.h>
#endif

namespace pacini
{

namespace
{
std::string reason(int errnoValue)
{
    switch (errnoValue)
    {
    case ENOENT:
        return "does not exist; check the name and the folder";
    case ENOTDIR:
        return "a part of the path is not a folder; check the path";
    case EISDIR:
        return "is a folder; give the name of a file";
    case EACCES:
    case EPERM:
#if defined(_WIN32)
        return "permission denied; close it in other programs and check the permissions of the file and its folder";
#else
        return "permission denied; check the permissions of the file and its folder";
#endif
    case EROFS:
        return "the disk is read-only; choose another folder";
    case ENOSPC:
        return "the disk is full; free some space and try again";
#if defined(EDQUOT)
    case EDQUOT:
        return "your disk quota is used up; free some space and try again";
#endif
    case EFBIG:
        return "the file would be larger than the system allows; write a shorter file or raise the limit";
    case ENAMETOOLONG:
        return "the file name is too long; choose a shorter one";
    case EMFILE:
    case ENFILE:
        return "too many files are open; close some and try again";
    case EIO:
        return "the disk reported a read or write error; check the disk";
    case EPIPE:
        return "the reader of the pipe has closed it";
    default:
        return "the system refused: " + std::generic_category().message(errnoValue);
    }
}
} // namespace

Error fileError(int errnoValue)
{
    bool full = errnoValue == ENOSPC;
#if defined(EDQUOT)
    full = full || errnoValue == EDQUOT;
#endif
    return {full ? ErrorCode::diskFull : ErrorCode::io, "", reason(errnoValue)};
}

#if defined(_WIN32)
namespace
{
/// Creates the file with these rights to it, which others share.
FileHandle createWith(const std::filesystem::path& path, DWORD rights, DWORD shared)
{
    const HANDLE file = CreateFileW(path.c_str(), rights, shared, nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file == INVALID_HANDLE_VALUE)
    {
        const std::error_code reason(static_cast<int>(GetLastError()), std::system_category());
        errno = reason.default_error_condition().value();
        return {};
    }
    const int descriptor = _open_osfhandle(reinterpret_cast<std::intptr_t>(file), _O_RDWR | _O_BINARY);
    return FileHandle(descriptor < 0 ? nullptr : _fdopen(descriptor, "w+b"));
}
} // namespace
#endif

FileHandle openStream(const std::filesystem::path& path, const char* mode)
{
#if defined(_WIN32)
    if (std::string_view(mode).ends_with('x')) // which its C library does not know
        return createWith(path, GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE);
    const std::wstring wideMode(mode, mode + std::char_traits<char>::length(mode));
    return FileHandle(_wfopen(path.c_str(), wideMode.c_str()));
#else
    return FileHandle(std::fopen(path.c_str(), mode));
#endif
}

FileHandle createStream(const std::filesystem::path& path)
{
#if defined(_WIN32)
    return createWith(path, GENERIC_READ | GENERIC_WRITE | DELETE, FILE_SHARE_READ); // TemporaryFiles.cpp removes it
#else
    return openStream(path, "w+bx");
#endif
}

FileHandle namelessStream()
{
#if defined(_WIN32)
    // tmpfile() would put it where administrators alone may write.
    wchar_t folder[MAX_PATH + 1], name[MAX_PATH + 1];
    if (GetTempPathW(MAX_PATH + 1, folder) == 0 || GetTempFileNameW(folder, L"pac", 0, name) == 0)
    {
        errno = EACCES;
        return {};
    }
    return openStream(name, "w+bTD"); // in memory where there is room, and removed when it is closed
#else
    return FileHandle(std::tmpfile());
#endif
}

bool syncStream(std::FILE* file) noexcept
{
    if (std::fflush(file) != 0)
        return false;
#if defined(_WIN32)
    return _commit(_fileno(file)) == 0;
#elif defined(F_FULLFSYNC)
    // fsync() of macOS leaves it in the memory of the drive. Drives that cannot do better refuse.
    return fcntl(fileno(file), F_FULLFSYNC) == 0 || fsync(fileno(file)) == 0;
#else
    // Pipes and some file systems have no such thing.
    return fsync(fileno(file)) == 0 || errno == EINVAL;
#endif
}

bool seekStream(std::FILE* file, std::int64_t offset, int origin) noexcept
{
#if defined(_WIN32)
    return _fseeki64(file, offset, origin) == 0;
#else
    return fseeko(file, offset, origin) == 0;
#endif
}

std::int64_t tellStream(std::FILE* file) noexcept
{
#if defined(_WIN32)
    return _ftelli64(file);
#else
    return ftello(file);
#endif
}

} // namespace pacini
