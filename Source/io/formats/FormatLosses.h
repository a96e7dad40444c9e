#pragma once

// Lists of losses, put together place by place.

#include "io/formats/ClipFormat.h"

#include <pacini/clip/Curve.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Amplitudes below one step of 8 bits are not told from silence, nor errors below it from none: that is the finest
/// that players of these formats show.
inline constexpr double leastAmplitude = 1.0 / 255.0;

/// Joins what is lost at times that only move forward into losses.
class LossTrack
{
public:
    LossTrack(LossKind lossKind, std::string lossMessage) : kind(lossKind), message(std::move(lossMessage)) {}

    /// An error of `error` at `time`, or none where it is not above 0. What follows a loss without a place in between
    /// where all is well, or less than 0.1 s after it, is part of it.
    void add(double time, double error)
    {
        constexpr double nearest = 0.1; // s
        if (!(error > 0.0))
        {
            well = true;
            return;
        }
        if (losses.empty() || (well && time > losses.back().time + losses.back().duration + nearest))
            losses.push_back({kind, time, 0.0, error, message});
        losses.back().duration = time - losses.back().time;
        losses.back().error = std::max(losses.back().error, error);
        well = false;
    }

    /// Moves what was found to the end of `all`.
    void appendTo(std::vector<FormatLoss>& all)
    {
        all.insert(all.end(), std::make_move_iterator(losses.begin()), std::make_move_iterator(losses.end()));
        losses.clear();
        well = true;
    }

private:
    LossKind kind;
    std::string message;
    std::vector<FormatLoss> losses;
    bool well = true; ///< since the last loss
};

} // namespace pacini
