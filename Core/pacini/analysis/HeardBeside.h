#pragma once

// Translation of sound above the range of touch, beside the sound within it.

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/HeardLevel.h>
#include <pacini/analysis/HeardTone.h>
#include <pacini/analysis/SoundScale.h>
#include <pacini/foundation/HeardLaw.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Adds a tone of 280 to 380 Hz for sound above the range of touch: hi-hats, ticks, drops, consonants. The part within
/// the range of touch keeps its level, pitch and rhythm. The tone follows the rises of loudness more than its steady
/// part, and yields to the low part (see heardBeside()). Processes one sound, piece by piece.
class HeardBeside
{
public:
    /// `audible` (0 to 1) scales the tone.
    HeardBeside(std::span<const BandEdges> edges, double audible)
        : tone(edges),
          amount(audible),
          lowBands(static_cast<std::size_t>(std::count_if(
              edges.begin(), edges.end(), [](const BandEdges& band) { return band.centre < heardMaskedBy; })))
    {
    }

    /// Changes `found` up to the value `end` of its envelope; heardShare has a value, 0, for each that is changed
    /// already. `heard` has a value for each of the envelope, and for a part that is not the last some more; for the
    /// last part it ends at `end`. `scale` is that of the whole sound.
    void next(BandAnalysisResult& found, std::span<const HeardFrame> heard, std::size_t end, const SoundScale& scale)
    {
        if (!(scale.loudest > 0.0))
            return;
        const std::size_t first = found.heardShare.size();
        const bool last = end == heard.size();
        constexpr std::size_t ratio = HeardTone::ratio;
        const std::size_t seen = std::min(heard.size(), end + ratio);
        level.resize(seen);
        const double full = std::min(1.0, most * std::sqrt(2.0 * scale.strongest) / scale.peak);
        double rest = steady;
        for (std::size_t i = first; i < seen; ++i)
        {
            const double heardNow = above(heard[i]) / scale.loudest;
            rest += steadyShare * (heardNow - rest);
            if (i + 1 == end)
                steady = rest;
            const double own = i < found.envelope.size() ? static_cast<double>(found.envelope[i]) : 0.0;
            const double share = amount * full * heardRise(heardNow, rest);
            level[i] =
                scale.peak * heardBeside(share, own / scale.peak, lowPower(found, i) / (scale.peak * scale.peak));
        }
        for (std::size_t i = first; i < end; ++i)
            found.envelope[i] = static_cast<float>(std::hypot(static_cast<double>(found.envelope[i]), level[i]));
        found.heardShare.resize(last ? found.envelope.size() : end, 0.0f);
        const std::size_t bandFrames = found.tracks.front().amplitude.size();
        const std::size_t bandEnd = last ? bandFrames : std::min(bandFrames, (end + ratio - 1) / ratio);
        for (std::size_t j = (first + ratio - 1) / ratio; j < bandEnd; ++j)
        {
            const HeardTone::Frame frame = tone.at(j, heard, level);
            if (frame.audible)
                tone.add(found, j, 1.0, frame.power, heardPitch(frame.brightness));
        }
    }

private:
    [[nodiscard]] static double above(const HeardFrame& frame) noexcept
    {
        const auto power = static_cast<double>(frame.power);
        const double share = power > 0.0 ? static_cast<double>(frame.highPower) / power : 0.0;
        return heardAbove(static_cast<double>(frame.loudness), static_cast<double>(frame.high), share);
    }

    /// Amplitude squared of the low bands in the frame that value `i` of the envelope leads to.
    [[nodiscard]] double lowPower(const BandAnalysisResult& found, std::size_t i) const
    {
        const std::size_t j = (i + HeardTone::ratio - 1) / HeardTone::ratio;
        double power = 0.0;
        for (std::size_t k = 0; k < lowBands; ++k)
        {
            const std::vector<float>& amplitude = found.tracks[k].amplitude;
            const double a = j < amplitude.size() ? static_cast<double>(amplitude[j]) : 0.0;
            power += a * a;
        }
        return power;
    }

    /// Amplitude of the tone against that of the loudest moment as it is heard: hiss beside a boom stays hiss.
    static constexpr double most = 3.0;
    static inline const double steadyShare = -std::expm1(-BandAnalysisResult::envelopeStep / heardSteadySeconds);

    HeardTone tone;
    double amount;
    std::size_t lowBands;      // the first ones
    double steady = 0.0;       // loudness as it was of late
    std::vector<double> level; // of the tone at each value of the envelope
};

} // namespace pacini
