#include "io/InputFile.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#else
#include <unistd.h>
#endif

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
/// All that comes from `stream`, in a file without a name, at its start.
Result<FileHandle> takenIn(std::FILE* stream)
{
    constexpr std::uint64_t most = 8ull << 30;
    FileHandle file = namelessStream();
    if (!file)
        return fileError(errno);
    std::vector<char> block(65536);
    std::uint64_t total = 0;
    for (;;)
    {
        const auto got = std::fread(block.data(), 1, block.size(), stream);
        if (got == 0)
            break;
        total += got;
        if (total > most)
            return Error{ErrorCode::tooLarge, "", "sends more than 8 GB; save it to a file and cut it into parts"};
        if (std::fwrite(block.data(), 1, got, file.get()) != got)
            return fileError(errno);
    }
    if (std::ferror(stream) != 0)
        return fileError(errno);
    if (std::fflush(file.get()) != 0 || !seekStream(file.get(), 0, SEEK_SET))
        return fileError(errno);
    return file;
}

/// A stream of its own on an open file, which shares the file's place.
std::FILE* secondStream(std::FILE* file)
{
#if defined(_WIN32)
    const int copy = _dup(_fileno(file));
    return copy < 0 ? nullptr : _fdopen(copy, "rb");
#else
    const int copy = ::dup(::fileno(file));
    return copy < 0 ? nullptr : ::fdopen(copy, "rb");
#endif
}

/// A stream of its own on what came through a pipe, taken in when it is opened first.
Result<FileHandle> openPipe(const fs::path& path)
{
    static std::mutex mutex;
    static std::map<fs::path, FileHandle> pipes;
    const std::lock_guard lock(mutex);
    FileHandle& whole = pipes[path];
    if (!whole)
    {
        const bool standardInput = path == "-";
#if defined(_WIN32)
        _setmode(_fileno(stdin), _O_BINARY);
#endif
        const FileHandle pipe = standardInput ? FileHandle() : openStream(path, "rb");
        if (!standardInput && !pipe)
            return fileError(errno);
        auto taken = takenIn(standardInput ? stdin : pipe.get());
        if (!taken)
            return taken.error();
        whole = std::move(*taken);
    }
    FileHandle file(secondStream(whole.get()));
    if (!file || !seekStream(file.get(), 0, SEEK_SET))
        return fileError(errno);
    return file;
}
} // namespace

Result<FileHandle> openForReading(const fs::path& path)
{
    if (path.empty())
        return Error{ErrorCode::invalidArgument, "", "no file name was given"};
    // fopen opens folders for reading on some systems and fails only later.
    std::error_code ignored;
    const auto status = fs::status(path, ignored);
    if (fs::is_directory(status))
        return fileError(EISDIR);
    if (path == "-" || fs::is_fifo(status))
        return openPipe(path);
    auto file = openStream(path, "rb");
    if (!file)
        return fileError(errno);
    return file;
}

Result<FileHandle> openRewindable(const fs::path& path)
{
    std::error_code ignored;
    const auto status = fs::status(path, ignored);
    if (path != "-" && fs::is_other(status) && !fs::is_fifo(status))
        return Error{ErrorCode::io, "", "is a device, not a file; save the audio to a file first"};
    return openForReading(path);
}

Result<std::string> readWholeFile(const fs::path& path, std::size_t maximumBytes, const StartCheck& check)
{
    auto opened = openForReading(path);
    if (!opened)
        return opened.error();
    std::FILE* file = opened->get();
    std::string bytes(check ? 1024 : 0, '\0');
    std::size_t used = std::fread(bytes.data(), 1, bytes.size(), file);
    if (check)
        if (auto wrong = check(std::string_view(bytes).substr(0, used)))
            return *wrong;

    const auto tooLarge = [&]
    {
        return Error{ErrorCode::tooLarge, "", "is larger than " + std::to_string(maximumBytes) + " bytes"};
    };
    // The size is only a hint: pipes, devices and /proc have none, and files can grow.
    std::error_code noSize;
    const auto size = fs::is_regular_file(path, noSize) ? fs::file_size(path, noSize) : 0;
    const auto hint = noSize ? 0 : size;
    if (hint > maximumBytes)
        return tooLarge();
    for (std::size_t step = static_cast<std::size_t>(hint) + 1;; step = std::max<std::size_t>(65536, used))
    {
        // One byte more than allowed is asked for, to see whether there is more.
        bytes.resize(used + std::min(step, maximumBytes + 1 - used));
        used += std::fread(bytes.data() + used, 1, bytes.size() - used, file);
        if (used > maximumBytes)
            return tooLarge();
        if (used < bytes.size())
            break;
    }
    if (std::ferror(file) != 0)
        return fileError(errno);
    bytes.resize(used);
    return bytes;
}

} // namespace pacini
