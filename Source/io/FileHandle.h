#pragma once

// RAII handle of a C stream, and error messages for errno.

#include <pacini/foundation/Result.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace pacini
{

struct FileCloser
{
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

/// An open stream, closed at the end of its life. To check for errors on closing, release it and close it manually.
using FileHandle = std::unique_ptr<std::FILE, FileCloser>;

/// Returns the Error (code diskFull or io) for an errno value: a plain sentence with advice.
[[nodiscard]] Error fileError(int errnoValue);

/// fopen for paths of any alphabet; null and errno on failure. `mode` as in fopen; a last "x" fails when the file
/// exists.
[[nodiscard]] FileHandle openStream(const std::filesystem::path& path, const char* mode);

/// Creates a temporary file, for writing and reading; null and errno on failure, EEXIST when it exists.
[[nodiscard]] FileHandle createStream(const std::filesystem::path& path);

/// Opens a file without a name, for writing and reading, which vanishes when it is closed; null and errno on failure.
[[nodiscard]] FileHandle namelessStream();

/// Waits until all written data is on the disk, so that it survives a power failure. Returns success, else errno.
bool syncStream(std::FILE* file) noexcept;

/// fseek and ftell with 64-bit offsets. seekStream returns whether it worked, tellStream -1 on failure.
bool seekStream(std::FILE* file, std::int64_t offset, int origin) noexcept;
[[nodiscard]] std::int64_t tellStream(std::FILE* file) noexcept;

} // namespace pacini
