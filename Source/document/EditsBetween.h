#pragma once

// Difference of two clips, as edits.

#include "document/Edit.h"

#include <vector>

namespace pacini
{

/// The edits that make `after` of `before`, both valid, exactly: patches where only points, transients, markers or the
/// name differ, else one ReplaceEdit. Empty for equal clips. A patch reaches to the neighbours of what has changed, so
/// that over another analysis the shape between them is what was seen. Source and encoder entries are no edits: those
/// of `after` must be those of `before`, or the clip is replaced.
[[nodiscard]] std::vector<EditOperation> editsBetween(const Clip& before, const Clip& after);

} // namespace pacini
