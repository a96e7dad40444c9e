#pragma once

// Translation of sound above the range of touch, instead of the sound within it.

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/EvenTrains.h>
#include <pacini/analysis/HeardLevel.h>
#include <pacini/analysis/HeardTone.h>
#include <pacini/analysis/SoundScale.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// How far the loudness takes over at each moment, 0 to 1, by where the A-weighted power lies before and after it: a
/// sound piece by piece. Nothing within even trains, whose hits a level would blur; that comes and goes in 40 ms.
class HeardShares
{
public:
    /// `audible` 0 to 1 is the largest share.
    explicit HeardShares(double audible) : most(audible) {}

    /// One value for each of `heard`, 0 for those before `first`. Values up to `end` are over then and the next call
    /// goes on there; the others are only looked at, as far as they matter for those. `strongest` as in SoundScale,
    /// times of `trains` from the first of `heard` on. Valid until the next call.
    std::span<const float> next(std::span<const HeardFrame> heard, std::size_t first, std::size_t end, double strongest,
                                std::span<const TrainSpan> trains)
    {
        constexpr double none = 0.2;
        constexpr double all = 0.45;
        constexpr double seconds = 1.0; // in which what was counts e times less
        const double rate = -std::expm1(-BandAnalysisResult::envelopeStep / seconds);
        const double silence = 1e-10 * strongest;
        double total = totalBefore;
        double high = highBefore;
        totals.clear();
        highs.clear();
        for (std::size_t i = first; i < heard.size(); ++i)
        {
            totals.push_back(total += rate * (static_cast<double>(heard[i].power) - total));
            highs.push_back(high += rate * (static_cast<double>(heard[i].highPower) - high));
            if (i + 1 == end)
            {
                totalBefore = total;
                highBefore = high;
            }
        }
        shares.assign(heard.size(), 0.0f);
        for (std::size_t i = heard.size(); i-- > first;)
        {
            total += rate * (totals[i - first] - total);
            high += rate * (highs[i - first] - high);
            const double u = std::clamp((high / (total + silence) - none) / (all - none), 0.0, 1.0);
            shares[i] = static_cast<float>(most * u * u * (3.0 - 2.0 * u));
        }
        leaveTrains(trains);
        return shares;
    }

private:
    void leaveTrains(std::span<const TrainSpan> trains)
    {
        constexpr double ramp = 0.040; // s
        for (const TrainSpan& train : trains)
        {
            const auto frameOf = [&](double time)
            {
                const double frame = std::max(0.0, std::ceil(time / BandAnalysisResult::envelopeStep));
                return std::min(shares.size(), static_cast<std::size_t>(frame));
            };
            for (std::size_t i = frameOf(train.first - ramp); i < frameOf(train.last + ramp); ++i)
            {
                const double time = static_cast<double>(i) * BandAnalysisResult::envelopeStep;
                const double outside = std::max({0.0, train.first - time, time - train.last});
                shares[i] *= static_cast<float>(std::min(1.0, outside / ramp));
            }
        }
    }

    double most;
    double totalBefore = 0.0; // smoothed power up to the frames to come
    double highBefore = 0.0;
    std::vector<double> totals, highs;
    std::vector<float> shares;
};

/// Makes sound above the range of touch perceptible to the skin. If most of the heard sound (A-weighted power, over
/// some seconds) lies above 900 Hz, the level follows the loudness. The bands then keep at most a quarter of their own
/// amplitude, and a tone of 150 to 290 Hz, higher for brighter sounds, adds the missing level. Otherwise nothing
/// changes.
///
/// `audible` (0 to 1) sets the amount, and BandAnalysisResult::heardShare records it over time. The limits of the
/// blend, the share of the bands and the range of the tone were chosen by trial, not derived. Processes one sound,
/// piece by piece.
class HeardInstead
{
public:
    HeardInstead(std::span<const BandEdges> edges, double audible) : tone(edges), shares(audible) {}

    /// Changes `found` up to the value `end` of its envelope; what is before is changed already where heardShare has a
    /// value for it. `heard` has a value for each of the envelope, and for a part that is not the last some more (see
    /// HeardShares); for the last part it ends at `end`. `scale` is that of the whole sound.
    void next(BandAnalysisResult& found, std::span<const HeardFrame> heard, std::size_t end,
              std::span<const TrainSpan> trains, const SoundScale& scale)
    {
        if (!(scale.loudest > 0.0))
            return;
        const std::size_t first = found.heardShare.size();
        const bool last = end == heard.size();
        share = shares.next(heard, first, end, scale.strongest, trains);
        level.resize(heard.size());
        for (std::size_t i = first; i < heard.size(); ++i)
            level[i] = loudestLevel * scale.peak * felt(static_cast<double>(heard[i].loudness) / scale.loudest);
        for (std::size_t i = first; i < end; ++i)
        {
            const auto part = static_cast<double>(share[i]);
            found.envelope[i] =
                static_cast<float>((1.0 - part) * static_cast<double>(found.envelope[i]) + part * level[i]);
        }
        found.heardShare.insert(found.heardShare.end(), share.begin() + static_cast<std::ptrdiff_t>(first),
                                share.begin() + static_cast<std::ptrdiff_t>(end));
        const std::size_t bandFrames = found.tracks.front().amplitude.size();
        const std::size_t bandEnd = last ? bandFrames : std::min(bandFrames, (end + ratio - 1) / ratio);
        for (std::size_t j = (first + ratio - 1) / ratio; j < bandEnd; ++j)
            addTone(found, heard, j);
        if (last)
            found.heardShare.resize(found.envelope.size(), 0.0f);
    }

private:
    static constexpr std::size_t ratio = HeardTone::ratio;

    /// Threshold as a share of the largest loudness. Sound below it, such as hiss in pauses, is not felt.
    [[nodiscard]] static double felt(double loudness) noexcept
    {
        return std::max(0.0, loudness - unheard) / (1.0 - unheard);
    }

    /// The tone in frame `j` of the bands.
    void addTone(BandAnalysisResult& found, std::span<const HeardFrame> heard, std::size_t j)
    {
        const HeardTone::Frame frame = tone.at(j, heard, level);
        const double driven = tone.mean(j, share);
        if (!(driven > 0.0 && frame.audible))
            return;
        double held = 0.0; // by the bands
        for (const BandAnalysisResult::Track& track : found.tracks)
            held += static_cast<double>(track.amplitude[j]) * static_cast<double>(track.amplitude[j]);
        const double kept = held > 0.0 ? std::min(std::sqrt(frame.power / held), mostKept) : 0.0;
        tone.add(found, j, 1.0 - driven + driven * kept, driven * driven * (frame.power - kept * kept * held),
                 lowest * std::pow(highest / lowest, frame.brightness));
    }

    static constexpr double lowest = 150.0;  // Hz
    static constexpr double highest = 290.0; // Hz
    static constexpr double mostKept = 0.25;
    static constexpr double unheard = 0.03; // of the loudest: white noise 70 dB below the peak of knocks
    /// Share of full drive. Beats of the bands with the tone need the rest; otherwise the limiter would flatten loud
    /// sounds.
    static constexpr double loudestLevel = 0.8;

    HeardTone tone;
    HeardShares shares;
    std::span<const float> share; // of the part at hand
    std::vector<double> level;    // of the loudness at each value of the envelope
};

} // namespace pacini
