#pragma once

// Edit operations as data: a layer over an analysis, applied again when the analysis changes.

#include "document/ChunkedList.h"

#include <pacini/clip/edits/RangeEdits.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace pacini
{

/// Replaces the points of one lane between two times. All tools store edits of points in this form.
struct LanePatch
{
    Lane lane;
    TimeRange range;
    Curve points; ///< inside the range
    bool operator==(const LanePatch&) const = default;
};

/// One transient added (no `before`), removed (no `after`) or changed.
struct TransientPatch
{
    std::optional<Transient> before;
    std::optional<Transient> after;
    bool operator==(const TransientPatch&) const = default;
};

/// All markers, replaced.
struct MarkersEdit
{
    std::vector<Marker> markers;
    bool operator==(const MarkersEdit&) const = default;
};

struct RenameEdit
{
    std::string name;
    bool operator==(const RenameEdit&) const = default;
};

// The edits of RangeEdits.h and TimeEdits.h with their arguments.

struct GainEdit
{
    EditScope scope;
    double decibels = 0.0;
    bool operator==(const GainEdit&) const = default;
};

struct FadeEdit
{
    EditScope scope;
    FadeDirection direction = FadeDirection::in;
    FadeShape shape = FadeShape::linear;
    bool operator==(const FadeEdit&) const = default;
};

struct InvertEdit
{
    EditScope scope;
    bool operator==(const InvertEdit&) const = default;
};

struct QuantiseEdit
{
    EditScope scope;
    TimeGrid grid;
    bool operator==(const QuantiseEdit&) const = default;
};

struct HumaniseEdit
{
    EditScope scope;
    Humanisation amount;
    bool operator==(const HumaniseEdit&) const = default;
};

struct TransposeEdit
{
    double semitones = 0.0;
    bool operator==(const TransposeEdit&) const = default;
};

struct TrimEdit
{
    TimeRange range;
    bool operator==(const TrimEdit&) const = default;
};

struct CutEdit
{
    TimeRange range;
    bool operator==(const CutEdit&) const = default;
};

/// Pasting a clip into another; at the end of a clip it is joining.
struct InsertEdit
{
    double time = 0.0;
    std::shared_ptr<const Clip> part;
    bool operator==(const InsertEdit& other) const
    {
        return time == other.time && (part == other.part || (part && other.part && *part == *other.part));
    }
};

struct RepeatEdit
{
    int passes = 2;
    bool operator==(const RepeatEdit&) const = default;
};

struct ReverseEdit
{
    bool operator==(const ReverseEdit&) const = default;
};

struct StretchEdit
{
    double ratio = 1.0;
    bool operator==(const StretchEdit&) const = default;
};

/// See thinTransients().
struct ThinEdit
{
    TimeRange range;
    double gap = 0.0;     ///< s
    double weakest = 0.0; ///< amplitude
    bool operator==(const ThinEdit&) const = default;
};

/// Another clip altogether: changes of bands or duration that no other edit describes.
struct ReplaceEdit
{
    std::shared_ptr<const Clip> clip;
    bool operator==(const ReplaceEdit& other) const
    {
        return clip == other.clip || (clip && other.clip && *clip == *other.clip);
    }
};

using EditOperation = std::variant<LanePatch, TransientPatch, MarkersEdit, RenameEdit, GainEdit, FadeEdit, InvertEdit,
                                   QuantiseEdit, HumaniseEdit, TransposeEdit, TrimEdit, CutEdit, InsertEdit, RepeatEdit,
                                   ReverseEdit, StretchEdit, ReplaceEdit, ThinEdit>;

/// An operation and the frequencies of its lanes: for each lane of the operation, in order, `frequencies` has the
/// centre of its band at the time of the edit (0 for envelope and centroid), to find it among other bands.
struct Edit
{
    EditOperation operation;
    std::vector<double> frequencies;
    double duration = 0.0; ///< s, of the clip that was edited
    bool operator==(const Edit&) const = default;
};

using EditList = ChunkedList<std::shared_ptr<const Edit>>;

} // namespace pacini
