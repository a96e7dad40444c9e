#pragma once

// Feature extraction for the judge measures.

#include <pacini/evaluate/AnalyticBand.h>
#include <pacini/evaluate/BandLimitedSegment.h>
#include <pacini/evaluate/FrameCentroids.h>
#include <pacini/evaluate/FrameMean.h>
#include <pacini/evaluate/HannSmoothing.h>
#include <pacini/evaluate/PeakScale.h>
#include <pacini/evaluate/RiseDetector.h>
#include <pacini/evaluate/Segmentation.h>
#include <pacini/evaluate/SignalFeatures.h>
#include <pacini/foundation/SplitRealFft.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Computes SignalFeatures of mono signals at 8 kHz that are cut or padded to one length; transforms and filters are
/// planned once. The measures are defined by a whole-file analysis at 8 kHz with silence around the file. Here long
/// files are cut into overlapping segments, and each band is sampled only as often as its width asks for: the envelope
/// of a narrow band is slow, and every measure is a mean over time.
class SignalAnalyzer
{
public:
    /// `signalLength`: samples at 8 kHz; 0 counts as 1.
    explicit SignalAnalyzer(std::size_t signalLength)
        : length(std::max<std::size_t>(signalLength, 1)),
          segmentation(length, {.quantum = 2 * hop,
                                .lead = 8 * hop,
                                .padding = 50 * hop,
                                .overlap = 50 * hop,
                                .longestCore = 412 * hop}),
          size(segmentation.size()),
          limited(size, fs, lowest, highest),
          scratch(size),
          analytic(size),
          magnitude(size),
          wholeBand(size, size, 0, std::vector<float>(size / 2 + 1, 1.0f)),
          frameBand(size, size / 2, 0, std::vector<float>(size / 4, 1.0f)),
          lowOnsetBand(butterworth(isShort() ? 1 : 4, lowest, onsetSplit, 2)),
          highOnsetBand(butterworth(isShort() ? 1 : 2, onsetSplit, highest, 2))
    {
        const auto edge = [](std::size_t k)
        {
            return lowest *
                   std::pow(highest / lowest, static_cast<double>(k) / static_cast<double>(SignalFeatures::bandCount));
        };
        for (std::size_t k = 0; k < bands.size(); ++k)
            bands[k] = butterworth(std::min(spacingFor(edge(k + 1) - edge(k)), longestEnvelopeSpacing), edge(k),
                                   edge(k + 1), 3);
        for (std::size_t k = 0; k < thirdOctaves.size(); ++k)
        {
            const double centre = highest * std::exp2((static_cast<double>(k) - 15.0) / 3.0);
            const double low = centre * std::exp2(-1.0 / 6.0);
            const double high = centre * std::exp2(1.0 / 6.0);
            thirdOctaves[k] = butterworth(spacingFor(high - low), low, high, 3);
        }
    }

    /// The features of `x` at 8 kHz, cut or padded with silence to the length. Samples that are not finite count as 0.
    template <typename Sample>
    [[nodiscard]] SignalFeatures analyze(std::span<const Sample> x)
    {
        SignalFeatures features;
        features.length = length;
        features.nonFinite =
            static_cast<std::size_t>(std::count_if(x.begin(), x.end(), [](Sample v) { return !std::isfinite(v); }));
        x = x.first(std::min(x.size(), length));
        features.scale = peakScale(x);
        BandLimitEnergies energies;
        OnsetEnvelopes onsets;
        for (const Segment& segment : segmentation.segments())
        {
            limited.load(x, segment, 1.0 / features.scale, energies);
            limited.cutSamples(segment, length);
            addEnvelopes(segment, features, onsets);
            addThirdOctaves(segment, features);
            addFrames(segment, features);
        }
        features.rms = std::sqrt(energies.inside / static_cast<double>(length));
        if (energies.total > 0.0)
        {
            const double least = 1e-20 / (features.scale * features.scale);
            features.outOfBand =
                10.0 * std::log10(std::max(energies.outside, least) / std::max(energies.inside, least));
        }
        for (const std::size_t peak : detectRises({onsets.wide, onsets.low, onsets.high}, RiseDetectorParams{}))
            features.onsets.push_back(std::max((static_cast<double>(peak) - 5.0) / 1000.0, 0.0)); // middle of the rise
        return features;
    }

private:
    static constexpr double fs = SignalFeatures::sampleRate;
    static constexpr double lowest = 30.0;
    static constexpr double highest = 1000.0;
    static constexpr double onsetSplit = 200.0;
    static constexpr std::size_t hop = SignalFeatures::frameSpacing;
    static constexpr double hannHalfWidth = 81.0;      // samples at 8 kHz: 20 ms from end to end
    static constexpr double onsetHannHalfWidth = 21.0; // 5 ms
    /// Eight samples in the smoothing kernel. With four, the step of an offset at the start of a file moved the
    /// signal-to-noise ratios by 1 %, with eight by 0.1 %.
    static constexpr std::size_t longestEnvelopeSpacing = 20;
    static constexpr std::size_t guard = 2 * hop; // samples around the core that smoothing and frames may need

