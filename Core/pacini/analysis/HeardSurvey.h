#pragma once

// First pass over the heard part of a sound: its scale.

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/EncoderParams.h>
#include <pacini/analysis/EvenTrains.h>
#include <pacini/analysis/HeardInstead.h>
#include <pacini/analysis/HeardLevel.h>
#include <pacini/analysis/SoundScale.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace pacini
{

/// Computes the SoundScale of a sound with its heard part, section by section in step with the encoder.
class HeardSurvey
{
public:
    HeardSurvey(double audible, HeardRole wanted) : shares(audible), role(wanted) {}

    /// Processes the next section, if `heard`, which begins with it, contains all that it needs. Returns the values
    /// that need not be kept. `onsets` are the known onsets of the whole sound.
    [[nodiscard]] std::size_t next(std::span<const HeardFrame> heard, std::span<const Onset> onsets)
    {
        if (heard.size() <= SoundSection::framesSeen)
            return 0;
        look(heard.first(SoundSection::framesSeen), SoundSection::frames + 1, onsets);
        ++sections;
        return SoundSection::frames;
    }

    /// Completes a sound; `heard` and `onsets` as in next(). Its bands have this `peak`.
    [[nodiscard]] SoundScale finish(std::span<const HeardFrame> heard, std::span<const Onset> onsets, double peak)
    {
        while (const std::size_t over = next(heard, onsets))
            heard = heard.subspan(over);
        look(heard, heard.size(), onsets);
        scale.peak = scale.loudest > 0.0 ? std::max(peak, scale.peak) : peak;
        return scale;
    }

private:
    void look(std::span<const HeardFrame> heard, std::size_t end, std::span<const Onset> onsets)
    {
        for (const HeardFrame& frame : heard)
        {
            scale.loudest = std::max(scale.loudest, static_cast<double>(frame.loudness));
            scale.strongest = std::max(scale.strongest, static_cast<double>(frame.power));
        }
        const std::size_t first = sections > 0 ? 1 : 0;
        if (role == HeardRole::beside)
        {
            // What has next to no low part is scaled as if its low part had at least this share of what is heard.
            constexpr double lowest = 0.3;
            scale.peak = std::max(scale.peak, lowest * std::sqrt(2.0 * scale.strongest));
            return;
        }
        const auto trains = evenTrains(onsetsFrom(onsets, SoundSection::seconds * sections), trainGapSeconds);
        const auto share = shares.next(heard, first, end, scale.strongest, trains);
        for (std::size_t i = first; i < end; ++i)
            scale.peak = std::max(scale.peak,
                                  static_cast<double>(share[i]) * std::sqrt(2.0 * static_cast<double>(heard[i].power)));
    }

    HeardShares shares;
    HeardRole role;
    int sections = 0; // seen
    SoundScale scale;
};

} // namespace pacini
