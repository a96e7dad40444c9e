#pragma once

// Reader of AHAP files with values of the wrong type, as some programs write them.

#include "io/formats/ClipFormat.h"

namespace pacini
{

/// readAhap() for a file in which true and false may stand for 1 and 0 of Sustained, and null, true and false for
/// omitted content: entries of a list, unknown parameters, the value or the name of a parameter. Adds warnings.
[[nodiscard]] Result<ImportedClip> readAhapWithSlips(std::string_view bytes);

} // namespace pacini
