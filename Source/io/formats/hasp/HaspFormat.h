#pragma once

// .hasp files: projects of Meta Haptics Studio, with clips as .haptic inside.

#include "io/formats/ClipFormat.h"

namespace pacini
{

[[nodiscard]] bool isHasp(std::string_view bytes);

/// Reads the clip of a project that has one, as readHaptic() does, with the name that it has there. A project of
/// several or no clips is an error (invalidData) that names them and says how to get at them: a file is one clip here.
/// Errors: as in readForeignTree(), and those of readHaptic() with the clip's place.
[[nodiscard]] Result<ImportedClip> readHasp(std::string_view bytes);

} // namespace pacini
