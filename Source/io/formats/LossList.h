#pragma once

// What a writer says about its losses.

#include "io/formats/ForeignFormat.h"
#include "io/formats/FormatLosses.h"

#include <pacini/synthesis/SingleVoice.h>

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

    /// What was found place by place.
    void append(LossTrack& track) { track.appendTo(losses); }

    /// Residual noise, which is left out.
    void addNoise(const Clip& clip);

    /// Words that have no place; `keepsName`: the clip's name has one.
    void addText(const Clip& clip, bool keepsName);

    /// What a clip loses on one voice: frequencies of others than the strongest band, noise, words.
    void addOneVoice(const Clip& clip, const SingleVoice& voice, bool keepsName);

    /// What a clip loses as a strength without frequency and sharpness.
    void addStrengthOnly(const Clip& clip, const SingleVoice& voice, bool keepsName);

    /// That a curve was left with fewer points, if it shows.
    void addThinned(const Curve& before, const Curve& after, double duration);

    /// Amplitudes of `curve` above `most`, where they are cut.
    void addAbove(const Curve& curve, double most);

    /// Events that follow one another faster than `gap` s.
    void addCrowding(const std::vector<Transient>& events, double gap);

    /// All of them by time; those of one kind and message that touch are one.
    [[nodiscard]] std::vector<FormatLoss> sorted() &&;

private:
    void addVoice(const Clip& clip, const SingleVoice& voice, bool keepsName);

    std::vector<FormatLoss> losses;
};

} // namespace pacini
