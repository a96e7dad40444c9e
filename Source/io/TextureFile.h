#pragma once

// Texture files: JSON, usually `NAME.texture.json`.

#include "io/ReadWarnings.h"

#include <pacini/foundation/Result.h>
#include <pacini/texture/Texture.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace pacini
{

inline constexpr std::string_view textureFormatName = "pacini.texture";
inline constexpr int textureFormatVersion = 1;
inline constexpr std::size_t largestTextureText = 1u << 20; ///< bytes

/// Reads the JSON of a texture. Errors: of its syntax, entries that are missing or wrong (with their names), those of
/// validate(Texture). Unknown keys go to `warnings`.
[[nodiscard]] Result<Texture> readTextureJson(std::string_view text, ReadWarnings* warnings = nullptr);
[[nodiscard]] std::string textureJson(const Texture& texture);

/// The same from a file. Errors of reading: io.
[[nodiscard]] Result<Texture> readTexture(const std::filesystem::path& path, ReadWarnings* warnings = nullptr);

} // namespace pacini