    struct OnsetEnvelopes
    {
        std::vector<float> wide, low, high;
    };

    /// In files below 0.2 s the ends weigh too much for coarse sampling.
    [[nodiscard]] bool isShort() const noexcept { return length < 1600; }

    /// Distance in samples, a divisor of the hop, at which a band of this width (Hz) is sampled: eight times its width.
    /// At six times the measures were up to 0.4 % off.
    [[nodiscard]] std::size_t spacingFor(double bandwidth) const noexcept
    {
        if (isShort())
            return 1;
        for (const std::size_t spacing : {40u, 20u, 16u, 10u, 8u, 5u})
            if (fs / static_cast<double>(spacing) >= 8.0 * bandwidth)
                return spacing;
        return 4;
    }

    [[nodiscard]] AnalyticBand butterworth(std::size_t spacing, double f1, double f2, int order) const
    {
        return AnalyticBand::butterworth(size, size / spacing, fs, f1, f2, order);
    }
    [[nodiscard]] std::size_t spacingOf(const AnalyticBand& band) const noexcept { return size / band.outputCount(); }

    void sampleBand(const AnalyticBand& band) { band.sample(limited.spectrum(), transforms, scratch, analytic); }

    /// Magnitudes of the analytic signal in the core and `guard` samples around it, 0 outside the file.
    void fillMagnitudes(const Segment& segment, std::size_t spacing) noexcept
    {
        const std::size_t begin = (segment.localIndex(segment.coreBegin) - guard) / spacing;
        const std::size_t end = (segment.localIndex(segment.coreEnd) + guard) / spacing;
        for (std::size_t j = begin; j < end; ++j)
            magnitude[j] = std::sqrt(analytic.re[j] * analytic.re[j] + analytic.im[j] * analytic.im[j]);
        const auto weigh = [&](std::size_t j)
        {
            const double position = static_cast<double>(segment.begin) + static_cast<double>(j * spacing);
            magnitude[j] *= static_cast<float>(coverage(position, static_cast<double>(spacing), length));
        };
        const std::size_t ends = guard / spacing + 1;
        for (std::size_t j = begin; j < std::min(begin + ends, end); ++j)
            weigh(j);
        for (std::size_t j = std::max(begin + ends, end - ends); j < end; ++j)
            weigh(j);
    }

    /// Appends every `stride`-th smoothed magnitude of the core.
    void appendSmoothed(const Segment& segment, std::size_t spacing, std::size_t stride, double halfWidth,
                        std::vector<float>& out) const
    {
        const HannKernel kernel(halfWidth / static_cast<double>(spacing));
        std::size_t j = segment.localIndex(segment.coreBegin, spacing);
        const std::size_t reach = (kernel.reachFrames() + 1) * spacing;
        for (std::size_t at = segment.coreBegin; at < segment.coreEnd; at += spacing * stride, j += stride)
        {
            float value = kernel.at(magnitude, j);
            if (spacing > 1 && (at < reach || at + reach >= length))
                value *= static_cast<float>(
                    kernel.endCorrection(static_cast<double>(at), static_cast<double>(spacing), length));
            out.push_back(value);
        }
    }

