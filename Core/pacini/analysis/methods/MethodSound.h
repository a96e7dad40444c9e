#pragma once

// Preprocessing that the translation methods share: a sound limited to a range and normalised.

#include <pacini/analysis/DecayTime.h>
#include <pacini/filters/BiquadCascade.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/filters/Resampler.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The largest |x|; 0 for an empty span; NaN and infinities count as 0.
[[nodiscard]] inline double peakOf(std::span<const float> signal) noexcept
{
    double peak = 0.0;
    for (const float x : signal)
        peak = std::max(peak, std::abs(finiteOrZero(x)));
    return peak;
}

/// Divides the signal by its peak, in place, and returns that peak. A signal that is silent or empty is left alone and
/// returns 0; NaN and infinities become 0.
inline double normalise(std::span<float> signal) noexcept
{
    const double peak = peakOf(signal);
    for (float& x : signal)
        x = peak > 0.0 ? toSample(finiteOrZero(x) / peak) : 0.0f;
    return peak;
}

/// `mono` at `rate` Hz, its largest magnitude scaled to `peak` before; empty for silence and rates that resample() does
/// not take.
[[nodiscard]] inline std::vector<float> normalisedAt(std::span<const float> mono, double fs, int rate,
                                                     double peak = 1.0)
{
    std::vector<float> sound(mono.begin(), mono.end());
    if (!(normalise(sound) > 0.0))
        return {};
    for (float& x : sound)
        x = static_cast<float>(peak * static_cast<double>(x));
    auto resampled = resample(std::span<const float>(sound), static_cast<int>(fs), rate);
    return resampled ? std::move(*resampled) : std::vector<float>();
}

/// The time during which a signal is felt (Weber 2020, section 4.3: "the amount of time above a threshold"), in blocks
/// of 10 ms whose peak exceeds -75 dB re 1: counted sample by sample, every zero crossing would be silence. fs in Hz. 0
/// for silence and for an empty signal; the last block counts with the length that it has.
[[nodiscard]] inline Seconds activeTime(std::span<const float> signal, double fs) noexcept
{
    const std::size_t block = std::max<std::size_t>(1, roundedFrames(Seconds(0.010), fs));
    const double threshold = Decibels(-75.0).gain();
    std::size_t frames = 0;
    for (std::size_t begin = 0; begin < signal.size(); begin += block)
    {
        const auto part = signal.subspan(begin, std::min(block, signal.size() - begin));
        if (peakOf(part) > threshold)
            frames += part.size();
    }
    return Seconds(static_cast<double>(frames) / fs);
}

/// Corner frequencies of the band limit. The thesis's range (Weber 2020, section 4.3). A low limit of 0 Hz or below
/// leaves out the high-pass, a high limit of 0.49 of the sample rate or above the low-pass.
struct BandLimitParams
{
    Hertz low{5.0};
    Hertz high{1800.0};
    bool operator==(const BandLimitParams&) const = default;
};

/// Butterworth high-pass of second and low-pass of fourth order; the thesis names neither type nor order.
[[nodiscard]] inline BiquadCascadeCoefficients designBandLimit(const BandLimitParams& params, double fs) noexcept
{
    BiquadCascadeCoefficients cascade;
    const auto append = [&](const ButterworthParams& filter)
    {
        for (const StateVariableCoefficients& section : designButterworth(filter, fs).sections)
            cascade.sections.pushBack(section);
    };
    if (params.low.value > 0.0)
        append({.type = ButterworthType::highpass, .order = 2, .frequency = params.low});
    if (params.high.value < 0.49 * fs)
        append({.type = ButterworthType::lowpass, .order = 4, .frequency = params.high});
    return cascade;
}

/// Streaming band limit, causal.
using BandLimit = DesignedCascade<BandLimitParams, designBandLimit>;

static_assert(DspBlock<BandLimit>);

/// A sound after preprocessing.
struct MethodSound
{
    std::vector<float> samples; ///< within the method's range, the largest magnitude is 1; silence stays silence
    double fs = 48000.0;        ///< Hz
    double gain = 1.0;          ///< gain that made the largest magnitude 1
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
