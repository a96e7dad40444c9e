#pragma once

// Measured delay between sound and haptic output: `latency.json` in the folder of a study.

#include "study/Latency.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::study
{

inline constexpr std::string_view latencyFormatName = "pacini.latency";
inline constexpr int latencyFormatVersion = 1;
inline constexpr const char* latencyFileName = "latency.json";

struct MeasuredLatency
{
    std::string time;      ///< UTC, ISO 8601
    std::string device;    ///< empty where it is not known: of a recording
    std::string recording; ///< its name; empty: the program measured by itself
    double sampleRate = 48000.0;
    Latency latency;
};

/// The measurements in a text. Errors: invalidData with the place, unsupportedVersion, tooLarge.
[[nodiscard]] Result<std::vector<MeasuredLatency>> latenciesOfText(std::string_view text);

/// All measurements of the study in `folder`, the newest last; none where there is no file. Errors: those of reading;
/// invalidData with the place, unsupportedVersion.
[[nodiscard]] Result<std::vector<MeasuredLatency>> readLatencies(const std::filesystem::path& folder);

/// Adds one. The file is whole at any time. Errors: those of readLatencies(), io, diskFull.
[[nodiscard]] Result<void> keepLatency(const std::filesystem::path& folder, const MeasuredLatency& measured);

} // namespace pacini::study
