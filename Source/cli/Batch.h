#pragma once

// Batch of files as one of several runs: its shard, and the manifest of its results.

#include "cli/Manifest.h"
#include "cli/Task.h"

#include <pacini/foundation/Result.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

/// One file of a batch.
struct BatchFile
{
    std::filesystem::path input;
    std::string key;   ///< name in the manifest
    bool left = false; ///< skipped, as -n requires: has no entry
};

/// Result of a run for one file.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a json does not throw, which clang-tidy does not see.
struct BatchOutcome
{
    std::vector<std::filesystem::path> outputs;
    double duration = 0.0; ///< s
    nlohmann::json report; ///< report of the command with --json
    std::string error;     ///< empty on success
    bool upToDate = false;
};

/// Adds --shard to a command.
CLI::Option* addShard(CLI::App& command, std::string& text);

/// Returns for each input whether it is in the shard named by `text`; all are if it is empty. Errors: invalidArgument.
[[nodiscard]] Result<std::vector<bool>> inputsOfShard(const std::vector<std::filesystem::path>& inputs,
                                                      const std::string& text);

/// Returns the manifest's record of the shard named by `text`, with the number of its files; none if `text` is empty.
[[nodiscard]] std::vector<ManifestShard> manifestShards(const std::vector<bool>& inShard, const std::string& text);

/// Returns the path of the manifest for the shard named by `text`, beside those of the others:
/// run.manifest.2-of-8.json. Returns `manifest` itself if `text` is empty or no shard.
[[nodiscard]] std::filesystem::path manifestOfShard(const std::filesystem::path& manifest, const std::string& text);

/// Keeps the chosen tasks.
template <typename TaskType>
void keepChosen(std::vector<TaskType>& tasks, const std::vector<bool>& chosen)
{
    std::vector<TaskType> kept;
    for (std::size_t i = 0; i < tasks.size(); ++i)
        if (chosen[i])
            kept.push_back(std::move(tasks[i]));
    tasks = std::move(kept);
}

/// Options --shard, --manifest and --retry, declared once per command, and their values.
class Batch
{
public:
    void declare(CLI::App& command);

    /// Returns for each file whether this run processes it. Starts the manifest unless nothing is to be written.
    /// Errors: invalidArgument for the options, invalidData for an invalid manifest, io.
    [[nodiscard]] Result<std::vector<bool>> start(const std::vector<BatchFile>& files, bool dryRun);

    /// The same for tasks: those of other runs are removed.
    template <typename ResultType>
    [[nodiscard]] Result<void> start(std::vector<Task<ResultType>>& tasks, bool dryRun)
    {
        std::vector<BatchFile> files;
        for (const auto& task : tasks)
            files.push_back({task.input, task.key, task.skipped});
        const auto chosen = start(files, dryRun);
        if (!chosen)
            return chosen.error();
        keepChosen(tasks, *chosen);
        return {};
    }

    /// Adds the result of a file. From any thread.
    void add(const std::string& key, const BatchOutcome& outcome);

    /// The same for a task, with the report `toJson(task)`; skipped tasks have no entry.
    template <typename ResultType, typename ToJson>
    void add(const Task<ResultType>& task, ToJson&& toJson)
    {
        if (file.empty())
            return;
        if (task.error)
            add(task.key, {{}, 0.0, {}, task.error->text(), false});
        else if (task.result)
            add(task.key,
                {{task.output}, task.result->duration, nlohmann::json(toJson(task)), {}, task.result->upToDate});
    }

    /// Completes the manifest; prints a failure on the console.
    [[nodiscard]] bool finish(Console& console);

private:
    [[nodiscard]] ManifestEntry entryOf(const BatchOutcome& outcome) const;

    CLI::App* command = nullptr;
    std::string shardText;
    std::string manifestFile;
    bool retry = false;
    std::filesystem::path file; ///< of the manifest as it is written; empty for none
    Manifest before;
    GrowingManifest growing;
};

/// Returns the options of `command` that affect its outputs: not the number of jobs, the shard or the verbosity.
[[nodiscard]] std::vector<std::string> lastingArguments(const CLI::App& command);

} // namespace pacini::cli
