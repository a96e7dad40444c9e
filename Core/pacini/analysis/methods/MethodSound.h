#pragma once

// Preprocessing that the translation methods share: a sound limited to a range and normalised.

#include <pacini/analysis/ActiveTime.h>
#include <pacini/analysis/BandLimit.h>
#include <pacini/analysis/Normalise.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// A sound after preprocessing.
struct MethodSound
{
    std::vector<float> samples; ///< within the method's range, the largest magnitude is 1; silence stays silence
    double fs = 48000.0;        ///< Hz
    double gain = 1.0;          ///< what made the largest magnitude 1
    Seconds duration;
    Seconds active; ///< the time that breakpoints are counted on

    /// Calls visit(part) for consecutive parts of the samples that stay in the cache.
    template <typename Visit>
    void forEachPart(Visit&& visit) const
    {
        const std::span<const float> all(samples);
        for (std::size_t i = 0; i < all.size(); i += longestPart)
            visit(all.subspan(i, std::min(longestPart, all.size() - i)));
    }

    static constexpr std::size_t longestPart = 2048; ///< samples
};

/// Preprocessing as in the thesis (Weber 2020, section 4.3): limits the sound to a range and normalises it. `mono` may
/// have any length, fs is 8000 to 768000 Hz; NaN and infinities count as 0.
[[nodiscard]] inline MethodSound prepareSound(std::span<const float> mono, double fs, const BandLimitParams& range)
{
    MethodSound sound;
    sound.samples.resize(mono.size());
    sound.fs = fs;
    sound.duration = Seconds(static_cast<double>(mono.size()) / fs);
    BandLimit limit;
    limit.setParams(range);
    limit.prepare({fs, mono.size()});
    limit.process(mono, sound.samples);
    const double peak = normalise(sound.samples);
    if (peak > 0.0)
        sound.gain = 1.0 / peak;
    sound.active = activeTime(sound.samples, fs);
    return sound;
}

} // namespace pacini
