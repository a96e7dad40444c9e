#pragma once

// Import helpers that readers of several formats share: warnings, bands for overlapping waves, the clip's end.

#include "io/formats/ClipFormat.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// Errors and warnings of a reader: the first error, and up to fifty warnings, also for hostile files.
class ImportReport
{
public:
    explicit ImportReport(std::vector<std::string>& warningsToFill) : warnings(warningsToFill) {}

    std::optional<Error> error;

    void warn(std::string_view where, std::string_view message);
    void fail(std::string where, std::string message, ErrorCode code = ErrorCode::invalidData);

private:
    std::vector<std::string>& warnings;
};

/// Allocation of bands to waves, some of which are simultaneous.
class ImportLanes
{
public:
    /// Returns the first band that is free from `start` on, and reserves it until `end`; null if `most` bands are
    /// taken. Starts only move forward.
    [[nodiscard]] Band* take(double start, double end, std::size_t most);

    std::vector<Band> bands;

private:
    std::vector<double> ends;
};

/// Extends the clip to `duration`, if that is later than its end; sound up to its end stops there as before.
void lengthen(Clip& clip, double duration);

/// Extends the clip to the end of the pulses that the decoder makes of its events (see makePulse), within 24 hours:
/// clips of other programs may end with an event, which would never sound. Ends within half a millisecond, the rounding
/// of formats, stay unchanged, so that clips do not grow from one format to the next.
void lastUntilSounded(Clip& clip);

/// Sorts events by time; events of the same time keep their order.
void sortByTime(std::span<Transient> events);

/// Sorts the events, extends the clip to the end of its last event unless the file states the clip's end, and sets the
/// priorities of bands by energy.
void finishImported(Clip& clip, bool endIsStated = false);

} // namespace pacini
