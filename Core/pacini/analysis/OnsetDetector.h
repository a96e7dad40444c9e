#pragma once

// Finds the events of a sound: where something starts.

#include <pacini/analysis/OnsetFeatures.h>
#include <pacini/analysis/OnsetFrame.h>
#include <pacini/analysis/OnsetSalience.h>
#include <pacini/analysis/SlidingBuffer.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

struct Onset
{
    double time = 0.0;
    double amplitude = 0.0;
    double lowAmplitude = 0.0;
    double sharpness = 0.0;
    double salience = 0.0;
    bool operator==(const Onset&) const = default;
};

struct OnsetParams
{
    double sensitivity = 1.0;
    Seconds minimumGap{0.010};
    Decibels maskMargin{8.0};
    double maskSlope = 0.06;
    double maskRecovery = 20.0;
    Decibels maskLimit{27.0};
    Decibels silence{-90.0};
};

class OnsetDetector
{
public:
    explicit OnsetDetector(const OnsetParams& onsetParams = {}) : params(onsetParams) {}

    void push(std::span<const OnsetFrame> more)
    {
        std::copy(more.begin(), more.end(), frames.extend(std::ssize(more)));
        total += std::ssize(more);
        advance();
    }

    [[nodiscard]] std::vector<Onset> finish()
    {
        std::fill_n(frames.extend(tail), tail, OnsetFrame{});
        advance();
        return audible();
    }

private:
    struct Peak
    {
        std::ptrdiff_t frame;
        float salience;
    };

    static constexpr std::ptrdiff_t peakReach = 5;
    static constexpr std::ptrdiff_t measureAhead = 24;
    static constexpr std::ptrdiff_t tail = OnsetSalience::lookAhead + measureAhead + 8; ///< silence after the end
    static constexpr std::ptrdiff_t past = OnsetSalience::history;

    void advance()
    {
        score.extend(frames, salience);
        const auto gap = static_cast<std::ptrdiff_t>(std::ceil(params.minimumGap.frames(OnsetFrame::rate) - 1e-9));
        for (; picked + peakReach < salience.end(); ++picked)
            if (*salience.at(picked) * params.sensitivity >= 1.0 && isPeak(picked) &&
                (candidates.empty() || picked - candidates.back().frame >= gap))
                candidates.push_back({picked, *salience.at(picked)});
        for (; measured < std::ssize(candidates); ++measured)
        {
            const Peak& peak = candidates[static_cast<std::size_t>(measured)];
            if (peak.frame + measureAhead > picked)
                break;
            const bool last = measured + 1 == std::ssize(candidates);
            onsets.push_back(measure(peak, last ? picked : candidates[static_cast<std::size_t>(measured) + 1].frame));
        }
        const std::ptrdiff_t needed = measured < std::ssize(candidates) ? candidates[static_cast<std::size_t>(measured)].frame : picked;
        frames.forget(needed - past);
        salience.forget(picked - peakReach);
    }

    [[nodiscard]] bool isPeak(std::ptrdiff_t k) const
    {
        const float* s = salience.at(k);
        for (std::ptrdiff_t j = 1; j <= peakReach; ++j)
            if (s[-j] >= s[0] || s[j] > s[0])
                return false;
        return true;
    }

    [[nodiscard]] Onset measure(const Peak& found, std::ptrdiff_t nextOne) const
    {
        const std::ptrdiff_t k = found.frame;
        const std::ptrdiff_t start = attackStart(k);
        Onset onset;
        onset.salience = static_cast<double>(found.salience);
        const double here = static_cast<double>(frames.at(start)->power);
        const double then = static_cast<double>(frames.at(start + 1)->power);
        const double filled = here < then ? here / then : 1.0;
        onset.time = std::max(0.0, (static_cast<double>(start) + 1.0 - filled) / OnsetFrame::rate);
        const std::ptrdiff_t end = std::max(start + 5, std::min(k + 22, nextOne));
        double peak = 0.0, lowPeak = 0.0;
        for (std::ptrdiff_t j = start - 1; j + 5 <= end; ++j)
        {
            double sum = 0.0, lowSum = 0.0;
            for (std::ptrdiff_t i = j; i < j + 5; ++i)
            {
                sum += static_cast<double>(frames.at(i)->power);
                lowSum += static_cast<double>(frames.at(i)->lowPower);
            }
            peak = std::max(peak, sum / 5.0);
            lowPeak = std::max(lowPeak, lowSum / 5.0);
        }
        onset.amplitude = std::sqrt(2.0 * peak);
        onset.lowAmplitude = std::sqrt(2.0 * lowPeak);
        double weight = 0.0, centre = 0.0;
        for (std::size_t b = 0; b < OnsetFrame::bandCount; ++b)
        {
            double gain = 0.0;
            for (std::ptrdiff_t j = 0; j < 8; ++j)
                gain += static_cast<double>(frames.at(start + j)->bands[b]) - static_cast<double>(frames.at(start - 1 - j)->bands[b]);
            gain = std::max(0.0, gain);
            weight += gain;
            centre += gain * std::log2(OnsetFrame::bandCentres[b]);
        }
        const double low = std::log2(150.0), high = std::log2(2500.0);
        onset.sharpness = weight > 0.0 ? std::clamp((centre / weight - low) / (high - low), 0.0, 1.0) : 0.0;
        return onset;
    }

