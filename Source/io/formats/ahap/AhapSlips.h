#pragma once

// Reader of AHAP files with values of the wrong kind, as some programs write them.

#include "io/formats/ClipFormat.h"

namespace pacini
{

/// readAhap() of a file in which true and false may stand for 1 and 0 of Sustained, and null, true and false for what
/// is left out: entries of a list, parameters that are not known, the value or the name of a parameter. Warnings say
/// so.
[[nodiscard]] Result<ImportedClip> readAhapWithSlips(std::string_view bytes);

} // namespace pacini
