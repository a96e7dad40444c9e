#pragma once

// Search of a folder for sounds and clips that can be opened.

#include <filesystem>
#include <string>
#include <vector>

namespace pacini
{

/// The extensions of sounds and of clips of any format, in lower case with their dots.
[[nodiscard]] std::vector<std::string> openableExtensions();

/// All files with those extensions in a folder and everything inside it, sorted by path. Hidden files and folders, and
/// what may not be read, are left out; links to folders are not followed. [worker]
[[nodiscard]] std::vector<std::filesystem::path> openableFiles(const std::filesystem::path& folder);

} // namespace pacini
