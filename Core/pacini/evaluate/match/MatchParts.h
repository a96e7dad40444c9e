#pragma once

// Parts of the match of a vibration and a sound, from which the rating by people is predicted.

#include <pacini/evaluate/match/HeardTrack.h>
#include <pacini/evaluate/match/TouchTrack.h>
#include <pacini/evaluate/match/TrackStatistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Agreement of the heard and the felt signal, each part 0 (none) to 1.
struct MatchParts
{
    double attacks = 0.0;    ///< rises of loudness and of felt strength, within some 10 ms
    double envelope = 0.0;   ///< course of loudness and of felt strength, within some 50 ms
    double roughness = 0.0;  ///< depth of the fluctuations at 20 to 100 Hz
    double brightness = 0.0; ///< course of sharpness and of felt frequency
    double movement = 0.0;   ///< how far the felt frequency moves, up to an octave: no one tone for everything
    double silence = 0.0;    ///< nothing is felt where nothing is heard
    bool operator==(const MatchParts&) const = default;
};

namespace detail
{
static_assert(LoudnessMeter::rate == TouchTrack::rate);

/// Mean depth of the fluctuations of `x` relative to its slow course, weighted by the loudness.
[[nodiscard]] inline double fluctuationDepth(std::span<const float> x, std::span<const float> slow,
                                             std::span<const float> weights)
{
    const auto depth = fluctuation(x);
    const float floor = 0.05f * *std::max_element(slow.begin(), slow.end());
    double total = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < depth.size(); ++i)
    {
        const auto weight = static_cast<double>(weights[i]);
        total += weight;
        sum += weight * static_cast<double>(depth[i] / (slow[i] + floor));
    }
    return total > 0.0 ? sum / total : 0.0;
}

/// 1 for the same depth of fluctuation on both sides, 1/2 for half or twice as much. Depths below .02 are no roughness.
[[nodiscard]] inline double roughnessAgreement(double heard, double felt) noexcept
{
    constexpr double smooth = 0.02;
    const double ratio = (felt + smooth) / (heard + smooth);
    return std::min(ratio, 1.0 / ratio);
}

/// 1 minus how strong the vibration is, relative to its mean, where the loudness is below .0025 of its largest; 1 where
/// that is hardly ever.
[[nodiscard]] inline double silenceAgreement(std::span<const float> loudness, std::span<const float> strength)
{
    const float quiet = 0.05f * *std::max_element(loudness.begin(), loudness.end()); // square roots
    double sum = 0.0;
    double felt = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < loudness.size(); ++i)
    {
        sum += static_cast<double>(strength[i]);
        if (loudness[i] >= quiet)
            continue;
        felt += static_cast<double>(strength[i]);
        ++count;
    }
    if (count * 50 < loudness.size() || !(sum > 0.0))
        return 1.0;
    const double mean = sum / static_cast<double>(loudness.size());
    return 1.0 - std::min(1.0, felt / static_cast<double>(count) / mean);
}

/// Sharpness and felt frequency in the frames of the latter, which count as much as they are heard, where they are
/// felt.
inline void addFrequencyParts(const HeardTrack& heard, const TouchTrack& felt, MatchParts& parts)
{
    constexpr auto hop = static_cast<std::size_t>(TouchTrack::frameSeconds * TouchTrack::rate);
    const double strongest = felt.power.empty() ? 0.0 : *std::max_element(felt.power.begin(), felt.power.end());
    std::vector<float> sharpness;
    std::vector<float> octave;
    std::vector<float> weight;
    for (std::size_t m = 0; m < felt.octave.size() && m * hop < heard.loudness.size(); ++m)
    {
        double loudness = 0.0;
        double sharp = 0.0;
        for (std::size_t i = m * hop; i < std::min((m + 2) * hop, heard.loudness.size()); ++i)
        {
            loudness += static_cast<double>(heard.loudness[i]);
            sharp += static_cast<double>(heard.loudness[i]) * static_cast<double>(heard.sharpness[i]);
        }
        if (!(loudness > 0.0 && felt.power[m] > 0.0025 * strongest))
            continue;
        sharpness.push_back(static_cast<float>(sharp / loudness));
        octave.push_back(static_cast<float>(felt.octave[m]));
        weight.push_back(static_cast<float>(loudness));
    }
    const double justFelt = 0.01; // variance: a tenth of an octave, a tenth of an acum
    parts.brightness = std::max(0.0, correlation(sharpness, octave, weight, justFelt, justFelt));
    parts.movement = std::min(1.0, deviation(octave, weight));
}

