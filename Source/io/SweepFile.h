#pragma once

// Description file of a measurement sweep, beside its sound: without it a recording cannot be analysed.

#include <pacini/linearize/Sweep.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace pacini
{

inline constexpr std::string_view sweepFormatName = "pacini.sweep";
inline constexpr int sweepFormatVersion = 1;
inline constexpr std::size_t largestSweepText = 1u << 20; ///< bytes

struct SweepFile
{
    SweepParams sweep;
    std::string equalizedFor; ///< name of the profile through whose equaliser the sweep goes; empty without one
    double gain = 0.0;        ///< dB by which it is louder than the levels say, -200 to 200
    bool operator==(const SweepFile&) const = default;
};

/// Reads the JSON of a sweep. Errors: of its syntax, entries that are missing or wrong (with their names), those of
/// validate(SweepParams).
[[nodiscard]] Result<SweepFile> readSweepJson(std::string_view text);
[[nodiscard]] std::string sweepJson(const SweepFile& sweep);

/// The same in a file. Errors of reading and writing: io.
[[nodiscard]] Result<SweepFile> readSweepFile(const std::filesystem::path& path);
[[nodiscard]] Result<std::size_t> writeSweepFile(const std::filesystem::path& path, const SweepFile& sweep);

} // namespace pacini
