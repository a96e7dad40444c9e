#pragma once

// Document: an open project with its file and its undo history.

#include "document/History.h"
#include "document/Project.h"
#include "io/ClipFile.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
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
};

/// One project with its file and its history. Every change goes through it: it is checked, becomes a step with a name,
/// and hand edits of clips are kept as a layer over their analysis. What fails changes nothing. One thread. [message]
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
        return file.empty() && content.clips.empty() && content.sources.empty() && !canUndo() && !canRedo();
    }
    [[nodiscard]] const Project& project() const noexcept { return content; }
    [[nodiscard]] DocumentSnapshot snapshot() const { return {content, file, history.id(), isDirty()}; }

    /// A clip with all that belongs to it, or null. Immutable: views and threads may keep it.
    [[nodiscard]] std::shared_ptr<const ClipItem> clip(int id) const { return content.find(id); }

    // Hand edits. Error invalidArgument: no such clip, or numbers that are not finite; else those of applyEdit().

    /// Begins a gesture: all edits that carry it start from the clip as it was before the first of them, and each takes
    /// the place of the one before.
    [[nodiscard]] Gesture beginGesture() noexcept { return ++lastGesture; }

    /// Applies an operation to a clip.
    Result<void> edit(int id, std::string name, EditOperation operation, Gesture gesture = 0);

    /// Takes a clip that was edited by the functions of Core/pacini/clip/edits; what has changed becomes the edit.
    /// Within a gesture, `edited` is made of gestureStart().
    Result<void> setClip(int id, std::string name, Clip edited, Gesture gesture = 0);

    /// The same of a clip that `first` was applied to before: both are one step.
    Result<void> setClip(int id, std::string name, EditOperation first, Clip edited);

    /// The clip that edits of a gesture start from: the current one when the gesture has none yet.
    [[nodiscard]] std::shared_ptr<const Clip> gestureStart(int id, Gesture gesture) const;

    // Clips and their analysis.

    /// Adds a clip that is its own analysis (imported, or made by hand). Errors: those of validate(clip). Opening is no
    /// step: all states have the clip then, and undo goes on with the edits.
    Result<int> addClip(Clip clip);

    /// Adds a sound and the clip that analyse() made of it, as addClip() does.
    Result<int> addSound(AudioReference sound, const EncoderParams& encoder, Clip analysis);

    /// Puts another analysis under the edits of a clip: other parameters, or `sound` in place of the old one. Markers
    /// of the old analysis of the same sound are kept. What does not fit any more is listed in the clip's `unfitting`
    /// and waits there. Errors: those of validate(analysis).
    Result<void> reanalyse(int id, std::string name, const EncoderParams& encoder, Clip analysis,
                           std::optional<AudioReference> sound = {});

    /// The same for several clips at once, as one step; where one is not valid none is changed.
    struct Reanalysis
    {
        int id = 0;
        Clip analysis;
        std::optional<AudioReference> sound = {};
    };
    Result<void> reanalyse(std::vector<Reanalysis> clips, std::string name, const EncoderParams& encoder);

    /// Removes edits by their indices (ascending) and applies the others anew.
    Result<void> removeEdits(int id, std::string name, const std::vector<std::size_t>& edits);

    /// Puts a clip back as it was once, with its analysis and edits; its id says which. Where its sound is not in the
    /// project any more, it has none.
    Result<void> restoreClip(ClipItem item, std::string name);

    Result<int> duplicateClip(int id, std::string name);
    Result<void> removeClip(int id, std::string name);
    /// Several at once; invalidArgument, and none is removed, where there is no such clip.
    Result<void> removeClips(std::span<const int> ids, std::string name);

    /// Splits a clip in two; the right part is a new clip behind it, whose id is returned.
    Result<int> splitClipAt(int id, double time, std::string name);

    /// Moves a clip to a place in the list (larger ones mean the end), and into a group (empty: out of its group),
    /// which is added when it is new.
    Result<void> placeClip(int id, std::size_t index, std::string group, std::string name);

    /// Puts another clip of the project behind a clip, as joinClips(), and takes it out of the project.
    /// invalidArgument: there is no such clip, or both are one; else the errors of joinClips().
    Result<void> joinClip(int id, int other, std::string name);

    /// Puts clips into a group, which is added when it is new, in their places; empty: out of theirs.
    Result<void> setGroup(std::span<const int> ids, const std::string& group, std::string name);
    Result<void> setGroup(int id, const std::string& group, std::string name)
    {
        return setGroup(std::span(&id, 1), group, std::move(name));
    }
    Result<void> setNotes(int id, std::string notes, std::string name);
    /// Of several clips, in one step.
    Result<void> setTags(const std::vector<int>& ids, const std::vector<std::string>& tags, std::string name);
    void setProjectNotes(std::string notes, std::string name);
    void setGroups(std::vector<std::string> groups, std::string name);

    /// The clips of a scene, in a group, and the scene itself in place of the present one. Where there was none it has
    /// been there from the start. Errors: those of validate(), then nothing changes.
    Result<void> openScene(const Scene& scene, const std::string& group, std::string name);
    /// Within a gesture, one step. Errors: those of validate(scene), then nothing is changed.
    Result<void> setScene(ProjectScene scene, std::string name, Gesture gesture = 0);

    /// Gives a group another name; that of another group joins the two, an empty one leaves its clips without a group.
    void renameGroup(const std::string& from, const std::string& to, std::string name);
    /// What the clips are felt with is no edit of them, and no step: all states have it then. Errors: invalidArgument
    /// for the strength, those of validate(*profile.embedded).
    Result<void> setProfile(ProjectProfile profile);

    /// Another place, or an embedded copy or none, for a sound whose id `sound` has.
    Result<void> setSound(AudioReference sound, std::string name);
    /// The same for several in one step.
    Result<void> setSounds(std::vector<AudioReference> sounds, std::string name);

    // Undo.

    [[nodiscard]] bool canUndo() const noexcept { return history.canUndo(); }
    [[nodiscard]] bool canRedo() const noexcept { return history.canRedo(); }
    [[nodiscard]] std::string undoName() const { return canUndo() ? history.name(history.current()) : ""; }
    [[nodiscard]] std::string redoName() const { return canRedo() ? history.name(history.current() + 1) : ""; }
    [[nodiscard]] const History& steps() const noexcept { return history; }
    bool undo();
    bool redo();

    /// Goes to any state of steps(); larger indices mean the newest.
    void goTo(std::size_t state);

private:
    Document(Project project, std::filesystem::path path, bool saved);

    Result<void> change(int id, std::string name, std::vector<Edit> edits, Clip edited, Gesture gesture);
    void commit(std::string name, Project project, Gesture gesture = 0);
    Result<void> replaceItem(ClipItem item, std::string name);
    void amend(const std::shared_ptr<const ClipItem>& added, const std::function<void(Project&)>& change);
    void countIds();

    Project content;
    std::filesystem::path file;
    History history;
    std::uint64_t savedState = 0; ///< id of the state in the file; 0: none
    Gesture lastGesture = 0;
    Gesture openGesture = 0; ///< of the newest state
    Project beforeGesture;
    int nextClipId = 1; ///< above those of all states
    int nextSourceId = 1;
};

} // namespace pacini
