#pragma once

// Steps of a project: pure functions from a project to the changed one, for Document::commit(). They take the project
// by value, which is cheap. Error invalidArgument (`clip`): no such clip.

#include "document/Edit.h"
#include "document/Project.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

// Hand edits, kept as a layer over the analysis. Errors beside that: numbers that are not finite, those of applyEdit().

/// Applies an operation to a clip.
[[nodiscard]] Result<Project> withEdit(Project project, int id, EditOperation operation);

/// Takes a clip that was edited by the functions of Core/pacini/clip/edits; what has changed becomes the edit. With
/// `first`, `edited` was made of the clip after that operation, which is kept too. Errors: those of validate(edited).
[[nodiscard]] Result<Project> withClip(Project project, int id, Clip edited, std::optional<EditOperation> first = {});

/// Removes edits by their indices (ascending) and applies the others anew.
[[nodiscard]] Result<Project> withoutEdits(Project project, int id, const std::vector<std::size_t>& edits);

// Clips and their analysis.

struct Reanalysis
{
    int id = 0; ///< of the clip
    Clip analysis;
    std::optional<AudioReference> sound = {}; ///< in place of the old one
};

/// Puts another analysis under the edits of a clip: other parameters, or another sound, whose id is `newSource` unless
/// the project has it. Markers of the old analysis of the same sound are kept. What does not fit any more is listed in
/// the clip's `unfitting` and waits there. Errors: those of validate() of both.
[[nodiscard]] Result<Project> withAnalysis(Project project, const EncoderParams& encoder, Reanalysis one,
                                           int newSource);
/// The same for several clips.
[[nodiscard]] Result<Project> withAnalyses(Project project, const EncoderParams& encoder, std::vector<Reanalysis> clips,
                                           int newSource);

/// Puts a clip back as it was once, with its analysis and edits; its id says which. Where its sound is not in the
/// project any more, it has none.
[[nodiscard]] Result<Project> withRestored(Project project, ClipItem item);

/// A copy of a clip behind it, with the id `added`.
[[nodiscard]] Result<Project> withDuplicate(Project project, int id, int added);

/// Splits a clip in two; the right part is a new clip behind it, with the id `added`.
[[nodiscard]] Result<Project> withSplit(Project project, int id, double time, int added);

/// Puts another clip of the project behind a clip, as joinClips(), and takes it out of the project. invalidArgument too
/// where both are one; errors of joinClips().
[[nodiscard]] Result<Project> withJoined(Project project, int id, int other);

[[nodiscard]] Result<Project> withoutClips(Project project, const std::vector<int>& ids);

// List of clips.

/// Moves a clip to a place in the list (larger ones mean the end), and into a group (empty: out of its group), which is
/// added when it is new.
[[nodiscard]] Result<Project> withPlaced(Project project, int id, std::size_t index, const std::string& group);

/// Puts clips into a group, which is added when it is new, in their places; empty: out of theirs.
[[nodiscard]] Result<Project> withGroup(Project project, const std::vector<int>& ids, const std::string& group);

/// Gives a group another name; that of another group joins the two, an empty one leaves its clips without a group.
[[nodiscard]] Project withGroupRenamed(Project project, const std::string& from, const std::string& to);
[[nodiscard]] Project withGroups(Project project, std::vector<std::string> groups);

[[nodiscard]] Result<Project> withNotes(Project project, int id, const std::string& notes);
[[nodiscard]] Result<Project> withTags(Project project, const std::vector<int>& ids,
                                       const std::vector<std::string>& tags);
[[nodiscard]] Project withProjectNotes(Project project, std::string notes);

// Scene and sounds.

/// Errors: those of validate(scene).
[[nodiscard]] Result<Project> withScene(Project project, ProjectScene scene);

/// Other places, or embedded copies or none, for sounds with the ids of `sounds`. invalidArgument (`sound`): no such.
[[nodiscard]] Result<Project> withSounds(Project project, std::vector<AudioReference> sounds);

/// The sound of a project that is the same file with the same content, or null.
[[nodiscard]] const AudioReference* sameSound(const Project& project, const AudioReference& sound);

/// Adds a group to the list of groups; nothing where it is empty or known.
void addGroup(Project& project, const std::string& group);

} // namespace pacini
