#pragma once

// Manifest of a run over many files: outputs and failures of all inputs, so that a later run processes only the
// rest.

#include "cli/Shard.h"
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

/// Default name of a manifest.
inline constexpr const char* manifestName = "pacini.manifest.json";

/// Whether a file name is that of a manifest. No command takes such files of a folder for inputs.
[[nodiscard]] bool isManifestName(const std::filesystem::path& path);

/// One output of a run.
struct ManifestOutput
{
    std::string file; ///< relative to the manifest, with /
    std::size_t bytes = 0;
    std::string sha256;
    bool operator==(const ManifestOutput&) const = default;
};

/// One input and its result.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a json does not throw, which clang-tidy does not see.
struct ManifestEntry
{
    std::string inputSha256; ///< empty if the run does not compare it
    std::string settings;    ///< everything that affects the outputs besides the input; empty likewise
    std::vector<ManifestOutput> outputs;
    double duration = 0.0; ///< s of the clip
    std::vector<std::string> warnings;
    std::vector<FormatLoss> losses; ///< one per kind: the first place, the largest error, and how many as the message
    std::string error;              ///< empty on success
    nlohmann::json report;          ///< report of the command with --json; null for none
    bool operator==(const ManifestEntry&) const = default;
};

/// A shard of a run and its number of files.
struct ManifestShard
{
    Shard shard;
    std::size_t files = 0;
    std::size_t all = 0; ///< of all shards together
    bool operator==(const ManifestShard&) const = default;
};

/// Results for many files.
struct Manifest
{
    std::string command;                          ///< such as "encode"; empty for a conversion
    std::vector<std::string> arguments;           ///< of the command, for another run over the same files
    std::vector<ManifestShard> shards;            ///< of this manifest; empty for a whole run
    std::map<std::string, ManifestEntry> entries; ///< by the input's path relative to the given folder, with /

    /// The entry of an input; null when there is none.
    [[nodiscard]] const ManifestEntry* find(const std::string& input) const;

    /// Adds an entry with an error for an input without an entry. The error remains until the input is done.
    void expect(const std::string& input);

    bool operator==(const Manifest&) const = default;
};

/// Shards missing in a run.
struct MissingShards
{
    std::string names;     ///< "shard 2/3", or several; empty for none
    std::size_t files = 0; ///< that they have
};

/// The shards of a run that several manifests cover together.
struct ShardUnion
{
    std::vector<ManifestShard> shards;
    bool whole = false; ///< one manifest covers the whole run

    /// Adds the shards of a manifest.
    void add(const std::vector<ManifestShard>& more);

    /// Returns the missing shards. If the manifests have shards of several divisions, one complete division suffices;
    /// otherwise the division with the fewest missing files counts.
    [[nodiscard]] MissingShards missing() const;
};

/// Reads a manifest as far as it goes: that of a killed run has no end. None if the file is not a manifest, empty if it
/// does not exist. `hasEnd` becomes whether the manifest was completed.
[[nodiscard]] std::optional<Manifest> readManifest(const std::filesystem::path& path, bool* hasEnd = nullptr);

/// The name of an output in a manifest: its path relative to the manifest's folder, with /.
[[nodiscard]] std::string pathFromManifest(const std::filesystem::path& manifest, const std::filesystem::path& output);

/// The text of a manifest, with a line for each entry. It depends on the entries only.
[[nodiscard]] std::string manifestText(const Manifest& manifest);

/// A manifest that grows by a line with each finished file, so that a killed run can continue. From any thread.
class GrowingManifest
{
public:
    /// Starts `newFile` with the entries of earlier runs; an empty path keeps no record. Errors: as in AtomicFile.
    [[nodiscard]] Result<void> start(const std::filesystem::path& newFile, const Manifest& before);

    /// Sets an entry, and adds its line to the file.
    void add(const std::string& input, const ManifestEntry& entry);

    /// Completes the file. Errors: as in AtomicFile.
    [[nodiscard]] Result<void> finish();

private:
    std::mutex mutex;
    std::filesystem::path path;
    Manifest manifest;
    FileHandle file;
};

/// An entry as a report shows it.
[[nodiscard]] nlohmann::ordered_json toJson(const FormatLoss& loss);

/// All losses of a kind as one.
[[nodiscard]] std::vector<FormatLoss> lossesByKind(const std::vector<FormatLoss>& losses);

} // namespace pacini::cli
