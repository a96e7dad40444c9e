// Command group for the manifests of runs over many files.

#include "cli/CommandGroup.h"
#include "cli/Counted.h"
#include "cli/InputFiles.h"
#include "cli/Manifest.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "io/AtomicFile.h"
#include "io/Sha256.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
/// A manifest that must be there; the console has said why it is not, and that it has no end. `hasEnd` becomes false
/// for that of a run that was stopped, or for one that was cut off: what it lacks is not known.
std::optional<Manifest> openManifest(Console& console, const std::string& path, bool& hasEnd)
{
    std::error_code ignored;
    bool completed = true;
    auto manifest = fs::exists(path, ignored) ? readManifest(path, &completed) : std::nullopt;
    if (manifest && !completed)
    {
        hasEnd = false;
        console.error(path, {ErrorCode::truncated, "",
                             fmt::format("has no end: the run was stopped, or the file is cut off after {}; start the "
                                         "run again to continue it",
                                         counted(manifest->entries.size(), "file", "files"))});
    }
    if (!manifest)
        console.error(path, {ErrorCode::invalidData, "",
                             fs::exists(path, ignored)
                                 ? "is not a manifest; encode, render, convert and compare write one with --manifest"
                                 : "does not exist"});
    return manifest;
}

/// Says which shards are in no manifest.
Error notMade(const MissingShards& missing)
{
    return {ErrorCode::invalidData, "",
            fmt::format("{} {} in none of the manifests: nobody made {}", missing.names,
                        missing.names.starts_with("shards") ? "are" : "is", counted(missing.files, "file", "files"))};
}

/// The name of the run that a manifest is of: shards of one run, beside each other, have the same.
std::string runOf(const fs::path& path, const Manifest& manifest)
{
    std::string stem = path.stem().string();
    if (manifest.shards.size() == 1)
    {
        const Shard& shard = manifest.shards.front().shard;
        const std::string ending = fmt::format(".{}-of-{}", shard.number, shard.count);
        if (stem.ends_with(ending))
            stem.resize(stem.size() - ending.size());
    }
    return sameFileKey(path.parent_path() / stem).generic_string();
}

/// What is wrong with an output, "" for nothing.
std::string faultOf(const ManifestOutput& output, const fs::path& folder)
{
    std::error_code unknown;
    const fs::path path = folder / output.file;
    if (!fs::exists(path, unknown))
        return output.file + " is missing";
    const auto hash = hashOfFile(path);
    if (!hash)
        return output.file + ": " + hash.error().message;
    return hash->bytes == output.bytes && hash->sha256 == output.sha256 ? "" : output.file + " was changed";
}

/// `manifest merge`: those of several shards become one.
struct MergeSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = app.add_subcommand("merge", "Merge the manifests of several runs or shards");
        addOption(*command, "inputs", inputs, "Manifests; when several name the same file, the last success counts",
                  "MANIFEST")
            ->required();
        addOption(*command, "-o,--output", output, "File to write", "OUT")->required();
        overwriting.declare(*command);
        return command->footer("Example:\n  pacini manifest merge run.manifest.*-of-8.json -o run.manifest.json");
    }

    Exit run(Console& console) override
    {
        Manifest merged;
        ShardUnion made;
        bool allEnd = true;
        for (const std::string& input : inputs)
        {
            const auto one = openManifest(console, input, allEnd);
            if (!one)
                return Exit::failed;
            if (input != inputs.front() && one->command != merged.command)
                return console.fail(input, {ErrorCode::invalidData, "",
                                            fmt::format("is of pacini {}, but {} of pacini {}", nameOf(*one),
                                                        inputs.front(), nameOf(merged))});
            if (input == inputs.front())
            {
                merged.command = one->command;
                merged.arguments = one->arguments;
            }
            else if (one->arguments != merged.arguments)
                console.warning(input, "was made with other options than " + inputs.front());
            made.add(one->shards);
            add(merged, *one, input);
        }
        const MissingShards missing = made.missing();
        if (!missing.names.empty())
            merged.shards = made.shards;
        if (overwriting.keeps(console, {output}))
            return Exit::ok;
        // The user named it; only what is no manifest at all is worth a word.
        if (!overwriting.replacesAll() && !readManifest(output))
            return console.fail("", notReplaced(output, "exists and is not a manifest"));
        const auto written = writeFileAtomically(output, manifestText(merged));
        if (!written)
            return console.fail(output, written.error());
        std::size_t failed = 0;
        for (const auto& [name, entry] : merged.entries)
            failed += entry.error.empty() ? 0u : 1u;
        console.addToReport({{"output", output},
                             {"files", merged.entries.size()},
                             {"failed", failed},
                             {"missingShards", missing.names},
                             {"notMade", missing.files}});
        console.wrote(output, fmt::format("{}, {} failed", counted(merged.entries.size(), "file", "files"), failed));
        if (missing.names.empty())
            return allEnd ? Exit::ok : Exit::failed;
        console.error(output, notMade(missing));
        return Exit::failed;
    }

    static std::string nameOf(const Manifest& manifest)
    {
        return manifest.command.empty() ? "convert" : manifest.command;
    }

    void add(Manifest& merged, const Manifest& one, const std::string& path) const
    {
        for (const auto& [name, entry] : one.entries)
        {
            const ManifestEntry* before = merged.find(name);
            if (before != nullptr && before->error.empty() && !entry.error.empty())
                continue;
            ManifestEntry moved = entry;
            for (ManifestOutput& file : moved.outputs)
                file.file = pathFromManifest(output, fs::path(path).parent_path() / file.file);
            merged.entries.insert_or_assign(name, std::move(moved));
        }
    }

    std::vector<std::string> inputs;
    std::string output;
    OverwriteOptions overwriting;
};

