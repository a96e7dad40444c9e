#pragma once

// Field lists of edits in JSON, for their readers and writers.

#include "document/Edit.h"
#include "io/Fields.h"
#include "io/LaneKinds.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace pacini::projectFields
{

inline constexpr std::size_t most = 10'000'000; ///< entries of a list

inline constexpr std::array<Choice<FadeDirection>, 2> fadeDirections = {
    {{"in", FadeDirection::in}, {"out", FadeDirection::out}}};
inline constexpr std::array<Choice<FadeShape>, 3> fadeShapes = {
    {{"linear", FadeShape::linear}, {"smooth", FadeShape::smooth}, {"square", FadeShape::square}}};

/// Names of the alternatives of EditOperation, in their order.
inline constexpr std::array<Choice<std::size_t>, 18> editKinds = {{{"points", 0},
                                                                   {"transient", 1},
                                                                   {"markers", 2},
                                                                   {"name", 3},
                                                                   {"gain", 4},
                                                                   {"fade", 5},
                                                                   {"invert", 6},
                                                                   {"quantise", 7},
                                                                   {"humanise", 8},
                                                                   {"transpose", 9},
                                                                   {"trim", 10},
                                                                   {"cut", 11},
                                                                   {"insert", 12},
                                                                   {"repeat", 13},
                                                                   {"reverse", 14},
                                                                   {"stretch", 15},
                                                                   {"replace", 16},
                                                                   {"thin", 17}}};
static_assert(editKinds.size() == std::variant_size_v<EditOperation>);

/// An empty operation of alternative `kind`.
template <std::size_t I = 0>
[[nodiscard]] EditOperation operationOfKind(std::size_t kind)
{
    if constexpr (I + 1 < std::variant_size_v<EditOperation>)
        if (kind != I)
            return operationOfKind<I + 1>(kind);
    return EditOperation(std::in_place_index<I>);
}

/// Numbers of 64 bits are texts: JSON readers keep only 53.
template <typename Number, typename Visitor>
void visitWhole(Number& value, const char* name, Visitor& visitor)
{
    std::string text = std::to_string(value);
    visitor.text(name, text);
    if constexpr (isReader<Visitor>)
        if (std::from_chars(text.data(), text.data() + text.size(), value).ptr != text.data() + text.size())
            visitor.fail(name, "must be a whole number in quotes");
}

template <typename Lane, typename Visitor>
void visitLane(Lane& lane, Visitor& visitor)
{
    constexpr auto nowhere = std::numeric_limits<std::size_t>::max();
    visitor.choice("lane", lane.kind, laneKinds, Need::required);
    int index = lane.index == nowhere ? -1 : static_cast<int>(lane.index);
    visitor.integer("band", index, "must be a whole number");
    if constexpr (isReader<Visitor>)
        lane.index = index < 0 ? nowhere : static_cast<std::size_t>(index);
}

template <typename Range, typename Visitor>
void visitRange(Range& range, Visitor& visitor)
{
    visitor.number("from", range.from, Need::required);
    visitor.number("to", range.to, Need::required);
}

template <typename Scope, typename Visitor>
void visitScope(Scope& scope, Visitor& visitor)
{
    visitRange(scope.range, visitor);
    visitor.truth("allLanes", scope.allLanes);
    visitor.list("lanes", scope.lanes, most, "lanes", [&](auto& lane) { visitLane(lane, visitor); });
    visitor.truth("transients", scope.transients);
}

template <typename Event, typename Visitor>
void visitTransient(Event& event, Visitor& visitor)
{
    visitor.number("time", event.time, Need::required);
    visitor.number("amplitude", event.amplitude, Need::required);
    visitor.number("sharpness", event.sharpness, Need::required);
}

template <typename T, typename U>
concept SameAs = std::is_same_v<std::remove_const_t<T>, U>;

template <typename Operation, typename Visitor>
void visitOperation(Operation& e, Visitor& visitor)
{
    using enum Need;
    if constexpr (requires { e.scope; })
        visitScope(e.scope, visitor);
    if constexpr (requires { e.range; })
        visitRange(e.range, visitor);
    if constexpr (SameAs<Operation, LanePatch>)
    {
        visitLane(e.lane, visitor);
        visitor.list("points", e.points, most, "points",
                     [&](auto& p)
                     {
                         visitor.number("time", p.time, required);
                         visitor.number("value", p.value, required);
                     });
    }
    else if constexpr (SameAs<Operation, TransientPatch>)
    {
        visitor.optionalObject("before", e.before, [&](auto& event) { visitTransient(event, visitor); });
        visitor.optionalObject("after", e.after, [&](auto& event) { visitTransient(event, visitor); });
    }
    else if constexpr (SameAs<Operation, MarkersEdit>)
        visitor.list("markers", e.markers, most, "markers",
                     [&](auto& marker)
                     {
                         visitor.number("time", marker.time, required);
                         visitor.text("name", marker.name);
                     });
    else if constexpr (SameAs<Operation, RenameEdit>)
        visitor.text("name", e.name);
    else if constexpr (SameAs<Operation, GainEdit>)
        visitor.number("decibels", e.decibels, required);
    else if constexpr (SameAs<Operation, FadeEdit>)
    {
        visitor.choice("direction", e.direction, fadeDirections, required);
        visitor.choice("shape", e.shape, fadeShapes, required);
    }
    else if constexpr (SameAs<Operation, QuantiseEdit>)
    {
        visitor.number("step", e.grid.step, required);
        visitor.number("origin", e.grid.origin, required);
        visitor.number("strength", e.grid.strength, required);
    }
    else if constexpr (SameAs<Operation, HumaniseEdit>)
    {
        visitor.number("time", e.amount.time, required);
        visitor.number("level", e.amount.level, required);
        visitor.number("pitch", e.amount.pitch, required);
        visitWhole(e.amount.seed, "seed", visitor);
    }
    else if constexpr (SameAs<Operation, TransposeEdit>)
        visitor.number("semitones", e.semitones, required);
    else if constexpr (SameAs<Operation, InsertEdit>)
    {
        visitor.number("time", e.time, required);
        visitor.clip("clip", e.part);
    }
    else if constexpr (SameAs<Operation, RepeatEdit>)
        visitor.integer("passes", e.passes, "must be a whole number");
    else if constexpr (SameAs<Operation, StretchEdit>)
        visitor.number("ratio", e.ratio, required);
    else if constexpr (SameAs<Operation, ReplaceEdit>)
        visitor.clip("clip", e.clip);
    else if constexpr (SameAs<Operation, ThinEdit>)
    {
        visitor.number("gap", e.gap, required);
        visitor.number("weakest", e.weakest, required);
    }
}

template <typename AnyEdit, typename Visitor>
void visitEdit(AnyEdit& edit, Visitor& visitor)
{
    std::size_t kind = edit.operation.index();
    visitor.choice("kind", kind, editKinds, Need::required);
    if constexpr (isReader<Visitor>)
        edit.operation = operationOfKind(kind);
    std::visit([&](auto& operation) { visitOperation(operation, visitor); }, edit.operation);
    visitor.list("frequencies", edit.frequencies, most, "frequencies",
                 [&](auto& frequency) { visitor.number("frequency", frequency, Need::required); });
    visitor.number("clipDuration", edit.duration, Need::required);
}

} // namespace pacini::projectFields
