#include "cli/Manifest.h"

#include "io/AtomicFile.h"
#include "io/InputFile.h"
#include "io/JsonTree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <map>
#include <sstream>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

constexpr std::size_t largestManifest = std::size_t(256) << 20;
constexpr const char* formatName = "pacini.conversion";

std::string onOneLine(const Json& json)
{
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

LossKind kindNamed(const std::string& name)
{
    for (int kind = 0; kind < static_cast<int>(LossKind::text); ++kind)
        if (lossName(static_cast<LossKind>(kind)) == name)
            return static_cast<LossKind>(kind);
    return LossKind::text;
}

ManifestEntry entryOf(const nlohmann::json& json)
{
    ManifestEntry entry;
    entry.inputSha256 = json.value("sha256", "");
    entry.settings = json.value("settings", "");
    entry.duration = json.at("duration").get<double>();
    entry.error = json.value("error", "");
    for (const auto& output : json.at("outputs"))
        entry.outputs.push_back({output.at("file").get<std::string>(), output.at("bytes").get<std::size_t>(),
                                 output.at("sha256").get<std::string>()});
    for (const auto& warning : json.at("warnings"))
        entry.warnings.push_back(warning.get<std::string>());
    if (const auto report = json.find("report"); report != json.end())
        entry.report = *report;
    for (const auto& loss : json.at("losses"))
        entry.losses.push_back({kindNamed(loss.at("kind").get<std::string>()), loss.at("time").get<double>(),
                                loss.at("duration").get<double>(), loss.at("error").get<double>(),
                                loss.at("message").get<std::string>()});
    return entry;
}

/// The shards that a manifest is of; nothing where they are none. Throws what JSON throws.
std::optional<std::vector<ManifestShard>> shardsIn(const nlohmann::json& tree)
{
    std::vector<ManifestShard> shards;
    if (const auto list = tree.find("shards"); list != tree.end())
        for (const auto& one : *list)
        {
            const auto shard = parseShard(one.at("shard").get<std::string>());
            if (!shard)
                return std::nullopt;
            shards.push_back({*shard, one.at("files").get<std::size_t>(), one.at("of").get<std::size_t>()});
        }
    return shards;
}

/// All before the entries.
std::string firstLine(const Manifest& manifest)
{
    std::string text = fmt::format("{{\"format\": \"{}\", \"version\": 1, ", formatName);
    if (!manifest.command.empty())
        text += fmt::format("\"command\": {}, \"arguments\": {}, ", onOneLine(manifest.command),
                            onOneLine(manifest.arguments));
    if (!manifest.shards.empty())
    {
        Json shards = Json::array();
        for (const ManifestShard& one : manifest.shards)
            shards.push_back({{"shard", nameOf(one.shard)}, {"files", one.files}, {"of", one.all}});
        text += fmt::format("\"shards\": {}, ", onOneLine(shards));
    }
    return text + "\"files\": [";
}

/// The manifest that `tree` holds; nothing when it is none. Throws what JSON throws.
std::optional<Manifest> manifestIn(const nlohmann::json& tree)
{
    if (!tree.is_object() || tree.value("format", "") != formatName || tree.value("version", 0) != 1)
        return std::nullopt;
    Manifest manifest;
    manifest.command = tree.value("command", "");
    manifest.arguments = tree.value("arguments", std::vector<std::string>());
    auto shards = shardsIn(tree);
    if (!shards)
        return std::nullopt;
    manifest.shards = std::move(*shards);
    for (const auto& file : tree.at("files"))
        manifest.entries[file.at("input").get<std::string>()] = entryOf(file);
    return manifest;
}

/// An entry on one line.
std::string entryText(const std::string& input, const ManifestEntry& entry)
{
    Json outputs = Json::array(), losses = Json::array();
    for (const ManifestOutput& output : entry.outputs)
        outputs.push_back({{"file", output.file}, {"bytes", output.bytes}, {"sha256", output.sha256}});
    for (const FormatLoss& loss : entry.losses)
        losses.push_back(cli::toJson(loss));
    Json json{{"input", input}};
    if (!entry.inputSha256.empty())
        json.update({{"sha256", entry.inputSha256}, {"settings", entry.settings}});
    json.update({{"outputs", outputs}, {"duration", entry.duration}, {"warnings", entry.warnings}, {"losses", losses}});
    if (!entry.report.is_null())
        json["report"] = entry.report;
    if (!entry.error.empty())
        json["error"] = entry.error;
    return onOneLine(json);
}
} // namespace

bool isManifestName(const std::filesystem::path& path)
{
    const std::string name = path.filename().string();
    return path.extension() == ".json" && name.find(".manifest.") != std::string::npos;
}

const ManifestEntry* Manifest::find(const std::string& input) const
{
    const auto entry = entries.find(input);
    return entry == entries.end() ? nullptr : &entry->second;
}

void Manifest::expect(const std::string& input)
{
    ManifestEntry entry;
    entry.error = "was not reached before the run ended";
    entries.try_emplace(input, std::move(entry));
}

void ShardUnion::add(const std::vector<ManifestShard>& more)
{
    whole = whole || more.empty();
    for (const ManifestShard& one : more)
    {
        std::erase_if(shards, [&](const ManifestShard& other) { return other.shard == one.shard; });
        shards.push_back(one);
    }
}

