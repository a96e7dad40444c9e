#pragma once

// What a writer says about its losses.

#include "io/formats/ForeignFormat.h"

#include <string>
#include <vector>

namespace pacini
{

/// Collects losses in any order.
class LossList
{
public:
    /// One loss over `duration` from `time`.
    void add(LossKind kind, double time, double duration, double error, std::string message);

    /// Residual noise (where it sounds) and words that a format without either loses; `keepsName` when it has a place
    /// for the clip's name.
    void addNoiseAndText(const Clip& clip, bool keepsName);

    /// That `clip`'s bands share one voice or none: `message` says which. Nothing for a clip of one band.
    void addBands(const Clip& clip, std::string message);

    /// Amplitudes of `curve` above `most`, where they are cut.
    void addAbove(const Curve& curve, double most);

    /// Events that follow one another faster than `gap` s.
    void addCrowding(const std::vector<Transient>& events, double gap);

    /// A clip of which nothing is left.
    void addEmpty(double duration);

    /// All of them by time; those of one kind and message that touch are one.
    [[nodiscard]] std::vector<FormatLoss> sorted() &&;

private:
    std::vector<FormatLoss> losses;
};

} // namespace pacini
