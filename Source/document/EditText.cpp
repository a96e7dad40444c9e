#include "document/EditText.h"

#include <fmt/format.h>

#include <variant>

namespace pacini
{

namespace
{
std::string laneWords(const Lane& lane, double frequency)
{
    const std::string band =
        frequency > 0.0 ? fmt::format("the band at {:.0f} Hz", frequency) : fmt::format("band {}", lane.index + 1);
    switch (lane.kind)
    {
    case LaneKind::envelope:
        return "the envelope";
    case LaneKind::centroid:
        return "the centroid";
    case LaneKind::amplitude:
        return band;
    case LaneKind::pitch:
        return "the pitch of " + band;
    case LaneKind::noise:
        return "the noise of " + band;
    }
    return band;
}

std::optional<TimeRange> timeOfScope(const EditScope& scope, double duration)
{
    if (scope.range.from <= 0.0 && scope.range.to >= duration)
        return std::nullopt;
    return scope.range;
}

template <typename... Cases>
struct ByKind : Cases...
{
    using Cases::operator()...;
};
template <typename... Cases>
ByKind(Cases...) -> ByKind<Cases...>; // Clang needs it up to version 16
} // namespace

std::string editTitle(const Edit& edit)
{
    return std::visit(
        ByKind{
            [&](const LanePatch& patch)
            { return "Points of " + laneWords(patch.lane, edit.frequencies.empty() ? 0.0 : edit.frequencies.front()); },
            [](const TransientPatch& patch) {
                return std::string(!patch.before ? "Event added" : !patch.after ? "Event removed" : "Event changed");
            },
            [](const MarkersEdit&) { return std::string("Markers"); },
            [](const RenameEdit& rename) { return "Name \"" + rename.name + "\""; },
            [](const GainEdit& gain) { return fmt::format("Gain of {:+.1f} dB", gain.decibels); },
            [](const FadeEdit& fade)
            { return std::string(fade.direction == FadeDirection::in ? "Fade in" : "Fade out"); },
            [](const InvertEdit&) { return std::string("Inverted"); },
            [](const QuantiseEdit&) { return std::string("Quantised"); },
            [](const HumaniseEdit&) { return std::string("Humanised"); },
            [](const TransposeEdit& transpose)
            { return fmt::format("Transposed by {:+.1f} semitones", transpose.semitones); },
            [](const TrimEdit&) { return std::string("Trimmed"); },
            [](const CutEdit&) { return std::string("Range cut"); },
            [](const InsertEdit&) { return std::string("Clip inserted"); },
            [](const RepeatEdit& repeat) { return fmt::format("Repeated {} times", repeat.passes); },
            [](const ReverseEdit&) { return std::string("Reversed"); },
            [](const StretchEdit& stretch) { return fmt::format("Stretched to {:.0f} %", 100.0 * stretch.ratio); },
            [](const ReplaceEdit&) { return std::string("Clip replaced"); },
            [](const ThinEdit&) { return std::string("Events thinned"); },
        },
        edit.operation);
}

std::optional<TimeRange> editTime(const Edit& edit)
{
    using Time = std::optional<TimeRange>;
    const auto ofScope = [&](const auto& operation)
    {
        return timeOfScope(operation.scope, edit.duration);
    };
    return std::visit(
        ByKind{
            [](const LanePatch& patch) { return Time(patch.range); },
            [](const TransientPatch& patch)
            {
                const auto& event = patch.before ? patch.before : patch.after;
                return event ? Time(TimeRange{event->time, event->time}) : Time();
            },
            [&](const GainEdit& gain) { return ofScope(gain); },
            [&](const FadeEdit& fade) { return ofScope(fade); },
            [&](const InvertEdit& invert) { return ofScope(invert); },
            [&](const QuantiseEdit& quantise) { return ofScope(quantise); },
            [&](const HumaniseEdit& humanise) { return ofScope(humanise); },
            [](const TrimEdit& trim) { return Time(trim.range); },
            [](const CutEdit& cut) { return Time(cut.range); },
            [](const ThinEdit& thin) { return Time(thin.range); },
            [](const InsertEdit& insert) {
                return Time(TimeRange{insert.time, insert.time});
            },
            [](const auto&) { return Time(); },
        },
        edit.operation);
}

} // namespace pacini
