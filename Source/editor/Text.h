// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Conversion of UTF-8 texts and paths to texts of JUCE, and back; where files are looked for first.

#include <juce_core/juce_core.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace pacini::editor
{

/// What is not UTF-8 is replaced.
[[nodiscard]] inline juce::String toText(std::string_view utf8)
{
    return juce::String::fromUTF8(utf8.data(), static_cast<int>(utf8.size()));
}

[[nodiscard]] inline juce::String pathText(const std::filesystem::path& path)
{
    const std::u8string text = path.u8string();
    return juce::String::fromUTF8(reinterpret_cast<const char*>(text.data()), static_cast<int>(text.size()));
}

[[nodiscard]] inline std::filesystem::path pathOf(const juce::String& text)
{
    const std::string utf8 = text.toStdString();
    return std::filesystem::path(std::u8string(utf8.begin(), utf8.end()));
}

[[nodiscard]] inline std::filesystem::path pathOf(const juce::File& file)
{
    return pathOf(file.getFullPathName());
}

/// Where users keep their documents; where there is no such folder, the next one above it.
[[nodiscard]] inline juce::File documentsFolder()
{
    juce::File folder = juce::File::getSpecialLocation(juce::File::userDocumentsDirectory);
    while (!folder.isDirectory() && folder != folder.getParentDirectory())
        folder = folder.getParentDirectory();
    return folder;
}

} // namespace pacini::editor
