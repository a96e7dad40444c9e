#pragma once

// SHA-256 fingerprints of files, the same as `sha256sum` prints.

#include <pacini/foundation/Result.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace pacini
{

/// SHA-256 of bytes that come in parts (FIPS 180-4, "Secure Hash Standard", 2015, section 6.2).
class Sha256
{
public:
    Sha256();

    void add(std::string_view bytes);

    /// Returns the hash of all added bytes, as 64 hexadecimal digits. Nothing may be added afterwards.
    [[nodiscard]] std::string text();

private:
    std::array<std::uint32_t, 8> hash;
    std::string rest; ///< less than a block
    std::uint64_t size = 0;
};

/// The SHA-256 of `bytes` as 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// The SHA-256 and size of a file, which is read in parts.
struct FileHash
{
    std::uint64_t bytes = 0;
    std::string sha256;
};

/// Errors: those of openForReading; io.
[[nodiscard]] Result<FileHash> hashOfFile(const std::filesystem::path& path);

} // namespace pacini
