#pragma once

// Tables of speed and force over time, and the same as a word on a command line.

#include <pacini/foundation/Result.h>
#include <pacini/texture/TextureAnalysis.h>

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace pacini
{

inline constexpr std::size_t largestMotionText = 64u << 20; ///< bytes
inline constexpr std::size_t mostMotionRows = 1'000'000;

/// Speed and force from lines of `time, speed` or `time, speed, force`, s and any units, as in readNumberTable(). A
/// force in the first line needs one in all. Errors also: numbers below 0, times that do not ascend.
[[nodiscard]] Result<TextureMotion> readMotionTable(std::string_view bytes);

/// The same from a file. Errors of reading: io.
[[nodiscard]] Result<TextureMotion> readMotion(const std::filesystem::path& path);

/// A curve in words: `0.5` stays there; `0:0 .5:1 1:.3` has points of time and value, parted by blanks or commas, which
/// straight lines join. Errors: invalidArgument for anything else, values outside 0 to 1 and times that descend.
[[nodiscard]] Result<Curve> curveOfText(std::string_view text);

} // namespace pacini
