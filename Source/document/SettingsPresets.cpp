#include "document/AnalysisPresets.h"

#include "io/AtomicFile.h"
#include "io/FileNames.h"
#include "io/SettingsFile.h"

#include <pacini/analysis/methods/MethodChoices.h>

#include <algorithm>
#include <system_error>

namespace pacini
{

std::vector<std::string> AnalysisPresets::names() const
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

std::filesystem::path AnalysisPresets::pathOf(const std::string& name) const
{
    return home / std::filesystem::path(std::u8string(name.begin(), name.end()) + u8".json");
}

Result<void> AnalysisPresets::save(const std::string& name, const EncoderParams& params, bool replace) const
{
    if (auto defect = presetNameDefect(name, longestName))
        return *std::move(defect);
    std::error_code failed;
    std::filesystem::create_directories(home, failed);
    if (failed)
        return Error{ErrorCode::io, home.string(), failed.message()};
    const auto text = settingsJson({Method::a2vt, params, {}}, {}).dump(2) + "\n";
    const auto written = writeFileAtomically(pathOf(name), text, replace ? Existing::replace : Existing::keep);
    if (!written)
        return written.error();
    return {};
}

Result<EncoderParams> readAnalysisSettings(const std::filesystem::path& path)
{
    const auto settings = readSettingsFile(path);
    if (!settings)
        return settings.error();
    const auto translation = translationOf(*settings);
    if (!translation)
        return translation.error();
    if (translation->method != Method::a2vt)
        return Error{ErrorCode::invalidArgument, "method", "is not one of the editor's; it analyses with a2vt"};
    return translation->params;
}

} // namespace pacini
