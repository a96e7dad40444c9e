#pragma once

// Collects the losses of a clip in a format, place by place.

#include "io/formats/ClipFormat.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

struct SingleVoice;

/// Amplitudes below one step of 8 bits count as silence, errors below it as none: this is the finest resolution of
/// players of these formats.
inline constexpr double leastAmplitude = 1.0 / 255.0;

/// Joins adjacent losses; times must not decrease.
class LossTrack
{
public:
    LossTrack(LossKind lossKind, std::string lossMessage) : kind(lossKind), message(std::move(lossMessage)) {}

    /// Adds an error of `error` at `time`, or none if it is not above 0. A loss that follows another without a place
    /// free of loss between them, or within 0.1 s, is part of it.
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

    /// Moves all losses found to the end of `all`.
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

    /// Adds losses that were found place by place.
    void append(LossTrack& track) { track.appendTo(losses); }

    /// Adds residual noise where it sounds: left out, or as in `message`.
    void addNoise(const Clip& clip, const std::string& message = {});

    /// Adds that `bands` of a clip play with `voices`, which are fewer.
    void addShared(const Clip& clip, std::size_t bands, std::size_t voices);

    void addMarkers(const Clip& clip);

    /// Adds texts that the format cannot represent, and markers. `keepsName`: the format stores the clip's name.
    void addText(const Clip& clip, bool keepsName);

    /// Adds places where a curve (not empty) has too few points to show.
    void addThinned(const Curve& before, const Curve& after);

    /// Limits amplitudes to `most` and adds the places.
    void limit(Curve& curve, double most);
    void limit(std::vector<Transient>& events, double most);

    /// Events that have no transient at their time.
    void addOmitted(const std::vector<Transient>& events, const std::vector<Transient>& transients,
                    const std::string& message);

    /// Events that follow one another faster than `gap` s.
    void addCrowding(const std::vector<Transient>& events, double gap);

    /// Returns all losses by time; adjacent ones of one kind and message are joined, except for events that are no
    /// transients.
    [[nodiscard]] std::vector<FormatLoss> sorted() &&;

private:
    std::vector<FormatLoss> losses;
};

/// Adds the losses of a clip on one voice, without texts: frequencies of other bands than the strongest, noise, parts
/// that are too weak to be represented.
void addVoiceLosses(LossList& losses, const Clip& clip, const SingleVoice& voice);

/// Adds the losses of a clip as a strength, without texts.
void addStrengthLosses(LossList& losses, const Clip& clip, const SingleVoice& voice);

/// Adds parts of a quarter of a second or more that stay below leastAmplitude, and clips that are silent.
void addEmptyParts(LossList& losses, const SingleVoice& voice);

/// An export of one file.
[[nodiscard]] inline ExportedClip oneFile(std::string bytes, LossList losses)
{
    return {{{"", std::move(bytes)}}, std::move(losses).sorted()};
}

} // namespace pacini
