#include "document/SettingsPresets.h"

#include "io/AtomicFile.h"
#include "io/FileNames.h"
#include "io/SettingsFile.h"

#include <pacini/analysis/methods/MethodChoices.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace pacini
{

std::vector<std::string> SettingsPresets::names() const
{
    std::vector<std::string> found;
    std::error_code failed;
    for (std::filesystem::directory_iterator at(home, failed), end; !failed && at != end; at.increment(failed))
        if (const auto& path = at->path(); path.extension() == ".json")
        {
            const std::u8string stem = path.stem().u8string();
            if (std::string name(stem.begin(), stem.end()); !presetNameDefect(name, longestName))
                found.push_back(std::move(name));
        }
    std::sort(found.begin(), found.end());
    found.resize(std::min(found.size(), most));
    return found;
}

std::filesystem::path SettingsPresets::pathOf(const std::string& name) const
{
    return home / std::filesystem::path(std::u8string(name.begin(), name.end()) + u8".json");
}

Result<void> SettingsPresets::save(const std::string& name, const std::string& settings, bool replace) const
{
    if (auto defect = presetNameDefect(name, longestName))
        return *std::move(defect);
    std::error_code failed;
    std::filesystem::create_directories(home, failed);
    if (failed)
        return Error{ErrorCode::io, home.string(), failed.message()};
    const auto written = writeFileAtomically(pathOf(name), settings, replace ? Existing::replace : Existing::keep);
    if (!written)
        return written.error();
    return {};
}

Result<void> SettingsPresets::rename(const std::string& name, const std::string& wanted) const
{
    if (auto defect = presetNameDefect(wanted, longestName))
        return *std::move(defect);
    std::error_code failed, unknown;
    const auto from = pathOf(name), to = pathOf(wanted);
    // Where capitals do not count, another spelling of the name is the same file.
    if (std::filesystem::exists(to, unknown) && !std::filesystem::equivalent(from, to, unknown))
        return Error{ErrorCode::invalidArgument, wanted, "is the name of another preset"};
    std::filesystem::rename(from, to, failed);
    if (failed)
        return Error{ErrorCode::io, name, failed.message()};
    return {};
}

Result<void> SettingsPresets::remove(const std::string& name) const
{
    std::error_code failed;
    if (!std::filesystem::remove(pathOf(name), failed))
        return Error{ErrorCode::io, name, failed ? failed.message() : "is not there any more"};
    return {};
}

std::string analysisSettings(const EncoderParams& params)
{
    return settingsJson({Method::a2vt, params, {}}, {}).dump(2) + "\n";
}

Result<EncoderParams> readAnalysisSettings(const std::filesystem::path& path)
{
    const auto settings = readSettingsFile(path);
    if (!settings)
        return settings.error();
    if (!settings->hasEncode)
        return Error{ErrorCode::invalidData, "encode", "is missing: these are no settings of the analysis"};
    const auto translation = translationOf(*settings);
    if (!translation)
        return translation.error();
    if (translation->method != Method::a2vt)
        return Error{ErrorCode::invalidArgument, "method", "is not one of the editor's; it analyses with a2vt"};
    return translation->params;
}

std::string outputSettings(const OutputSettings& settings)
{
    return playbackSettingsJson({settings, {}}).dump(2) + "\n";
}

Result<OutputSettings> readOutputSettings(const std::filesystem::path& path)
{
    auto settings = readSettingsFile(path);
    if (!settings)
        return settings.error();
    if (!settings->playback.outputs)
        return Error{ErrorCode::invalidData, "outputs", "is missing: these are no settings of outputs"};
    return std::move(*settings->playback.outputs);
}

std::string characterSettings(const CharacterSettings& settings)
{
    return playbackSettingsJson({{}, settings}).dump(2) + "\n";
}

Result<CharacterSettings> readCharacterSettings(const std::filesystem::path& path)
{
    const auto settings = readSettingsFile(path);
    if (!settings)
        return settings.error();
    if (!settings->playback.character)
        return Error{ErrorCode::invalidData, "character", "is missing: these are no settings of the character"};
    return *settings->playback.character;
}

} // namespace pacini
