#pragma once

// Last step of every encoding: a clip with its names and its seal.

#include <pacini/clip/Clip.h>

#include <filesystem>
#include <string>

namespace pacini
{

/// Names that a clip gets from its sound.
struct ClipNames
{
    std::string clip;
    std::string sound; ///< empty: the sound came from no file
};

/// Returns the name of the source in a clip; empty for standard input.
[[nodiscard]] std::string sourceNameOf(const std::filesystem::path& input);

/// The names of the clip that is made of the sound file `input`.
[[nodiscard]] ClipNames clipNamesOf(const std::filesystem::path& input);

/// Names a clip as it was encoded, on its grids, in well-formed UTF-8, and seals it.
[[nodiscard]] Clip finishClip(Clip clip, ClipNames names);

} // namespace pacini
