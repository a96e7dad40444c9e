#pragma once

// Chapters in ID3 tags.

#include "io/FoundMarkers.h"

#include <string_view>

namespace pacini
{

/// The CHAP frames of an ID3v2.3 or ID3v2.4 tag, which begins with "ID3": each a time and the title that it holds. One
/// without a title is called by its number. Sources: M. Nilsson, "ID3 tag version 2.3.0", 1999, and "2.4.0", 2000;
/// C. Newell, "ID3v2 Chapter Frame Addendum 1.0", 2005.
[[nodiscard]] FoundMarkers id3Chapters(std::string_view tag);

} // namespace pacini
