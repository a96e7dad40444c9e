#pragma once

// Transfer of hand edits to another analysis.

#include "document/Edit.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pacini
{

/// An edit that has found no place.
struct UnfittingEdit
{
    std::size_t edit = 0; ///< index into the list of edits
    std::string reason;   ///< in plain words
    bool operator==(const UnfittingEdit&) const = default;
};

/// Result of applying the edits of a clip to another analysis.
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