MissingShards ShardUnion::missing() const
{
    if (whole)
        return {};
    std::map<unsigned, std::map<unsigned, const ManifestShard*>> divisions; // by count, then number
    for (const ManifestShard& one : shards)
        divisions[one.shard.count][one.shard.number] = &one;
    std::optional<MissingShards> least;
    for (const auto& [count, present] : divisions)
    {
        MissingShards missing;
        std::size_t made = 0, all = 0;
        for (const auto& [number, one] : present)
        {
            made += one->files;
            all = std::max(all, one->all);
        }
        missing.files = all - std::min(made, all);
        if (present.size() == count)
            return {};
        constexpr unsigned named = 8;
        unsigned lacking = 0;
        for (unsigned number = 1; number <= count && lacking < named; ++number)
            if (!present.contains(number))
                missing.names += (lacking++ == 0 ? "" : ", ") + nameOf(Shard{number, count});
        const std::size_t rest = count - present.size() - lacking;
        missing.names = (lacking + rest == 1 ? "shard " : "shards ") + missing.names;
        if (rest > 0)
            missing.names += fmt::format(" and {} more", rest);
        if (!least || missing.files < least->files)
            least = std::move(missing);
    }
    return least.value_or(MissingShards());
}

std::optional<Manifest> readManifest(const std::filesystem::path& path, bool* hasEnd)
{
    if (hasEnd != nullptr)
        *hasEnd = true;
    if (std::error_code ignored; !std::filesystem::exists(path, ignored))
        return Manifest();
    const auto text = readWholeFile(path, largestManifest);
    if (!text)
        return std::nullopt;
    try
    {
        if (const auto tree = readJsonTree(*text, largestManifest); tree)
            return manifestIn(*tree);
        // One that was not completed: the lines that are whole.
        if (hasEnd != nullptr)
            *hasEnd = false;
        std::istringstream lines(*text);
        std::string line;
        std::getline(lines, line);
        const auto start = readJsonTree(line + "]}", largestManifest);
        auto manifest = start ? manifestIn(*start) : std::nullopt;
        while (manifest && std::getline(lines, line))
        {
            if (line.ends_with(','))
                line.pop_back();
            if (const auto file = readJsonTree(line, largestManifest); file)
                manifest->entries[file->at("input").get<std::string>()] = entryOf(*file);
        }
        return manifest;
    }
    catch (const nlohmann::json::exception&)
    {
        return std::nullopt;
    }
}

std::string pathFromManifest(const std::filesystem::path& manifest, const std::filesystem::path& output)
{
    std::error_code unknown;
    const auto folder = std::filesystem::absolute(manifest, unknown).parent_path();
    const auto path = std::filesystem::proximate(output, folder, unknown);
    return (unknown ? output : path).generic_string();
}

std::string manifestText(const Manifest& manifest)
{
    std::string text = firstLine(manifest);
    const char* separator = "\n";
    for (const auto& [input, entry] : manifest.entries)
    {
        text += separator + entryText(input, entry);
        separator = ",\n";
    }
    return text + "\n]}\n";
}

Result<void> GrowingManifest::start(const std::filesystem::path& newFile, const Manifest& before)
{
    path = newFile;
    manifest = before;
    if (path.empty())
        return {};
    std::string text = firstLine(before) + "\n";
    for (const auto& [input, entry] : before.entries)
        text += entryText(input, entry) + ",\n";
    if (const auto written = writeFileAtomically(path, text); !written)
        return written.error();
    file = openStream(path, "ab");
    return file ? Result<void>() : Result<void>(fileError(errno));
}

void GrowingManifest::add(const std::string& input, const ManifestEntry& entry)
{
    const std::lock_guard lock(mutex);
    manifest.entries.insert_or_assign(input, entry);
    if (!file)
        return;
    // What cannot be added now is missed only after a kill: finish() writes all of it.
    const std::string line = entryText(input, entry) + ",\n";
    std::fwrite(line.data(), 1, line.size(), file.get());
    std::fflush(file.get());
}

Result<void> GrowingManifest::finish()
{
    file.reset();
    if (path.empty())
        return {};
    if (const auto written = writeFileAtomically(path, manifestText(manifest)); !written)
        return written.error();
    return {};
}

nlohmann::ordered_json toJson(const FormatLoss& loss)
{
    return {{"kind", lossName(loss.kind)},
            {"time", loss.time},
            {"duration", loss.duration},
            {"error", loss.error},
            {"message", loss.message}};
}

std::vector<FormatLoss> lossesByKind(const std::vector<FormatLoss>& losses)
{
    std::vector<FormatLoss> kinds;
    std::vector<std::size_t> counts;
    for (const FormatLoss& loss : losses)
    {
        const auto same =
            std::find_if(kinds.begin(), kinds.end(), [&](const FormatLoss& other) { return other.kind == loss.kind; });
        if (same == kinds.end())
        {
            kinds.push_back(loss);
            counts.push_back(1);
            continue;
        }
        same->error = std::max(same->error, loss.error);
        same->duration = std::max(same->duration, loss.time + loss.duration - same->time);
        ++counts[static_cast<std::size_t>(same - kinds.begin())];
    }
    for (std::size_t i = 0; i < kinds.size(); ++i)
        if (counts[i] > 1)
            kinds[i].message += fmt::format(" ({} places)", counts[i]);
    return kinds;
}

} // namespace pacini::cli
