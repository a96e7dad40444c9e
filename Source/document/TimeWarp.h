#pragma once

// Time warp: a monotone map from the time of one analysis to that of another.

#include "document/Edit.h"

#include <cstddef>
#include <vector>

namespace pacini
{

/// Pairs of times that belong together. map() is monotone, and exact at every pair.
class TimeWarp
{
public:
    struct Pair
    {
        double before = 0.0; ///< s
        double after = 0.0;  ///< s
        bool operator==(const Pair&) const = default;
    };

    /// Matches the transients of two clips: at most 40 ms apart, after the shift within +-10 s that brings most of them
    /// together where that is clearly better than none.
    [[nodiscard]] static TimeWarp between(const Clip& before, const Clip& after);

    /// The time in the new clip, 0 to its duration.
    [[nodiscard]] double map(double time) const;

    /// Ends that lie on the old clip's ends stay on the new one's.
    [[nodiscard]] TimeRange map(TimeRange range) const;

    /// Follows an edit of the whole clip's time: `before` as it was applied to the old clip, `after` as it is to the
    /// new, whose duration is `newDuration` then.
    void follow(const EditOperation& before, const EditOperation& after, double newDuration);

    /// The old clip's duration where it is known better than by following edits, which rounds, s.
    void setDurationBefore(double seconds) noexcept { oldDuration = seconds; }
    [[nodiscard]] double durationBefore() const noexcept { return oldDuration; }

private:
    /// Replaces each pair by those that `move(pair, moved)` appends to `moved`.
    template <typename Move>
    void moveAll(Move&& move);
    void followOne(const TrimEdit& before, const TrimEdit& after);
    void followOne(const CutEdit& before, const CutEdit& after);
    void followOne(const InsertEdit& before, const InsertEdit& after);
    void followOne(const RepeatEdit& before, const RepeatEdit& after);
    void followOne(const ReverseEdit& before, const ReverseEdit& after);
    void followOne(const StretchEdit& before, const StretchEdit& after);

    std::vector<Pair> pairs; ///< strictly ascending in both
    double oldDuration = 0.0;
    double duration = 0.0;
};

} // namespace pacini
