#pragma once

// What readers of several formats do on the way to a clip.

#include "io/formats/ForeignFormat.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// What a reader finds wrong: the first error, and warnings, of which a hostile file makes no more than fifty.
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

/// Bands for waves of which some sound side by side.
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

/// Puts events in order of time, and gives bands their priorities by energy.
void finishImported(Clip& clip);

} // namespace pacini
