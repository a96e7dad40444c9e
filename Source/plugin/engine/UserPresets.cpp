// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/UserPresets.h"

#include "io/AtomicFile.h"
#include "io/FileNames.h"
#include "io/InputFile.h"
#include "plugin/engine/PluginState.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace pacini::plugin
{

namespace
{
constexpr std::string_view ending = ".json";

std::string textOf(const std::filesystem::path& path)
{
    const std::u8string text = path.u8string();
    return {text.begin(), text.end()};
}
} // namespace

std::filesystem::path UserPresets::pathOf(std::string_view name) const
{
    const std::u8string file(name.begin(), name.end());
    return home / std::filesystem::path(file + std::u8string(ending.begin(), ending.end()));
}

UserPresets::Listing UserPresets::list() const
{
    Listing found;
    std::vector<std::filesystem::path> files;
    std::error_code failed;
    for (std::filesystem::directory_iterator at(home, failed), end; !failed && at != end; at.increment(failed))
        if (const auto& path = at->path(); path.extension() == ending && !textOf(path.filename()).starts_with('.'))
            files.push_back(path);
    std::sort(files.begin(), files.end());
    files.resize(std::min(files.size(), most));
    for (const auto& file : files)
    {
        std::error_code unknown;
        const bool regular = std::filesystem::is_regular_file(file, unknown); // a pipe would be waited for
        auto text = regular ? readWholeFile(file, largestFile)
                            : Result<std::string>(Error{ErrorCode::io, {}, "is no file that can be read"});
        const auto params = text ? readPreset(*text) : Result<TranslatorParams>(text.error());
        if (params)
            found.presets.push_back({textOf(file.stem()), *params});
        else
            found.broken.push_back({params.error().code, textOf(file.filename()), params.error().text()});
    }
    return found;
}

bool UserPresets::exists(std::string_view name) const
{
    std::error_code unknown;
    return !presetNameDefect(name, longestName) && std::filesystem::exists(pathOf(name), unknown);
}

Result<void> UserPresets::save(std::string_view name, const TranslatorParams& params, bool replace) const
{
    if (auto defect = presetNameDefect(name, longestName))
        return *std::move(defect);
    std::error_code failed;
    std::filesystem::create_directories(home, failed);
    if (failed)
        return Error{ErrorCode::io, textOf(home), failed.message()};
    const auto written =
        writeFileAtomically(pathOf(name), presetText(params), replace ? Existing::replace : Existing::keep);
    if (!written)
        return written.error();
    return {};
}

Result<void> UserPresets::remove(std::string_view name) const
{
    if (auto defect = presetNameDefect(name, longestName))
        return *std::move(defect);
    std::error_code failed;
    if (!std::filesystem::remove(pathOf(name), failed))
        return Error{ErrorCode::io, std::string(name),
                     failed ? failed.message() : std::string("is not there any more")};
    return {};
}

} // namespace pacini::plugin
