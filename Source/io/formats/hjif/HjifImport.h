#pragma once

// Import of an HJIF file: its channels as one clip.

#include "io/formats/ClipFormat.h"
#include "io/formats/hjif/HjifFile.h"

#include <pacini/clip/Clip.h>

#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// All channels of perceptions that vibrate in time as one clip without name, see readHjif(). Errors: invalidData with
/// the place of what makes no signal, tooLarge.
[[nodiscard]] Result<Clip> clipOfHjif(const HjifFile& file, std::vector<std::string>& warnings);

/// The same with its name in `imported`, whose warnings stay. Errors also: invalidData where nothing of what the file
/// holds is vibration over time.
[[nodiscard]] std::optional<Error> importHjif(const HjifFile& file, ImportedClip& imported);

} // namespace pacini
