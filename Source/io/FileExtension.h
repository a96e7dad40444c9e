#pragma once

// File extensions in lower case, for comparison.

#include <algorithm>
#include <filesystem>
#include <string>

namespace pacini
{

/// The extension of `path` with its dot, its ASCII letters in lower case.
[[nodiscard]] inline std::string lowerExtension(const std::filesystem::path& path)
{
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension;
}

} // namespace pacini