/// `manifest check`: is everything still as the manifest says?
struct CheckSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command =
            app.add_subcommand("check", "List files that failed, are missing or changed since, and missing shards");
        addOption(*command, "inputs", inputs, "Manifests; output paths are relative to each manifest", "MANIFEST")
            ->required();
        return command->footer("Example:\n  pacini manifest check clips/run.manifest.json");
    }

    Exit run(Console& console) override
    {
        std::size_t files = 0, failed = 0, faulty = 0, lost = 0;
        std::map<std::string, std::pair<std::string, ShardUnion>> runs; // with the first manifest of each
        bool whole = true;
        for (const std::string& input : inputs)
        {
            const auto manifest = openManifest(console, input, whole);
            if (!manifest)
                return Exit::failed;
            runs.try_emplace(runOf(input, *manifest), input, ShardUnion()).first->second.second.add(manifest->shards);
            for (const auto& [name, entry] : manifest->entries)
            {
                ++files;
                if (!entry.error.empty())
                {
                    ++failed;
                    console.error(name, {ErrorCode::invalidData, "", entry.error});
                    continue;
                }
                std::string fault;
                for (const ManifestOutput& one : entry.outputs)
                    if (fault.empty())
                        fault = faultOf(one, fs::path(input).parent_path());
                if (fault.empty())
                    continue;
                ++faulty;
                console.error(name, {ErrorCode::invalidData, "", fault});
            }
        }
        for (const auto& [name, run] : runs)
            if (const MissingShards missing = run.second.missing(); !missing.names.empty())
            {
                whole = false;
                lost += missing.files;
                console.error(run.first, notMade(missing));
            }
        console.addToReport({{"files", files}, {"failed", failed}, {"missingOrChanged", faulty}, {"notMade", lost}});
        console.note(fmt::format("{}: {} as recorded, {} failed, {} missing or changed{}",
                                 counted(files, "file", "files"), files - failed - faulty, failed, faulty,
                                 lost > 0 ? fmt::format("; nobody made {} more", lost) : ""));
        return failed + faulty > 0 || !whole ? Exit::failed : Exit::ok;
    }

    std::vector<std::string> inputs;
};

/// `manifest retry`: replaced by the command of the manifest, see retriedCommand().
struct RetrySubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = app.add_subcommand(
            "retry", "Run the command of a manifest again for the files that failed, from the same folder");
        addOption(*command, "input", input, "Manifest of encode, render or compare; give it before all options",
                  "MANIFEST")
            ->required();
        command->allow_extras(); // of a manifest that cannot be retried, which run() says
        return command->footer("Options after the manifest are passed to the command.\n\nExample:\n"
                               "  pacini manifest retry clips/run.manifest.json -j 2");
    }

    Exit run(Console& console) override
    {
        bool hasEnd = true;
        const auto manifest = openManifest(console, input, hasEnd);
        if (!manifest)
            return Exit::failed;
        return console.fail(input, {ErrorCode::invalidData, "",
                                    manifest->command.empty()
                                        ? std::string("is of a conversion; run convert again: it retries failed files "
                                                      "and skips those that are up to date")
                                        : fmt::format("is of pacini {}; only encode, render and compare can be retried",
                                                      printable(manifest->command))});
    }

    std::string input;
};

template <typename Subcommand>
std::unique_ptr<Command> made()
{
    return std::make_unique<Subcommand>();
}
} // namespace

/// `pacini manifest`: the records of runs over many files.
std::unique_ptr<Command> manifestCommand()
{
    return commandGroup(
        "manifest", "Merge, check and retry runs over many files",
        {made<MergeSubcommand>, made<CheckSubcommand>, made<RetrySubcommand>},
        "encode, render and compare write a manifest with --manifest, convert of a folder always. After\n"
        "'encode sounds/ -o clips/ --shard 3/8 --manifest clips/run.manifest.json' on each of eight machines:\n"
        "  pacini manifest merge clips/run.manifest.*-of-8.json -o clips/run.manifest.json\n"
        "  pacini manifest check clips/run.manifest.json\n"
        "  pacini manifest retry clips/run.manifest.json\n"
        "A stopped run continues when it is started again, with any number of shards.");
}

} // namespace pacini::cli
