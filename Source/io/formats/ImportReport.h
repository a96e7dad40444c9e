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
    /// The first band that is free from `start` on, now taken until `end`; null where `most` bands are taken. Starts
    /// only move forward.
    [[nodiscard]] Band* take(double start, double end, std::size_t most);

    std::vector<Band> bands;

private:
    std::vector<double> ends;
};

/// Lets the clip last until `duration`, if that is later than its end; what sounds until its end stops there as before.
void lengthen(Clip& clip, double duration);

/// Lets the clip last until the pulses have passed that the decoder makes of its events (see makePulse), as far as 24
/// hours allow: other programs' clips may end with an event, which would never sound. Ends within half a millisecond,
/// to which formats round times, are left as they are, so that clips do not grow from one format to the next.
void lastUntilSounded(Clip& clip);

/// Puts events in order of time, lets the last of them sound unless the file states where the clip ends, and gives
/// Brings events into the order of their times; those of the same time stay as they are.
void sortByTime(std::span<Transient> events);

/// bands their priorities by energy.
void finishImported(Clip& clip, bool endIsStated = false);

} // namespace pacini
