#include "cli/Batch.h"

#include "cli/Options.h"
#include "cli/Shard.h"
#include "io/AtomicFile.h"
#include "io/Sha256.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <system_error>

namespace pacini::cli
{

namespace
{
std::uint64_t sizeOf(const fs::path& input)
{
    std::error_code unknown;
    const auto size = fs::file_size(input, unknown);
    return unknown ? 0 : static_cast<std::uint64_t>(size);
}
} // namespace

CLI::Option* addShard(CLI::App& command, std::string& text)
{
    const CLI::Validator partOfWhole(
        [](std::string& given)
        {
            const auto shard = parseShard(given);
            return shard ? std::string() : shard.error().message;
        },
        "1/N to N/N");
    return addOption(command, "--shard", text,
                     "Process only part I of N parts of about the same size; all machines that see the same files "
                     "agree on the parts",
                     partOfWhole, "I/N");
}

Result<std::vector<bool>> inputsOfShard(const std::vector<fs::path>& inputs, const std::string& text)
{
    if (text.empty())
        return std::vector<bool>(inputs.size(), true);
    const auto shard = parseShard(text);
    if (!shard)
        return shard.error();
    std::vector<std::uint64_t> sizes;
    for (const fs::path& input : inputs)
        sizes.push_back(sizeOf(input));
    return filesOfShard(sizes, *shard);
}

std::vector<ManifestShard> manifestShards(const std::vector<bool>& inShard, const std::string& text)
{
    const auto shard = parseShard(text);
    if (!shard)
        return {};
    const auto files = static_cast<std::size_t>(std::count(inShard.begin(), inShard.end(), true));
    return {{*shard, files, inShard.size()}};
}

fs::path manifestOfShard(const fs::path& manifest, const std::string& text)
{
    const auto shard = parseShard(text);
    if (!shard || manifest.empty())
        return manifest;
    fs::path path = manifest;
    path.replace_filename(
        fmt::format("{}.{}-of-{}{}", path.stem().string(), shard->number, shard->count, path.extension().string()));
    return path;
}

void Batch::declare(CLI::App& commandToRun)
{
    command = &commandToRun;
    addShard(*command, shardText);
    auto* named = addOption(*command, "--manifest", manifestFile,
                            "Record hash, error and time of each file in FILE, one line for each, best named "
                            "NAME.manifest.json; --shard 2/8 writes NAME.2-of-8.json",
                            "FILE");
    command->add_flag("--retry", retry, "Process only the files that failed according to the manifest")->needs(named);
}

Result<std::vector<bool>> Batch::start(const std::vector<BatchFile>& files, bool dryRun)
{
    std::vector<fs::path> inputs;
    for (const BatchFile& one : files)
        inputs.push_back(one.input);
    const auto inShard = inputsOfShard(inputs, shardText);
    if (!inShard)
        return inShard.error();
    std::vector<bool> chosen = *inShard;
    const fs::path manifest = manifestOfShard(manifestFile, shardText);
    if (manifest.empty())
        return chosen;
    auto there = readManifest(manifest);
    if (!there)
        return Error{ErrorCode::invalidData, manifest.string(),
                     "exists and is not a manifest; name another file with --manifest"};
    if (!there->command.empty() && there->command != command->get_name())
        return Error{ErrorCode::invalidData, manifest.string(),
                     fmt::format("is a manifest of pacini {}; name another file with --manifest", there->command)};
    before = std::move(*there);
    if (retry)
        for (std::size_t i = 0; i < files.size(); ++i)
            if (const ManifestEntry* entry = before.find(files[i].key); entry == nullptr || entry->error.empty())
                chosen[i] = false;
    if (dryRun)
        return chosen;
    std::error_code ignored; // what comes of it, start() says
    if (manifest.has_parent_path())
        fs::create_directories(manifest.parent_path(), ignored);
    before.command = command->get_name();
    if (!retry || before.arguments.empty())
        before.arguments = lastingArguments(*command);
    if (!retry)
        before.shards = manifestShards(*inShard, shardText);
    Manifest begun = before;
    for (std::size_t i = 0; i < files.size(); ++i)
        if (chosen[i] && !files[i].left)
            begun.expect(files[i].key);
    if (const auto started = growing.start(manifest, begun); !started)
        return Error{started.error().code, manifest.string(), started.error().message};
    file = manifest;
    return chosen;
}

ManifestEntry Batch::entryOf(const BatchOutcome& outcome) const
{
    ManifestEntry entry;
    for (const fs::path& output : outcome.outputs)
    {
        if (isStream(output))
            continue;
        if (const auto hash = hashOfFile(output); hash)
            entry.outputs.push_back(
                {pathFromManifest(file, output), static_cast<std::size_t>(hash->bytes), hash->sha256});
    }
    entry.duration = outcome.duration;
    entry.error = outcome.error;
    entry.report = outcome.report;
    return entry;
}

void Batch::add(const std::string& key, const BatchOutcome& outcome)
{
    if (file.empty())
        return;
    ManifestEntry entry = entryOf(outcome);
    const ManifestEntry* earlier = before.find(key);
    // What failed now made nothing: what is there is of before.
    if (!outcome.error.empty() && earlier != nullptr)
    {
        entry = *earlier;
        entry.error = outcome.error;
    }
    // How long it took stays known where nothing was done again.
    if (outcome.upToDate && earlier != nullptr && earlier->error.empty() && earlier->outputs == entry.outputs)
        return;
    growing.add(key, entry);
}

bool Batch::finish(Console& console)
{
    if (const auto finished = growing.finish(); !finished)
    {
        console.error(file.string(), finished.error());
        return false;
    }
    return true;
}

std::vector<std::string> lastingArguments(const CLI::App& command)
{
    const std::vector<std::string> passing = {"shard", "manifest", "retry", "jobs",    "force",
                                              "quiet", "json",     "help",  "dry-run", "no-overwrite"};
    std::vector<std::string> options, inputs;
    for (const CLI::Option* option : command.get_options())
    {
        const std::string name = option->get_single_name();
        if (option->count() == 0 || std::find(passing.begin(), passing.end(), name) != passing.end())
            continue;
        if (option->get_positional())
            inputs.insert(inputs.end(), option->results().begin(), option->results().end());
        else if (option->get_items_expected_max() == 0)
            options.push_back("--" + name);
        else
            for (const std::string& value : option->results())
                options.push_back(fmt::format("--{}={}", name, value));
    }
    inputs.insert(inputs.end(), options.begin(), options.end());
    return inputs;
}

} // namespace pacini::cli
