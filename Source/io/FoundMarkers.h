#pragma once

// Markers found in a file, and warnings about unreadable ones.

#include <pacini/clip/Clip.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pacini
{

namespace limits
{
inline constexpr std::size_t soundMarkers = 10000;            ///< of one file
inline constexpr std::size_t soundMarkerBytes = 100'000;      ///< of all their names: two fifths of the texts of a clip
inline constexpr std::size_t tagBytes = std::size_t(1) << 24; ///< of one tag or list of comments
} // namespace limits

/// Times are s of the sound. Each warning is a sentence about the file.
struct FoundMarkers
{
    std::vector<Marker> markers;
    std::vector<std::string> warnings;
};

/// Adds all of `found` to `all`.
void appendFound(FoundMarkers& all, FoundMarkers found);

/// Adds the markers of a sound that begins at `offset` s of the file. A marker with the name and, within a millisecond,
/// the time of an existing one is the same and is left out.
void addMarkers(FoundMarkers& all, FoundMarkers found, double offset);

} // namespace pacini
