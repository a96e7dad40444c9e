// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Background import of sounds, clips and folders into the project.

#include "editor/clip/session/Sound.h"

#include <juce_core/juce_core.h>

#include <atomic>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace pacini::editor
{

class EditorModel;
class Jobs;
class ProjectSounds;

/// Work in the background that can be watched and stopped; shared by its thread and the message thread.
struct Task
{
    std::atomic<double> progress{-1.0}; ///< 0 to 1; below 0: nobody knows
    std::atomic<bool> stopped{false};

    /// For analyse(). [worker]
    bool goOn(double done) noexcept
    {
        progress = done;
        return !stopped;
    }
};

/// State of the background work, for a progress bar.
struct WorkState
{
    juce::String text;
    double progress = -1.0; ///< as in Task
    bool operator==(const WorkState&) const = default;
};

/// One file after another is read and, if it is a sound, analysed; meanwhile the first of them is shown as a
/// waveform. The others are added to the project without changing the view. Failures are reported once, at the end.
/// [message]
class Importer
{
public:
    Importer(EditorModel& project, ProjectSounds& projectSounds, Jobs& worker)
        : model(project), sounds(projectSounds), jobs(worker)
    {
    }

    /// Folders stand for all openableFiles() in them.
    void add(const std::vector<std::filesystem::path>& files);

    /// What is not in the project yet will not be.
    void stop();

    /// Nothing when all is done.
    [[nodiscard]] std::optional<WorkState> state() const;

private:
    void next();
    void list(const std::filesystem::path& folder);
    void read(const std::filesystem::path& file);
    void analyseSound(Imported read);
    void put(Imported imported);
    void putScene(const std::filesystem::path& file, const Imported& imported);
    void fail(const std::filesystem::path& file, const Error& error);
    void finish();
    void tellWork();

    EditorModel& model;
    ProjectSounds& sounds;
    Jobs& jobs;
    std::deque<std::filesystem::path> waiting;
    std::shared_ptr<Task> task; ///< of what is being done; null: nothing
    juce::String doing;
    std::size_t begun = 0; ///< files, since there was nothing to do
    bool anyShown = false; ///< of those files
    juce::StringArray failures, gaps;
};

} // namespace pacini::editor
