#pragma once

// The record of what a folder was converted to.

#include "io/formats/ForeignFormat.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pacini::cli
{

/// One output of a conversion.
struct ManifestOutput
{
    std::string file; ///< relative to the manifest, with /
    std::size_t bytes = 0;
    std::string sha256;
    bool operator==(const ManifestOutput&) const = default;
};

/// One input and what it became.
struct ManifestEntry
{
    std::string inputSha256;
    std::string settings; ///< all that the outputs depend on besides the input
    std::vector<ManifestOutput> outputs;
    double duration = 0.0; ///< s of the clip
    std::vector<std::string> warnings;
    std::vector<FormatLoss> losses; ///< one per kind: the first place, the largest error, and how many as the message
    std::string error;              ///< empty where all went well
    bool operator==(const ManifestEntry&) const = default;
};

/// By the input's path below the folder that was named, with /.
using ConvertManifest = std::map<std::string, ManifestEntry>;

/// The manifest in a file; empty when there is none that can be used, since it only saves work.
[[nodiscard]] ConvertManifest readManifest(const std::filesystem::path& path);

/// Its text: the same for the same entries, whoever made them and when.
[[nodiscard]] std::string manifestText(const ConvertManifest& manifest);

/// An entry as a report shows it.
[[nodiscard]] nlohmann::ordered_json toJson(const FormatLoss& loss);

/// All losses of a kind as one.
[[nodiscard]] std::vector<FormatLoss> lossesByKind(const std::vector<FormatLoss>& losses);

} // namespace pacini::cli