/// Square roots of the first `frames` values; zeros follow a shorter track.
[[nodiscard]] inline std::vector<float> compressed(std::span<const float> x, std::size_t frames)
{
    std::vector<float> y(frames);
    std::transform(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(std::min(frames, x.size())), y.begin(),
                   [](float v) { return std::sqrt(v); });
    return y;
}
} // namespace detail

/// What matchParts() needs of a sound, for several vibrations. Keeps a reference to the track.
class HeardCourse
{
public:
    explicit HeardCourse(const HeardTrack& heard) : track(heard)
    {
        using namespace detail;
        if (heard.loudness.size() <= loudnessDelay)
            return;
        loudness = compressed(std::span(heard.loudness).subspan(loudnessDelay), heard.loudness.size() - loudnessDelay);
        quick = smoothed(loudness, attack);
        slow = smoothed(loudness, course);
        risesOfQuick = rises(quick);
        depth = fluctuationDepth(loudness, slow, loudness);
    }

    /// The parts over the length of the sound; a shorter vibration is followed by silence. All 0 when either is silent.
    [[nodiscard]] MatchParts with(const TouchTrack& felt) const
    {
        using namespace detail;
        MatchParts parts;
        if (loudness.empty() || felt.strength.empty())
            return parts;
        const auto strength = compressed(felt.strength, loudness.size());
        if (std::all_of(strength.begin(), strength.end(), [](float v) { return v == 0.0f; }))
            return parts;
        const auto quickStrength = smoothed(strength, attack);
        const auto slowStrength = smoothed(strength, course);
        parts.attacks = std::max(0.0, correlation(risesOfQuick, rises(quickStrength)));
        parts.envelope = std::max(0.0, correlation(slow, slowStrength, {}, unnoticed(slow), unnoticed(slowStrength)));
        parts.roughness = roughnessAgreement(depth, fluctuationDepth(strength, slowStrength, loudness));
        parts.silence = silenceAgreement(quick, quickStrength);
        addFrequencyParts(track, felt, parts);
        return parts;
    }

private:
    const HeardTrack& track;
    HannKernel attack = detail::trackKernel(0.010);
    HannKernel course = detail::trackKernel(0.050);
    std::vector<float> loudness, quick, slow, risesOfQuick; // square roots
    double depth = 0.0;                                     // of the fluctuations
};

/// The parts of a sound and a vibration: see HeardCourse::with().
[[nodiscard]] inline MatchParts matchParts(const HeardTrack& heard, const TouchTrack& felt)
{
    return HeardCourse(heard).with(felt);
}

/// predictedMatch() of a vibration that is never felt: the least that a match is read against.
inline constexpr double matchOfSilence = 35.4;

/// Returns the predicted rating of the match of vibration and sound, 0 to 100: the mean rating of such a pair, not of
/// one person. Fitted to 480 ratings of six kinds of sound by ridge regression (`Tests/human/fit_match.py`, which also
/// shows that the unused parts add nothing on kinds outside the fit).
[[nodiscard]] inline double predictedMatch(const MatchParts& parts) noexcept
{
    return matchOfSilence + 30.0 * parts.attacks + 5.8 * parts.envelope;
}

} // namespace pacini
