#include "io/InputFile.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace pacini
{

namespace fs = std::filesystem;

Result<FileHandle> openForReading(const fs::path& path)
{
    if (path.empty())
        return Error{ErrorCode::invalidArgument, "", "no file name was given"};
    // fopen opens folders for reading on some systems and fails only later.
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        return fileError(EISDIR);
    auto file = openStream(path, "rb");
    if (!file)
        return fileError(errno);
    return file;
}

Result<std::string> readWholeFile(const fs::path& path, std::size_t maximumBytes)
{
    auto opened = openForReading(path);
    if (!opened)
        return opened.error();
    std::FILE* file = opened->get();

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

    std::string bytes;
    std::size_t used = 0;
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
