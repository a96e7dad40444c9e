#include "cli/ConvertManifest.h"

#include "io/InputFile.h"
#include "io/JsonTree.h"

#include <fmt/format.h>

#include <algorithm>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

constexpr std::size_t largestManifest = std::size_t(256) << 20;
constexpr const char* formatName = "pacini.conversion";

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
    entry.inputSha256 = json.at("sha256").get<std::string>();
    entry.settings = json.at("settings").get<std::string>();
    entry.duration = json.at("duration").get<double>();
    entry.error = json.value("error", "");
    for (const auto& output : json.at("outputs"))
        entry.outputs.push_back({output.at("file").get<std::string>(), output.at("bytes").get<std::size_t>(),
                                 output.at("sha256").get<std::string>()});
    for (const auto& warning : json.at("warnings"))
        entry.warnings.push_back(warning.get<std::string>());
    for (const auto& loss : json.at("losses"))
        entry.losses.push_back({kindNamed(loss.at("kind").get<std::string>()), loss.at("time").get<double>(),
                                loss.at("duration").get<double>(), loss.at("error").get<double>(),
                                loss.at("message").get<std::string>()});
    return entry;
}
} // namespace

ConvertManifest readManifest(const std::filesystem::path& path)
{
    ConvertManifest manifest;
    const auto text = readWholeFile(path, largestManifest);
    const auto tree = text ? readJsonTree(*text, largestManifest) : Result<nlohmann::json>(text.error());
    if (!tree)
        return manifest;
    try
    {
        if (tree->at("format") != formatName || tree->at("version") != 1)
            return manifest;
        for (const auto& file : tree->at("files"))
            manifest[file.at("input").get<std::string>()] = entryOf(file);
    }
    catch (const nlohmann::json::exception&)
    {
        manifest.clear();
    }
    return manifest;
}

std::string manifestText(const ConvertManifest& manifest)
{
    Json files = Json::array();
    for (const auto& [input, entry] : manifest)
    {
        Json outputs = Json::array(), losses = Json::array();
        for (const ManifestOutput& output : entry.outputs)
            outputs.push_back({{"file", output.file}, {"bytes", output.bytes}, {"sha256", output.sha256}});
        for (const FormatLoss& loss : entry.losses)
            losses.push_back(toJson(loss));
        Json json{{"input", input},     {"sha256", entry.inputSha256}, {"settings", entry.settings},
                  {"outputs", outputs}, {"duration", entry.duration},  {"warnings", entry.warnings},
                  {"losses", losses}};
        if (!entry.error.empty())
            json["error"] = entry.error;
        files.push_back(std::move(json));
    }
    return Json{{"format", formatName}, {"version", 1}, {"files", files}}.dump(
               1, ' ', false, nlohmann::json::error_handler_t::replace) +
           "\n";
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
