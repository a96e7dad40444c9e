#pragma once

// Place in a project where someone works.

#include "io/Fields.h"

#include <pacini/clip/edits/Lane.h>

#include <optional>
#include <type_traits>

namespace pacini
{

/// The clip that is shown and what is seen of it. Files keep it beside a project: it is no part of one, and undo does
/// not know of it.
struct WorkPlace
{
    int clip = 0;                   ///< its id; 0: none, or the first
    double playhead = 0.0;          ///< s
    std::optional<TimeRange> range; ///< that is selected
    std::optional<TimeRange> view;  ///< that is seen; without it: all
    bool operator==(const WorkPlace&) const = default;
};

/// The fields of a place, for readers and writers of files.
template <typename Place, typename Visitor>
void visitPlace(Place& place, Visitor& visitor)
{
    const auto visitRange = [&](const char* from, const char* to, auto& range)
    {
        std::optional<double> first, last;
        if (range)
        {
            first = range->from;
            last = range->to;
        }
        visitor.optionalNumber(from, first);
        visitor.optionalNumber(to, last);
        if constexpr (!std::is_const_v<Place>)
            range = first && last && *last > *first ? std::optional(TimeRange{*first, *last}) : std::nullopt;
    };
    visitor.integer("clip", place.clip, "must be a whole number");
    visitor.number("playhead", place.playhead, Need::optional);
    visitRange("selectionFrom", "selectionTo", place.range);
    visitRange("viewFrom", "viewTo", place.view);
}

} // namespace pacini
