#pragma once

// Application of hand edits to a clip.

#include "document/Edit.h"

#include <pacini/foundation/Result.h>

namespace pacini
{

/// An edit ready to be kept: lanes get their frequencies from the clip that is edited.
[[nodiscard]] Edit anchored(EditOperation operation, const Clip& clip);

/// The clip after one edit; it passes validate() when `clip` did. Errors: those of joinClips() and stretchClip() where
/// the result would be too large; invalidData when the operation itself holds what no clip may.
[[nodiscard]] Result<Clip> applyEdit(const Clip& clip, const EditOperation& operation);

/// The clip with a transient put in place of another; as it was when the other is not there.
[[nodiscard]] Clip withTransient(Clip clip, const TransientPatch& patch);

} // namespace pacini
