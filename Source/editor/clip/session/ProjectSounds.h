// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Source sounds of the project's clips: reading, analysis, search for missing ones, embedding.

#include "editor/clip/session/EditorModel.h"
#include "editor/clip/session/Importer.h"
#include "editor/clip/session/Jobs.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace pacini::editor
{

/// Reads and analyses in the background, which ends when another project is opened. [message]
class ProjectSounds
{
public:
    explicit ProjectSounds(EditorModel& project);
    ~ProjectSounds();

    Signal changed;     ///< the sound of the clip has been read, or a sound is missing or found
    Signal replaced;    ///< another sound is under the clip that is shown
    Signal workChanged; ///< reading and analysing has begun or ended

    /// Some sounds of the project are not where they were.
    std::function<void(const std::vector<AudioReference>& missing)> onSoundsMissing;

    /// Reads sounds, clips, projects and folders of sounds and clips in the background, see Importer. A project
    /// replaces the open one.
    void openFiles(const std::vector<std::filesystem::path>& files);
    /// Adds what was read and shows it.
    void add(Imported imported);
    /// The same without showing it.
    Result<int> insert(Imported imported);

    /// What is being read or analysed; nothing when all is done.
    [[nodiscard]] std::optional<WorkState> workNow() const;
    /// Cancels the remaining work.
    void stopWork();

    /// Of the clip that is shown; also a sound that is being analysed.
    [[nodiscard]] std::shared_ptr<const Sound> soundOfClip() const;
    /// Analyses the sound of the clip with other parameters; the newest wish counts.
    void reanalyse(const EncoderParams& wanted);
    /// Analyses the sounds of several clips with the same parameters, as one step; clips without a sound are left out.
    void reanalyse(const std::vector<int>& clips, const EncoderParams& wanted);
    /// Puts another sound under the edits of the clip.
    void replaceSound(const std::filesystem::path& file);
    /// Whether a sound is not where it was.
    [[nodiscard]] bool isMissing(int sourceId) const { return missing.contains(sourceId); }
    /// Looks for all missing sounds: `chosen` is one of them, or lies beside them.
    void findSounds(const std::filesystem::path& chosen);
    /// Keeps a copy of a sound inside the project, or no longer.
    void keepSound(int sourceId, bool wanted);

private:
    /// An analysis for a clip that exists.
    struct Again
    {
        int clip = 0;
        EncoderParams params;
        std::string name; ///< of the step
        std::shared_ptr<Task> task;
    };

    void forget();
    void load();
    void lookForAll();
    void analyseAgain(Again wanted, const std::function<Result<Imported>()>& read);
    void putAgain(const Again& done, Result<Imported> analysed, bool otherSound);
    void stopAnalysis();

    EditorModel& model;
    std::map<int, std::shared_ptr<const Sound>> sounds; ///< by id of the reference
    std::set<int> missing, loading;                     ///< ids of references
    std::shared_ptr<Task> again;                        ///< the newest analysis of a clip that exists
    juce::String againText;
    std::uint64_t generation = 0; ///< counts the projects that were open
    Jobs jobs;
    Importer importer;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
