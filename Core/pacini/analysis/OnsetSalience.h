#pragma once

// How much every moment looks like the start of something.

#include <pacini/analysis/OnsetFrame.h>
#include <pacini/analysis/SlidingBuffer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pacini
{

/// Turns OnsetFrames into a salience per frame: 1 is the threshold of an event at sensitivity 1.
class OnsetSalience
{
public:
    /// Frames after frame k that its salience depends on.
    static constexpr std::ptrdiff_t lookAhead = 35;
    /// Frames before frame k that it depends on (the mask reaches further back, but is carried along).
    static constexpr std::ptrdiff_t history = 48;

    /// Appends to `salience` what `frames` allow; both indices count from the first frame.
    void extend(const SlidingBuffer<OnsetFrame>& frames, SlidingBuffer<float>& salience)
    {
        addLoudness(frames);
        const std::ptrdiff_t begin = salience.end();
        const std::ptrdiff_t count = frames.end() - lookAhead - begin;
        if (count <= 0)
            return;
        float* out = salience.extend(count);
        for (std::ptrdiff_t i = 0; i < count; ++i)
            out[i] = at(frames, begin + i);
        loudness.forget(begin + count - window);
        sum.forget(begin + count - window);
    }

private:
    static constexpr std::size_t lanes = OnsetFrame::bandCount + 1;
    static constexpr std::size_t all = OnsetFrame::bandCount; ///< lane of the sum of bands
    using Row = std::array<float, lanes>;

    static constexpr std::ptrdiff_t window = 8;     ///< frames: 9 ms before and after
    static constexpr std::ptrdiff_t horizon = 27;   ///< frames: 30 ms
    static constexpr std::ptrdiff_t shortWindow = 3;
    static constexpr std::ptrdiff_t shortBefore = 6;
    static constexpr std::ptrdiff_t humBefore = 45;
    static constexpr std::ptrdiff_t humAfter = 18;
    static constexpr float bandThreshold = 0.375f;
    static constexpr float totalThreshold = 0.42f;

    static float loudnessOf(float power) noexcept
    {
        const float quarter = std::sqrt(std::sqrt(power));
        return quarter * std::sqrt(std::sqrt(quarter));
    }

    void addLoudness(const SlidingBuffer<OnsetFrame>& frames)
    {
        const std::ptrdiff_t begin = loudness.end();
        const std::ptrdiff_t count = frames.end() - window + 1 - begin;
        if (count <= 0)
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
                row[l] = loudnessOf(power[l] * (1.0f / static_cast<float>(window)) + 1e-12f);
            float s = 0.0f;
            for (std::size_t l = 0; l < all; ++l)
                s += row[l];
            sums[i] = s;
        }
    }

    float at(const SlidingBuffer<OnsetFrame>& frames, std::ptrdiff_t k)
    {
        const Row& now = *loudness.at(k);
        const Row& before = *loudness.at(k - window);
        const OnsetFrame* frame = frames.at(k);
        Row rise{};
        for (std::size_t l = 0; l < lanes; ++l)
        {
            mask[l] = std::max(mask[l] * maskDecay, before[l]);
            rise[l] = std::max(0.0f, now[l] - before[l]);
        }
        float rises = 0.0f;
        for (std::size_t l = 0; l < all; ++l)
            rises += rise[l];

        const float attack = (frame[0].bands[all] + frame[1].bands[all] + frame[2].bands[all]) / 3.0f;
        const float attackBefore = (frame[-2].bands[all] + frame[-1].bands[all] + frame[0].bands[all]) / 3.0f;
        attackMask = std::max(attackMask * attackDecay, attackBefore);
        float latest = 0.0f;
        for (std::ptrdiff_t j = 1; j <= shortBefore; ++j)
            latest = std::max(latest, frame[-j].bands[all]);

        const bool bandsRise = rises >= bandThreshold * *sum.at(k);
        const bool totalRises = attack >= 4.0f * latest;
        if (!bandsRise && !totalRises)
            return 0.0f;

        const float hum = humOf(frames, k);
        float salience = 0.0f;
        if (bandsRise)
        {
            const float contrast = std::min(1.0f, 1.2409f * before[all] / now[all]);
            const float keep = std::max(hum, contrast * contrast);
            float evidence = 0.0f;
            for (std::size_t l = 0; l < all; ++l)
                evidence += std::max(0.0f, now[l] - std::max(before[l], mask[l] * keep));
            const float loudest = *std::max_element(sum.at(k), sum.at(k + horizon));
            salience = evidence / loudest / bandThreshold;
        }
        if (totalRises)
        {
            const float contrast = std::min(1.0f, 1.2409f * loudnessOf(latest / (attack + 1e-30f)));
            const float keep = std::max(hum, contrast * contrast);
            float loudest = 0.0f;
            for (std::ptrdiff_t j = 0; j < horizon; ++j)
                loudest = std::max(loudest, (frame[j].bands[all] + frame[j + 1].bands[all] + frame[j + 2].bands[all]) / 3.0f);
            const float reference = std::max(loudnessOf(latest + 1e-12f), loudnessOf(attackMask + 1e-12f) * keep);
            const float evidence = std::max(0.0f, loudnessOf(attack + 1e-12f) - reference);
            salience = std::max(salience, evidence / loudnessOf(loudest + 1e-12f) / totalThreshold);
        }
        return salience;
    }

    static float humOf(const SlidingBuffer<OnsetFrame>& frames, std::ptrdiff_t k)
    {
        const OnsetFrame* frame = frames.at(k);
        const std::ptrdiff_t reach = std::min(humBefore, k);
        float hum = 0.0f;
        for (std::ptrdiff_t j = 1; j <= reach; ++j)
            hum += frame[-j].bands[0];
        hum /= static_cast<float>(std::max<std::ptrdiff_t>(reach, 1));
        float humNow = 0.0f;
        for (std::ptrdiff_t j = 0; j < humAfter; ++j)
            humNow += frame[j].bands[0];
        humNow /= static_cast<float>(humAfter);
        float rest = 0.0f;
        for (std::ptrdiff_t j = 0; j < window; ++j)
            rest += frame[j].bands[all] - frame[j].bands[0];
        rest /= static_cast<float>(window);
        const float share = loudnessOf(std::min(1.0f, 4.0f * hum / (humNow + rest + 1e-12f)));
        return share * share * share;
    }

    float maskDecay = std::pow(10.0f, -0.013f * 1000.0f / 900.0f * 5.0f / 16.0f);
    float attackDecay = std::pow(10.0f, -0.013f * 1000.0f / 900.0f);
    SlidingBuffer<Row> loudness{2 * window, -window};
    SlidingBuffer<float> sum{2 * window, -window};
    Row mask{};
    float attackMask = 0.0f;
};

} // namespace pacini
