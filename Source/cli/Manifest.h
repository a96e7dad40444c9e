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

/// What a manifest is called unless the user names it.
inline constexpr const char* manifestName = "pacini.manifest.json";

/// Whether a file in a folder is called like a manifest, which no command takes for an input.
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
    std::string inputSha256; ///< empty where a run does not go by it
    std::string settings;    ///< all that the outputs depend on besides the input; empty likewise
    std::vector<ManifestOutput> outputs;
    double duration = 0.0; ///< s of the clip
    std::vector<std::string> warnings;
    std::vector<FormatLoss> losses; ///< one per kind: the first place, the largest error, and how many as the message
    std::string error;              ///< empty where all went well
    nlohmann::json report;          ///< what the command says of it with --json; null for nothing
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
    std::vector<ManifestShard> shards;            ///< that it is of; empty for all of a run
    std::map<std::string, ManifestEntry> entries; ///< by the input's path below the folder that was named, with /

    /// The entry of an input; null when there is none.
    [[nodiscard]] const ManifestEntry* find(const std::string& input) const;

    /// Gives an input that has no entry one with an error, which stands until the input is done.
    void expect(const std::string& input);

    bool operator==(const Manifest&) const = default;
};

/// Shards missing in a run.
struct MissingShards
{
    std::string names;     ///< "shard 2/3", or several; empty for none
    std::size_t files = 0; ///< that they have
};

/// The shards of a run that several manifests are of together.
struct ShardUnion
{
    std::vector<ManifestShard> shards;
    bool whole = false; ///< one of them is of all of the run

    /// Adds those of a manifest.
    void add(const std::vector<ManifestShard>& more);

    /// Shards of several divisions make the run whole if those of any one do; otherwise the one that lacks the fewest
    /// files counts.
    [[nodiscard]] MissingShards missing() const;
};

/// The manifest in a file, as far as it goes: a run that was killed left one without an end. None when the file is
/// there and no manifest, empty when it is not there.
[[nodiscard]] std::optional<Manifest> readManifest(const std::filesystem::path& path);

/// What a manifest calls an output: its path from the manifest's folder, with /.
[[nodiscard]] std::string pathFromManifest(const std::filesystem::path& manifest, const std::filesystem::path& output);

/// Its text, a line for each entry: the same for the same entries, whoever made them and when.
[[nodiscard]] std::string manifestText(const Manifest& manifest);

/// A manifest that grows by a line with each file that is done, so that a run that is killed is taken up where it was.
/// From any thread.
class GrowingManifest
{
public:
    /// Starts `newFile` with the entries of runs before; an empty path keeps no record. Errors: as in AtomicFile.
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
