// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Presets of the user: a folder of files beside the shipped presets.

#include <pacini/foundation/Result.h>
#include <pacini/realtime/TranslatorParams.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::plugin
{

/// A preset of the user; as the shipped ones it leaves routing, actuators and bypass as they are.
struct UserPreset
{
    std::string name;
    TranslatorParams params;
};

/// One file for each preset, `NAME.json`, in the form of the plugin's states (see PluginState.h). All of it [message].
class UserPresets
{
public:
    static constexpr std::size_t largestFile = 1'000'000; ///< bytes
    static constexpr std::size_t longestName = 80;        ///< bytes
    static constexpr std::size_t most = 500;              ///< that are listed

    /// The folder need not exist: the first preset makes it.
    explicit UserPresets(std::filesystem::path wanted) : home(std::move(wanted)) {}

    [[nodiscard]] const std::filesystem::path& folder() const noexcept { return home; }

    struct Listing
    {
        std::vector<UserPreset> presets; ///< by name
        std::vector<Error> broken;       ///< files that cannot be used, `where` their names
    };
    [[nodiscard]] Listing list() const;

    /// Whether there is a file of this name, be it whole or broken.
    [[nodiscard]] bool exists(std::string_view name) const;

    /// Writes a preset as a whole or not at all. Errors: invalidArgument for a name that is empty, longer than
    /// `longestName`, or that not all systems allow for files; io or diskFull for a file that cannot be written, and
    /// for one that is there already unless it may be replaced.
    Result<void> save(std::string_view name, const TranslatorParams& params, bool replace) const;

    /// Errors: those of names, and io.
    Result<void> remove(std::string_view name) const;

private:
    [[nodiscard]] std::filesystem::path pathOf(std::string_view name) const;

    std::filesystem::path home;
};

} // namespace pacini::plugin
