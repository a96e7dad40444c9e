#pragma once

// Study files (JSON, format pacini.study) and the rules of valid studies.

#include "io/ReadWarnings.h"
#include "study/Study.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace pacini::study
{

inline constexpr std::string_view studyFormatName = "pacini.study";
inline constexpr int studyFormatVersion = 1;
inline constexpr std::size_t largestStudyText = 16'000'000; // bytes

/// Checks that a study can run: ranges, unique names and valid references, complete tasks. Does not read files. Errors:
/// invalidArgument at a place such as `blocks[1].stimuli[0]`.
[[nodiscard]] Result<void> validate(const Study& study);

/// Reads a study that validate() takes. Keys that are not known go to `warnings`. Errors: invalidData,
/// unsupportedVersion, tooLarge with their places, and those of validate().
[[nodiscard]] Result<Study> readStudyJson(std::string_view text, ReadWarnings* warnings = nullptr);

/// The same of a file. Errors also as in readWholeFile.
[[nodiscard]] Result<Study> readStudy(const std::filesystem::path& path, ReadWarnings* warnings = nullptr);

[[nodiscard]] std::string studyJson(const Study& study);

} // namespace pacini::study