    [[nodiscard]] std::ptrdiff_t attackStart(std::ptrdiff_t k) const
    {
        const OnsetFrame* f = frames.at(k);
        float peak = 0.0f;
        for (std::ptrdiff_t j = -3; j < 9; ++j)
            peak = std::max(peak, f[j].power);
        std::ptrdiff_t j = -3;
        while (j < 8 && f[j].power < 0.25f * peak)
            ++j;
        std::array<float, 10> before;
        for (std::ptrdiff_t i = 0; i < 10; ++i)
            before[static_cast<std::size_t>(i)] = f[j - 14 + i].power;
        std::nth_element(before.begin(), before.begin() + 5, before.end());
        const float threshold = std::max(0.0064f * peak, std::min(6.25f * before[5], 0.25f * peak));
        const std::ptrdiff_t earliest = std::max(j - 9, -k);
        while (j > earliest && f[j - 1].power > threshold)
            --j;
        return k + j;
    }

    [[nodiscard]] std::vector<Onset> audible() const
    {
        std::vector<double> level(onsets.size()), mask(onsets.size());
        for (std::size_t i = 0; i < onsets.size(); ++i)
            level[i] = Decibels::fromGain(onsets[i].amplitude + 1e-9).value;
        double reach = -1e9;
        for (std::size_t i = 0; i < onsets.size(); ++i)
        {
            if (i > 0)
                reach -= params.maskRecovery * (onsets[i].time - onsets[i - 1].time);
            mask[i] = reach;
            reach = std::max(reach, level[i]);
        }
        reach = -1e9;
        for (std::size_t i = onsets.size(); i-- > 0;)
        {
            if (i + 1 < onsets.size())
                reach -= params.maskRecovery * (onsets[i + 1].time - onsets[i].time);
            mask[i] = std::max(mask[i], reach);
            reach = std::max(reach, level[i]);
        }
        std::vector<Onset> kept;
        for (std::size_t i = 0; i < onsets.size(); ++i)
        {
            const double deficit = mask[i] - level[i];
            const double needed = 1.0 + params.maskSlope * std::max(0.0, deficit - params.maskMargin.value);
            if (level[i] >= params.silence.value && deficit <= params.maskLimit.value && onsets[i].salience * params.sensitivity >= needed)
                kept.push_back(onsets[i]);
        }
        return kept;
    }

    OnsetParams params;
    OnsetSalience score;
    SlidingBuffer<OnsetFrame> frames{past};
    SlidingBuffer<float> salience{peakReach};
    std::vector<Peak> candidates;
    std::vector<Onset> onsets;
    std::ptrdiff_t total = 0;
    std::ptrdiff_t picked = 0;
    std::ptrdiff_t measured = 0;
};

inline std::vector<Onset> detectOnsets(std::span<const float> interleaved, std::size_t channels, double fs, const OnsetParams& params = {})
{
    OnsetFeatures features(fs, channels);
    OnsetDetector detector(params);
    const std::size_t block = 8192 * channels;
    for (std::size_t i = 0; i < interleaved.size(); i += block)
    {
        features.push(interleaved.subspan(i, std::min(block, interleaved.size() - i)));
        detector.push(features.frames());
        features.drop(features.frames().size());
    }
    features.finish();
    detector.push(features.frames());
    return detector.finish();
}

} // namespace pacini
