#include "document/SettingsPresets.h"

#include "io/AtomicFile.h"
#include "io/FileNames.h"
#include "io/LiveSettings.h"
#include "io/SettingsFile.h"

#include <pacini/analysis/methods/MethodChoices.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace pacini
{

namespace
{
std::string textOf(const std::filesystem::path& path)
{
    const std::u8string text = path.u8string();
    return {text.begin(), text.end()};
}
} // namespace

std::vector<std::string> SettingsPresets::stems() const
{
    std::vector<std::string> found;
    std::error_code failed;
    for (std::filesystem::directory_iterator at(home, failed), end; !failed && at != end; at.increment(failed))
        if (const auto& path = at->path(); path.extension() == ".json" && !textOf(path.filename()).starts_with('.'))
            found.push_back(textOf(path.stem()));
    std::sort(found.begin(), found.end());
    found.resize(std::min(found.size(), most));
    return found;
}

std::vector<std::string> SettingsPresets::names() const
{
    std::vector<std::string> found = stems();
    std::erase_if(found, [](const std::string& name) { return presetNameDefect(name, longestName).has_value(); });
    return found;
}

std::vector<Error> SettingsPresets::misnamed() const
{
    std::vector<Error> found;
    for (const std::string& name : stems())
        if (const auto defect = presetNameDefect(name, longestName))
            found.push_back({defect->code, name + ".json", defect->message});
    return found;
}

Result<std::string> SettingsPresets::text(const std::string& name) const
{
    if (auto defect = presetNameDefect(name, longestName))
        return *std::move(defect);
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(pathOf(name), unknown)) // a pipe would be waited for
        return Error{ErrorCode::io, {}, "is no file that can be read"};
    return readWholeFile(pathOf(name), largestSettingsText);
}

bool SettingsPresets::exists(const std::string& name) const
{
    std::error_code unknown;
    return !presetNameDefect(name, longestName) && std::filesystem::exists(pathOf(name), unknown);
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
        return Error{ErrorCode::io, textOf(home), failed.message()};
    const auto written = writeFileAtomically(pathOf(name), settings, replace ? Existing::replace : Existing::keep);
    if (!written)
        return written.error();
    return {};
}

Result<void> SettingsPresets::rename(const std::string& name, const std::string& wanted) const
{
    for (const std::string& each : {name, wanted})
        if (auto defect = presetNameDefect(each, longestName))
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
    if (auto defect = presetNameDefect(name, longestName))
        return *std::move(defect);
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
    return playbackSettingsJson({settings, {}, {}}).dump(2) + "\n";
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
    return playbackSettingsJson({{}, settings, {}}).dump(2) + "\n";
}

Result<CharacterSettings> readCharacterSettings(const std::filesystem::path& path)
{
    const auto settings = readSettingsFile(path);
    if (!settings)
        return settings.error();
    if (settings->playback.character)
        return *settings->playback.character;
    if (settings->playback.live)
        return characterOf(*settings->playback.live);
    return Error{ErrorCode::invalidData, "character", "is missing; these settings have no part \"character\""};
}

std::string liveSettings(const TranslatorParams& params)
{
    return playbackSettingsJson({{}, {}, params}).dump(2) + "\n";
}

Result<TranslatorParams> readLiveSettings(std::string_view text)
{
    const auto settings = readSettings(text);
    if (!settings)
        return settings.error();
    return liveParamsOf(*settings);
}

} // namespace pacini
