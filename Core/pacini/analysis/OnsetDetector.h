#pragma once

// Onset detector: finds the events of a sound, where something starts.

#include <pacini/analysis/OnsetFeatures.h>
#include <pacini/analysis/OnsetFrame.h>
#include <pacini/analysis/OnsetMeasure.h>
#include <pacini/analysis/OnsetParams.h>
#include <pacini/analysis/OnsetSalience.h>
#include <pacini/analysis/SlidingBuffer.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace pacini
{

/// Drops the onsets that louder neighbours mask and those below `params.silence`. A neighbour's level falls by
/// `maskRecovery` with the distance in time; an onset d dB below the strongest of these levels stays if d <= maskLimit
/// and salience >= 1 + maskSlope max(0, d - maskMargin). `onsets` are in order of time. O(n).
[[nodiscard]] inline std::vector<Onset> unmaskedOnsets(std::span<const Onset> onsets, const OnsetParams& params)
{
    const auto level = [](const Onset& onset)
    {
        return Decibels::fromGain(std::max(onset.amplitude, 1e-10)).value;
    };
    std::vector<double> mask(onsets.size(), -std::numeric_limits<double>::infinity());
    const auto spread = [&](std::size_t from, std::size_t to)
    {
        const double reach = std::max(mask[from], level(onsets[from]));
        const double distance = std::abs(onsets[to].time - onsets[from].time);
        mask[to] = std::max(mask[to], reach - params.maskRecovery * distance);
    };
    for (std::size_t i = 1; i < onsets.size(); ++i)
        spread(i - 1, i);
    for (std::size_t i = onsets.size(); i-- > 1;)
        spread(i, i - 1);

    std::vector<Onset> kept;
    for (std::size_t i = 0; i < onsets.size(); ++i)
    {
        const double deficit = mask[i] - level(onsets[i]);
        const double least = 1.0 + params.maskSlope * std::max(0.0, deficit - params.maskMargin.value);
        if (deficit <= params.maskLimit.value && onsets[i].salience >= least &&
            level(onsets[i]) >= params.silence.value)
            kept.push_back(onsets[i]);
    }
    return kept;
}

/// Finds onsets in a stream of OnsetFrames: push() them in order, then finish() once. The result does not depend on how
/// the frames are cut into calls. Memory: under a second of frames and 64 bytes per onset. Not real-time: allocates.
class OnsetDetector
{
public:
    explicit OnsetDetector(const OnsetParams& onsetParams = {})
        : params(onsetParams),
          scores(std::clamp(params.sensitivity, 0.25, 4.0)),
          gap(static_cast<std::int64_t>(std::ceil(params.minimumGap.frames(OnsetFrame::rate) - 1e-9)))
    {
    }

    void push(std::span<const OnsetFrame> more)
    {
        std::copy(more.begin(), more.end(), frames.extend(std::ssize(more)));
        advance();
    }

    /// The onsets that are known now, as finish() would return them if nothing came that masks them.
    [[nodiscard]] std::vector<Onset> onsetsSoFar() const { return unmaskedOnsets(onsets, params); }

    /// All onsets in order of time. The sound counts as silent after its last frame.
    [[nodiscard]] std::vector<Onset> finish()
    {
        frames.extend(OnsetSalience::lookAhead + peakReach + measureReach);
        advance();
        return unmaskedOnsets(onsets, params);
    }

private:
    struct Peak
    {
        std::int64_t frame = 0;
        float salience = 0.0f;
    };

    static constexpr std::ptrdiff_t peakReach = 5; ///< a peak of salience is the greatest of 5 frames on either side
    static constexpr std::ptrdiff_t measureReach = 24; ///< frames after a peak that measuring it reads

    void advance()
    {
        scores.extend(frames, salience);
        for (; searched + peakReach < salience.end(); ++searched)
            if (isPeak(salience.at(searched)) && (peaks.empty() || searched - peaks.back().frame >= gap))
                peaks.push_back({searched, *salience.at(searched)});

        // Measuring waits until the next event, if it is near, is known.
        for (; measured < peaks.size() && peaks[measured].frame + measureReach <= searched; ++measured)
        {
            const Peak& peak = peaks[measured];
            const std::int64_t next = measured + 1 < peaks.size() ? peaks[measured + 1].frame : searched;
            onsets.push_back(measureOnset(frames.at(peak.frame), peak.frame, next));
            onsets.back().salience = static_cast<double>(peak.salience);
        }
        frames.forget(searched - measureReach - OnsetSalience::history);
        salience.forget(searched - peakReach);
    }

    static bool isPeak(const float* s) noexcept
    {
        if (s[0] < 1.0f)
            return false;
        for (std::ptrdiff_t j = 1; j <= peakReach; ++j)
            if (s[-j] >= s[0] || s[j] > s[0])
                return false;
        return true;
    }

    OnsetParams params;
    OnsetSalience scores;
    std::int64_t gap; ///< frames
    SlidingBuffer<OnsetFrame> frames{OnsetSalience::history};
    SlidingBuffer<float> salience{peakReach};
    std::vector<Peak> peaks;
    std::size_t measured = 0; ///< of `peaks`, as many as `onsets`
    std::vector<Onset> onsets;
    std::int64_t searched = 0; ///< all peaks before this frame are known
};

/// The onsets of `interleaved` samples of `channelCount` channels at `sampleRate` Hz (2-768 kHz), in order of time. All
/// samples must be finite; a trailing part of a frame is an error (asserted). Works through the sound in small pieces,
/// so it needs little memory of its own.
[[nodiscard]] inline std::vector<Onset> detectOnsets(std::span<const float> interleaved, std::size_t channelCount,
                                                     double sampleRate, const OnsetParams& params = {})
{
    OnsetFeatures features(sampleRate, channelCount);
    OnsetDetector detector(params);
    const auto hand = [&]
    {
        detector.push(features.frames());
        features.drop(features.frames().size());
    };
    const std::size_t block = 16384 * channelCount;
    for (std::size_t i = 0; i < interleaved.size(); i += block)
    {
        features.push(interleaved.subspan(i, std::min(block, interleaved.size() - i)));
        hand();
    }
    features.finish();
    hand();
    return detector.finish();
}

} // namespace pacini