    void addEnvelopes(const Segment& segment, SignalFeatures& features, OnsetEnvelopes& onsets)
    {
        const auto fill = [&](const AnalyticBand& band)
        {
            sampleBand(band);
            fillMagnitudes(segment, spacingOf(band));
        };
        const auto append = [&](const AnalyticBand& band, double halfWidth, std::vector<float>& out)
        {
            appendSmoothed(segment, spacingOf(band), SignalFeatures::envelopeSpacing / spacingOf(band), halfWidth, out);
        };
        fill(wholeBand);
        append(wholeBand, hannHalfWidth, features.wide);
        append(wholeBand, onsetHannHalfWidth, onsets.wide);
        fill(lowOnsetBand);
        append(lowOnsetBand, onsetHannHalfWidth, onsets.low);
        fill(highOnsetBand);
        append(highOnsetBand, onsetHannHalfWidth, onsets.high);
        for (std::size_t k = 0; k < bands.size(); ++k)
        {
            const std::size_t stride = isShort() ? SignalFeatures::envelopeSpacing : 1;
            features.bands[k].spacing = stride * spacingOf(bands[k]);
            fill(bands[k]);
            appendSmoothed(segment, spacingOf(bands[k]), stride, hannHalfWidth, features.bands[k].values);
        }
    }

    /// Mean powers of frames of two hops; a file shorter than that is one frame.
    void addThirdOctaves(const Segment& segment, SignalFeatures& features)
    {
        const std::size_t frameSize = std::min(2 * hop, length);
        for (std::size_t k = 0; k < thirdOctaves.size(); ++k)
        {
            sampleBand(thirdOctaves[k]);
            const std::size_t spacing = spacingOf(thirdOctaves[k]);
            const std::size_t begin = (segment.localIndex(segment.coreBegin) - guard) / spacing;
            const std::size_t end = (segment.localIndex(segment.coreEnd) + 2 * guard) / spacing;
            for (std::size_t j = begin; j < end; ++j)
                magnitude[j] = 0.5f * (analytic.re[j] * analytic.re[j] + analytic.im[j] * analytic.im[j]);
            const FrameMean mean(frameSize / spacing, spacing);
            for (std::size_t at = segment.coreBegin; at < segment.coreEnd && at + frameSize <= length; at += hop)
                features.thirdOctaves[k].push_back(std::max(mean.of(magnitude, segment.localIndex(at, spacing)), 0.0f));
        }
    }

    /// Frames are centred on every hop up to one beyond the end. They need only half the rate, except where an end of
    /// the file cuts through them.
    void addFrames(const Segment& segment, SignalFeatures& features)
    {
        sampleBand(frameBand);
        constexpr std::size_t half = FrameCentroids::fineSize / 2;
        const std::size_t end = segment.coreEnd == length ? length / hop + 2 : segment.coreEnd / hop;
        const auto isWhole = [&](std::size_t m)
        {
            return m * hop >= half && m * hop + half <= length;
        };
        const auto fine = [&](std::size_t m)
        {
            return limited.samples().subspan(segment.localIndex(m * hop) - half, FrameCentroids::fineSize);
        };
        const auto coarse = [&](std::size_t m)
        {
            return std::span<const float>(analytic.re)
                .subspan(segment.localIndex(m * hop, 2) - half / 2, FrameCentroids::coarseSize);
        };
        const auto add = [&](const FrameCentroids::Frame& frame)
        {
            features.framePower.push_back(frame.power);
            features.centroid.push_back(frame.centroid);
        };
        for (std::size_t m = segment.coreBegin / hop; m < end; ++m)
        {
            if (!isWhole(m))
            {
                add(frames.fine(fine(m)));
                continue;
            }
            const bool two = m + 1 < end && isWhole(m + 1);
            const auto pair = frames.coarse(coarse(m), coarse(two ? m + 1 : m));
            add(pair[0]);
            if (two)
            {
                add(pair[1]);
                ++m;
            }
        }
    }

    std::size_t length;
    Segmentation segmentation;
    std::size_t size;
    BandLimitedSegment limited;
    InverseTransforms transforms;
    SplitArray<float> scratch;
    SplitArray<float> analytic;
    std::vector<float> magnitude;
    AnalyticBand wholeBand;
    AnalyticBand frameBand;
    AnalyticBand lowOnsetBand;
    AnalyticBand highOnsetBand;
    std::array<AnalyticBand, SignalFeatures::bandCount> bands;
    std::array<AnalyticBand, SignalFeatures::thirdOctaveCount> thirdOctaves;
    FrameCentroids frames;
};

} // namespace pacini
