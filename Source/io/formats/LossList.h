#pragma once

// What a writer says about its losses.

#include "io/formats/ClipFormat.h"
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

    /// Residual noise, which is left out, where it sounds.
    void addNoise(const Clip& clip);

    void addMarkers(const Clip& clip);

    /// Words that have no place, markers too; `keepsName`: the clip's name has one.
    void addText(const Clip& clip, bool keepsName);

    /// What a clip loses on one voice but words: frequencies of others than the strongest band, noise, parts that are
    /// too weak to be there.
    void addOneVoice(const Clip& clip, const SingleVoice& voice);

    /// What a clip loses as a strength without frequency and sharpness, words not.
    void addStrengthOnly(const Clip& clip, const SingleVoice& voice);

    /// Where a curve (not empty) was left with too few points to show.
    void addThinned(const Curve& before, const Curve& after);

    /// Cuts amplitudes at `most` and says where.
    void limit(Curve& curve, double most);
    void limit(std::vector<Transient>& events, double most);

    /// Events that follow one another faster than `gap` s.
    void addCrowding(const std::vector<Transient>& events, double gap);

    /// Parts of a quarter of a second or more in which all that sounds is below leastAmplitude, and clips that are
    /// silent.
    void addEmptyParts(const SingleVoice& voice);

    /// All of them by time; those of one kind and message that touch are one.
    [[nodiscard]] std::vector<FormatLoss> sorted() &&;

private:
    void addNoiseInVoice(const Clip& clip);
    void addWhereItSounds(const NoiseBand& band, double duration, const std::string& message);

    std::vector<FormatLoss> losses;
};

} // namespace pacini
