#pragma once

// Hand edits over an analysis: made, applied, and applied anew to another analysis.

#include "document/Edit.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pacini
{

/// An edit ready to be kept: lanes get their frequencies from the clip that is edited.
[[nodiscard]] Edit anchored(EditOperation operation, const Clip& clip);

/// The clip after one edit; it passes validate() when `clip` did. Errors: those of joinClips() and stretchClip() where
/// the result would be too large; invalidData when the operation itself holds what no clip may.
[[nodiscard]] Result<Clip> applyEdit(const Clip& clip, const EditOperation& operation);

/// The edits that make `after` of `before`, both valid, exactly: patches where only points, transients, markers or the
/// name differ, else one ReplaceEdit. Empty for equal clips. A patch reaches to the neighbours of what has changed, so
/// that over another analysis the shape between them is what was seen. Source and encoder entries are no edits: those
/// of `after` must be those of `before`, or the clip is replaced.
[[nodiscard]] std::vector<EditOperation> editsBetween(const Clip& before, const Clip& after);

/// An edit that has found no place.
struct UnfittingEdit
{
    std::size_t edit = 0; ///< index into the list of edits
    std::string reason;   ///< in plain words
    bool operator==(const UnfittingEdit&) const = default;
};

/// What the edits of a clip make of another analysis.
struct Reapplied
{
    Clip clip;
    std::vector<Edit> edits; ///< all of them, in the time of the new analysis; those that do not fit wait for the next
    std::vector<UnfittingEdit> unfitting;
};

/// Applies edits that were made over `before` to `after`, another analysis of this sound or of one that replaces it.
/// Times follow the events: transients of both analyses are matched (after the shift that matches most of them), times
/// between two matched events move in proportion, those before the first and behind the last with it. Values stay.
/// Bands are found by frequency. Both clips valid. [worker]
[[nodiscard]] Reapplied reapply(const Clip& before, const Clip& after, const std::vector<Edit>& edits);

} // namespace pacini
