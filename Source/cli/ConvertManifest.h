#pragma once

// Manifest of a conversion: which inputs became which outputs, so that a later run converts only what has changed.

#include "io/FileHandle.h"
#include "io/formats/ClipFormat.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// What a manifest is called unless the user names it.
inline constexpr const char* manifestName = "pacini.manifest.json";

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

/// The manifest in a file, as far as it goes: a run that was killed left one without an end. None when the file is
/// there and no manifest, empty when it is not there.
[[nodiscard]] std::optional<ConvertManifest> readManifest(const std::filesystem::path& path);

/// Its text, a line for each entry: the same for the same entries, whoever made them and when.
[[nodiscard]] std::string manifestText(const ConvertManifest& manifest);

/// A manifest that grows by a line with each file that is done, so that a run that is killed is taken up where it was.
/// From any thread.
class GrowingManifest
{
public:
    /// Starts `newFile` with the entries of runs before; an empty path keeps no record. Errors: as in AtomicFile.
    [[nodiscard]] Result<void> start(const std::filesystem::path& newFile, const ConvertManifest& before);

    /// Sets an entry, and adds its line to the file.
    void add(const std::string& input, const ManifestEntry& entry);

    /// Completes the file. Errors: as in AtomicFile.
    [[nodiscard]] Result<void> finish();

private:
    std::mutex mutex;
    std::filesystem::path path;
    ConvertManifest entries;
    FileHandle file;
};

/// An entry as a report shows it.
[[nodiscard]] nlohmann::ordered_json toJson(const FormatLoss& loss);

/// All losses of a kind as one.
[[nodiscard]] std::vector<FormatLoss> lossesByKind(const std::vector<FormatLoss>& losses);

} // namespace pacini::cli
