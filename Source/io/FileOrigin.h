#pragma once

// Provenance mark: a line of text in the header of sound files that Pacini made.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace pacini
{

/// Origin of a file: the input and the settings that made it.
struct FileOrigin
{
    std::string input;     ///< name of that file, without folders; for people
    std::string place;     ///< 16 digits: where that file is as seen from this one
    std::string substance; ///< 16 digits: its content and the settings
    bool operator==(const FileOrigin&) const = default;
};

/// The origin of `output` when it is made from `input` with `substance`, 16 digits.
[[nodiscard]] FileOrigin originOf(const std::filesystem::path& input, const std::filesystem::path& output,
                                  std::string substance);

/// The line of text for the header, with room for the fingerprint of the whole file.
[[nodiscard]] std::string originText(const FileOrigin& origin);

/// The origin that a file carries in its first 64 kB; none when it was not made by Pacini or cannot be read.
[[nodiscard]] std::optional<FileOrigin> readOrigin(const std::filesystem::path& path);

/// Whether a file with an origin is, to the byte, as it was made. False also when it cannot be read.
[[nodiscard]] bool isAsMade(const std::filesystem::path& path);

/// The fingerprint that belongs into a file with an origin, and where.
struct OriginSeal
{
    std::int64_t offset = 0; ///< in bytes from the start
    std::string digits;
};

/// Reads a file to its end by `read`, which fills a span and returns how many bytes came. None without an origin.
[[nodiscard]] std::optional<OriginSeal> sealOf(const std::function<std::size_t(std::span<std::byte>)>& read);

} // namespace pacini
