#pragma once

// Helpers of Document that change clips and sounds of a project.

#include "document/Project.h"

#include <pacini/foundation/Result.h>

#include <vector>

namespace pacini
{

[[nodiscard]] Error noSuchClip(int id);

[[nodiscard]] EditList withEdits(EditList list, std::vector<Edit> edits);
[[nodiscard]] std::vector<Edit> listOf(const EditList& edits);

/// Gives an item the clip and the edits of another analysis; edits that are as they were stay shared.
void putReapplied(ClipItem& item, Reapplied reapplied);

/// The sound of a project that is the same file with the same content, or null.
[[nodiscard]] const AudioReference* sameSound(const Project& project, const AudioReference& sound);

/// The id of a sound in a project, where it is put with its id if the same is not there yet.
[[nodiscard]] int placeSound(Project& project, AudioReference sound);

} // namespace pacini
