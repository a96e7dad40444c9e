#pragma once

// Reading of settings files.

#include "io/InputFile.h"
#include "io/Settings.h"

#include <filesystem>

namespace pacini
{

/// Errors: io as in readWholeFile, and those of readSettings().
[[nodiscard]] inline Result<Settings> readSettingsFile(const std::filesystem::path& path,
                                                       ReadWarnings* warnings = nullptr)
{
    const auto text = readWholeFile(path, largestSettingsText);
    return text ? readSettings(*text, warnings) : text.error();
}

} // namespace pacini
