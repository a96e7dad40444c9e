#pragma once

// Onset detection function: salience of every moment as the start of an event.

#include <pacini/analysis/OnsetFrame.h>
#include <pacini/analysis/SlidingBuffer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pacini
{

/// Turns OnsetFrames into a salience per frame; 1 is the threshold of an event, and what is clearly below it is 0.
///
/// Two measures, the larger counts:
/// - bands: each band's loudness in the 9 ms from the frame on, less its loudness in the 9 ms before, summed over the
///   bands where it rises, as a part of the greatest total loudness of the next 30 ms. Finds what is new in any part of
///   the spectrum. Loudness is power^(5/16), near Stevens' 0.3, so the measure is a relative one: the same at every
///   level. This is the band-wise relative difference of A. Klapuri, "Sound onset detection by applying psychoacoustic
///   knowledge", ICASSP 1999, bounded to 0-1 by a power law in place of his logarithm.
/// - total: the same for the sum of all bands with 3 ms from the frame on, against the maximum of the 7 ms before.
/// Finds
///   the single strokes of fast trains (up to 80/s), but not the pitch pulses of voices above 100 Hz.
///
/// In either, "before" also holds what was there in the last tenths of a second, falling by 130 dB/s, unless the sound
/// paused: a fluctuation must surpass the earlier ones, a stroke after a pause need not. (S. Boeck and G. Widmer,
/// "Maximum filter vibrato suppression for onset detection", DAFx 2013, compare with a maximum over neighbouring
/// frequencies for the same reason.) Looking 30 ms ahead keeps slow swells out: they are never a large part of what
/// follows.
class OnsetSalience
{
public:
    /// Frames after a frame that its salience depends on.
    static constexpr std::ptrdiff_t lookAhead = 35;
    /// Frames before a frame that are read again for it.
    static constexpr std::ptrdiff_t history = 48;

    /// `sensitivity` multiplies the salience.
    explicit OnsetSalience(double sensitivity)
        : bandThreshold(0.375f / static_cast<float>(sensitivity)),
          totalThreshold(0.42f / static_cast<float>(sensitivity)),
          leastStep(std::pow(std::max(0.01f, 1.0f - totalThreshold), -1.0f / exponent))
    {
    }

    /// Appends to `salience` what `frames` allow: all but the last `lookAhead`. Frames before index 0 must be zeros.
    void extend(const SlidingBuffer<OnsetFrame>& frames, SlidingBuffer<float>& salience)
    {
        extendLoudness(frames);
        const std::int64_t begin = salience.end();
        const std::ptrdiff_t count = salience.missingTo(frames.end() - lookAhead);
        if (count == 0)
            return;
        float* out = salience.extend(count);
        for (std::ptrdiff_t i = 0; i < count; ++i)
            out[i] = next(frames, begin + i);
        loudness.forget(begin + count - window);
        sum.forget(begin + count - window);
    }

    /// power^(5/16) within 0.02 %, for power > 0; about 1e-12 for 0. Without library calls, so that loops become vector
    /// code: base-2 logarithm and exponential from the bits of the number, minimax polynomials for the fractions.
    [[nodiscard]] static float loudnessOf(float power) noexcept
    {
        const auto bits = std::bit_cast<std::int32_t>(power);
        const auto octave = static_cast<float>((bits >> 23) - 127);
        const float m = std::bit_cast<float>((bits & 0x7fffff) | 0x3f800000) - 1.0f;
        const float log2 = octave + m * (1.4387257f + m * (-0.6777840f + m * (0.3211890f - m * 0.0821307f)));
        const float y = exponent * log2 + 64.0f; // above 0, so that truncation rounds down
        const auto whole = static_cast<std::int32_t>(y);
        const float f = y - static_cast<float>(whole);
        const float exp2 = 1.0f + f * (0.6958901f + f * (0.2248650f + f * 0.0792449f));
        return exp2 * std::bit_cast<float>((whole + 63) << 23);
    }

private:
    static constexpr std::size_t all = OnsetFrame::bandCount; ///< lane of the sum of the bands
    static constexpr std::size_t lanes = all + 1;
    using Row = std::array<float, lanes>;

    static constexpr float exponent = 5.0f / 16.0f;
    static constexpr float tiny = 1e-16f; ///< power, keeps ratios defined in digital silence

    static constexpr std::ptrdiff_t window = 8;        ///< frames (9 ms)
    static constexpr std::ptrdiff_t shortAfter = 3;    ///< frames (3 ms)
    static constexpr std::ptrdiff_t shortBefore = 6;   ///< frames (7 ms)
    static constexpr std::ptrdiff_t horizon = 27;      ///< frames (30 ms)
    static constexpr std::ptrdiff_t humBefore = 45;    ///< frames (50 ms, a period of 20 Hz)
    static constexpr std::ptrdiff_t humAfter = 18;     ///< frames (20 ms)
    static constexpr float maskFall = -13.0f / 900.0f; ///< decades of power per frame: 130 dB/s

    void extendLoudness(const SlidingBuffer<OnsetFrame>& frames)
    {
        const std::int64_t begin = loudness.end();
        const std::ptrdiff_t count = loudness.missingTo(frames.end() - window + 1);
        if (count == 0)
            return;
        Row* rows = loudness.extend(count);
        float* sums = sum.extend(count);
        for (std::ptrdiff_t i = 0; i < count; ++i)
        {
            const OnsetFrame* frame = frames.at(begin + i);
            Row power{};
            for (std::ptrdiff_t j = 0; j < window; ++j)
                for (std::size_t l = 0; l < lanes; ++l)
                    power[l] += frame[j].bands[l];
            Row& row = rows[i];
            for (std::size_t l = 0; l < lanes; ++l)
                row[l] = loudnessOf(power[l] / static_cast<float>(window) + tiny);
            sums[i] = 0.0f;
            for (std::size_t l = 0; l < all; ++l)
                sums[i] += row[l];
        }
    }

    /// The salience of frame k; called for every k in turn, because the masks run along.
    float next(const SlidingBuffer<OnsetFrame>& frames, std::int64_t k)
    {
        const Row& now = *loudness.at(k);
        const Row& before = *loudness.at(k - window);
        Row rise;
        for (std::size_t l = 0; l < lanes; ++l)
        {
            mask[l] = std::max(mask[l] * bandFall, before[l]);
            rise[l] = std::max(0.0f, now[l] - before[l]);
        }
        float rises = 0.0f;
        for (std::size_t l = 0; l < all; ++l)
            rises += rise[l];

        const OnsetFrame* frame = frames.at(k);
        totalMask = std::max(totalMask * totalFall, shortTotal(frame - shortAfter + 1));
        float latest = 0.0f;
        for (std::ptrdiff_t j = 1; j <= shortBefore; ++j)
            latest = std::max(latest, frame[-j].bands[all]);

        // Most frames are far from an event without any mask.
        const bool bandsRise = rises >= bandThreshold * *sum.at(k);
        const bool totalRises = shortTotal(frame) >= leastStep * latest;
        if (!bandsRise && !totalRises)
            return 0.0f;
        const float hum = humAt(frames, k);
        return std::max(bandsRise ? fromBands(k, hum) : 0.0f, totalRises ? fromTotal(frame, latest, hum) : 0.0f);
    }

    [[nodiscard]] float fromBands(std::int64_t k, float hum) const
    {
        const Row& now = *loudness.at(k);
        const Row& before = *loudness.at(k - window);
        const float memory = std::max(hum, memoryOf(before[all] / now[all]));
        float evidence = 0.0f;
        for (std::size_t l = 0; l < all; ++l)
            evidence += std::max(0.0f, now[l] - std::max(before[l], mask[l] * memory));
        return evidence / (*std::max_element(sum.at(k), sum.at(k + horizon)) * bandThreshold);
    }

    [[nodiscard]] float fromTotal(const OnsetFrame* frame, float latest, float hum) const
    {
        const float now = loudnessOf(shortTotal(frame) + tiny);
        const float before = loudnessOf(latest + tiny);
        const float memory = std::max(hum, memoryOf(before / now));
        float loudest = 0.0f;
        for (std::ptrdiff_t j = 0; j < horizon; ++j)
            loudest = std::max(loudest, shortTotal(frame + j));
        const float evidence = std::max(0.0f, now - std::max(before, loudnessOf(totalMask + tiny) * memory));
        return evidence / (loudnessOf(loudest + tiny) * totalThreshold);
    }

    /// How much of the mask counts, as a factor of loudness, when the loudness before is `ratio` of that after: all of
    /// it while the sound rises by less than 3 dB, twice as many dB less beyond that.
    static float memoryOf(float ratio) noexcept
    {
        const float margin = 1.2419f; // 2^(5/16)
        const float pause = std::min(1.0f, margin * ratio);
        return pause * pause;
    }

    /// The same for a low tone under way, whose ticks (the edges of a saw wave at 20-60 Hz) are no events: near 1 where
    /// the lowest band of the last 50 ms, 6 dB up, reaches the power of the frame; falls with its cube.
    [[nodiscard]] static float humAt(const SlidingBuffer<OnsetFrame>& frames, std::int64_t k)
    {
        const OnsetFrame* frame = frames.at(k);
        const auto reach = static_cast<std::ptrdiff_t>(std::min<std::int64_t>(humBefore, k));
        float before = 0.0f;
        for (std::ptrdiff_t j = 1; j <= reach; ++j)
            before += frame[-j].bands[0];
        float after = 0.0f;
        for (std::ptrdiff_t j = 0; j < humAfter; ++j)
            after += frame[j].bands[0];
        float others = 0.0f;
        for (std::ptrdiff_t j = 0; j < window; ++j)
            others += frame[j].bands[all] - frame[j].bands[0];
        before /= static_cast<float>(std::max<std::ptrdiff_t>(reach, 1));
        const float total = after / static_cast<float>(humAfter) + others / static_cast<float>(window);
        const float share = loudnessOf(std::min(1.0f, 4.0f * before / (total + tiny)));
        return share * share * share;
    }

    static float shortTotal(const OnsetFrame* frame) noexcept
    {
        return (frame[0].bands[all] + frame[1].bands[all] + frame[2].bands[all]) / static_cast<float>(shortAfter);
    }

    float bandThreshold;
    float totalThreshold;
    float leastStep; ///< no smaller step of power passes totalThreshold
    float bandFall = std::pow(10.0f, maskFall* exponent);
    float totalFall = std::pow(10.0f, maskFall);

    SlidingBuffer<Row> loudness{window, -window}; ///< element k: of the window that begins with frame k
    SlidingBuffer<float> sum{window, -window};    ///< of the bands of `loudness`
    Row mask{};                                   ///< loudness
    float totalMask = 0.0f;                       ///< power
};

} // namespace pacini
