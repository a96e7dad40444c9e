#pragma once

// Chapters and cue sheets among the comments of an Ogg or FLAC file.

#include "io/FoundMarkers.h"

#include <string_view>

namespace pacini
{

/// The chapters of a list of comments as Vorbis, Opus and FLAC have it, from the length of its vendor on: a comment
/// `CHAPTER001=00:01:02.500` is a time, `CHAPTER001NAME=...` its name. One without a name is called by its number. The
/// tracks of a comment `CUESHEET=` follow.
/// Sources: Xiph.Org, "Ogg Vorbis I format specification: comment field and header specification", 2005, and "Chapter
/// Extension", wiki.xiph.org.
[[nodiscard]] FoundMarkers commentChapters(std::string_view comments);

} // namespace pacini
