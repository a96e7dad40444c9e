#pragma once

// Collects the losses of a clip in a format, place by place.

#include "io/formats/ClipFormat.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

struct SingleVoice;

/// Amplitudes below one step of 8 bits are not told from silence, nor errors below it from none: that is the finest
/// that players of these formats show.
inline constexpr double leastAmplitude = 1.0 / 255.0;

/// Joins adjacent losses; times must not decrease.
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

/// Collects losses in any order.
class LossList
{
public:
    /// One loss over `duration` from `time`.
    void add(LossKind kind, double time, double duration, double error, std::string message);

    /// What was found place by place.
    void append(LossTrack& track) { track.appendTo(losses); }

    /// Residual noise where it sounds: left out, or what `message` says of it.
    void addNoise(const Clip& clip, const std::string& message = {});

    void addMarkers(const Clip& clip);

    /// Words that have no place, markers too; `keepsName`: the clip's name has one.
    void addText(const Clip& clip, bool keepsName);

    /// Where a curve (not empty) was left with too few points to show.
    void addThinned(const Curve& before, const Curve& after);

    /// Cuts amplitudes at `most` and says where.
    void limit(Curve& curve, double most);
    void limit(std::vector<Transient>& events, double most);

    /// Events that have no transient at their time.
    void addOmitted(const std::vector<Transient>& events, const std::vector<Transient>& transients,
                    const std::string& message);

    /// Events that follow one another faster than `gap` s.
    void addCrowding(const std::vector<Transient>& events, double gap);

    /// All of them by time; those of one kind and message that touch are one, but for events that are no transients.
    [[nodiscard]] std::vector<FormatLoss> sorted() &&;

private:
    std::vector<FormatLoss> losses;
};

/// What a clip loses on one voice but words: frequencies of others than the strongest band, noise, parts that are too
/// weak to be there.
void addVoiceLosses(LossList& losses, const Clip& clip, const SingleVoice& voice);

/// What a clip loses as a strength, words not.
void addStrengthLosses(LossList& losses, const Clip& clip, const SingleVoice& voice);

/// Parts of a quarter of a second or more in which all that sounds is below leastAmplitude, and clips that are silent.
void addEmptyParts(LossList& losses, const SingleVoice& voice);

/// An export of one file.
[[nodiscard]] inline ExportedClip oneFile(std::string bytes, LossList losses)
{
    return {{{"", std::move(bytes)}}, std::move(losses).sorted()};
}

} // namespace pacini
