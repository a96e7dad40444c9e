#pragma once

// Document: an open project with its file and its undo history.

#include "document/History.h"
#include "document/Project.h"
#include "document/WorkPlace.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Id of a gesture (a drag, a turn of a knob), whose steps are one step of undo. 0: a step of its own.
using Gesture = std::uint64_t;

/// State of a document as an autosave needs it, to go to another thread. Copying it is cheap.
struct DocumentSnapshot
{
    Project project;
    std::filesystem::path path; ///< empty: never saved
    std::uint64_t state = 0;    ///< differs when anything differs
    bool dirty = false;
    WorkPlace place = {}; ///< of who works on it; its change alone is no other state
};

/// One project with its file and its history. Changes are pure functions (ProjectEdits.h), which become steps with a
/// name here, or what is no step (Amendments.h). What fails changes nothing. One thread. [message]
class Document
{
public:
    /// A new project without a file.
    Document() : Document(Project{}, {}, true) {}

    /// A project without a file, as it was saved elsewhere.
    explicit Document(Project project) : Document(std::move(project), {}, true) {}

    /// Opens a project file. Errors: io as in readWholeFile, and those of readProjectJson().
    [[nodiscard]] static Result<Document> open(const std::filesystem::path& path);

    /// Opens what an autosave has written as the project that it was: not saved, under its old path.
    [[nodiscard]] static Result<Document> recover(const std::filesystem::path& recoveryFile);

    /// Writes the project to its file, or to `path`, which becomes its file. On an error (io, or invalidArgument
    /// without a path) the file that was there is untouched and the project stays as it is.
    [[nodiscard]] Result<void> save();
    [[nodiscard]] Result<void> saveAs(const std::filesystem::path& path);

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return file; }
    [[nodiscard]] bool isDirty() const noexcept { return savedState != history.id() && !isUntouched(); }
    /// Nothing but an actuator has been in it yet, and it has no file: there is nothing to lose. One whose last clip
    /// was removed is another thing: that can be undone.
    [[nodiscard]] bool isUntouched() const noexcept
    {
        return file.empty() && content.clips.empty() && content.sources.empty() && history.size() == 1;
    }
    [[nodiscard]] const Project& project() const noexcept { return content; }
    [[nodiscard]] DocumentSnapshot snapshot() const { return {content, file, history.id(), isDirty(), {}}; }

    /// A clip with all that belongs to it, or null. Immutable: views and threads may keep it.
    [[nodiscard]] std::shared_ptr<const ClipItem> clip(int id) const { return content.find(id); }

    // Changes.

    /// Makes a step with a name, or hands on the error of `next`, which a function of ProjectEdits.h made of project().
    /// A step that changes nothing is none. Of a gesture, whose steps are made of gestureStart(), each takes the place
    /// of the one before.
    Result<void> commit(std::string name, Result<Project> next, Gesture gesture = 0);

    /// Makes a change that is no step: undo goes on with the edits, and every state has it then. `added` stand behind
    /// its clips; `change` leaves those alone.
    void amend(const std::vector<std::shared_ptr<const ClipItem>>& added, const std::function<void(Project&)>& change);

    /// Begins a gesture: all steps that carry it start from the project as it was before the first of them.
    [[nodiscard]] Gesture beginGesture() noexcept { return ++lastGesture; }

    /// The project that steps of a gesture start from: the current one when the gesture has none yet.
    [[nodiscard]] const Project& gestureStart(Gesture gesture) const noexcept
    {
        return gesture != 0 && gesture == openGesture ? beforeGesture : content;
    }

    // Undo.

    [[nodiscard]] const History& steps() const noexcept { return history; }
    bool undo();
    bool redo();

    /// Goes to any state of steps(); larger indices mean the newest.
    void goTo(std::size_t state);

private:
    Document(Project project, std::filesystem::path path, bool saved);

    Project content;
    std::filesystem::path file;
    History history;
    std::uint64_t savedState = 0; ///< id of the state in the file; 0: none
    Gesture lastGesture = 0;
    Gesture openGesture = 0; ///< of the newest state
    Project beforeGesture;
};

} // namespace pacini
