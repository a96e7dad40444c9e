#pragma once

// Import of an HJIF file: its channels as one clip.

#include "io/formats/hjif/HjifFile.h"

#include <pacini/clip/Clip.h>

namespace pacini
{

/// All channels of perceptions that vibrate in time as one clip without name, see readHjif(). Errors: invalidData with
/// the place of what makes no signal, tooLarge.
[[nodiscard]] Result<Clip> clipOfHjif(const HjifFile& file, std::vector<std::string>& warnings);

} // namespace pacini
