#pragma once

// Feature extraction for the judge measures.

#include <pacini/evaluate/AnalyticBand.h>
#include <pacini/evaluate/BandLimitedSegment.h>
#include <pacini/evaluate/FrameSpectra.h>
#include <pacini/evaluate/HannSmoothing.h>
#include <pacini/evaluate/PeakScale.h>
#include <pacini/evaluate/RiseDetector.h>
#include <pacini/evaluate/Segmentation.h>
#include <pacini/foundation/DotProduct.h>
#include <pacini/foundation/SplitRealFft.h>
#include <pacini/foundation/Units.h>
#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Power (in an arbitrary but fixed unit) and centroid (Hz, 0 for silence) of the bins from 30 to 1000 Hz of 64 ms Hann
/// frames, in bins of 7.8125 Hz.
class FrameCentroids
{
public:
    struct Frame
    {
        float power = 0.0f;
        float centroid = 0.0f;
    };
    static constexpr std::size_t fineSize = 512;            ///< samples of a frame at 8 kHz
    static constexpr std::size_t coarseSize = fineSize / 2; ///< samples of a frame at 4 kHz

    FrameCentroids()
        : coarseSpectra(hannPeriodic(coarseSize), 2 * coarseSize), fineSpectra(hannPeriodic(fineSize), 2 * fineSize)
    {
        constexpr float binWidth = 8000.0f / (2.0f * fineSize);
        constexpr std::size_t lastBin = 128; // 1000 Hz
        for (std::size_t k = firstBin; k <= lastBin; ++k)
            frequencies.push_back(binWidth * static_cast<float>(k));
        ones.assign(frequencies.size(), 1.0f);
        powers.fill(ones);
    }

    /// Two frames of coarseSize samples at 4 kHz: enough as long as nothing above 2 kHz leaks below 1 kHz, that is, as
    /// long as the signal has no edge inside the frame.
    [[nodiscard]] std::array<Frame, 2> coarse(std::span<const float> a, std::span<const float> b) noexcept
    {
        coarseSpectra.power(a, b, firstBin, powers[0], powers[1]);
        constexpr float scale = 4.0f; // half as many samples make half the amplitude
        return {measured(powers[0], scale), measured(powers[1], scale)};
    }

    /// One frame of fineSize samples at 8 kHz.
    [[nodiscard]] Frame fine(std::span<const float> x) noexcept
    {
        fineSpectra.power(x, x, firstBin, powers[0], powers[1]);
        return measured(powers[0], 1.0f);
    }

private:
    static constexpr std::size_t firstBin = 4; // 31.25 Hz, the first from 30 Hz on

    [[nodiscard]] Frame measured(std::span<const float> power, float scale) const noexcept
    {
        const float sum = dotProduct(power.data(), ones.data(), power.size());
        const float moment = dotProduct(power.data(), frequencies.data(), power.size());
        return {scale * sum, sum > 0.0f ? moment / sum : 0.0f};
    }

    FrameSpectra coarseSpectra;
    FrameSpectra fineSpectra;
    std::array<std::vector<float>, 2> powers;
    std::vector<float> ones;
    std::vector<float> frequencies; // of the bins, Hz
};

/// The mean over `spacing * intervals` neighbouring fine samples, from a curve of which only every `spacing`-th is
/// known. Trapezoidal rule with two end corrections by central differences (the Gauss-Gregory formula; F. Hildebrand,
/// "Introduction to Numerical Analysis", 1956, section 5.8): the rule alone would be 9 % wrong for a component of six
/// samples per period, this is 0.4 %. It reads two samples beyond each end of the frame.
class FrameMean
{
public:
    static constexpr std::size_t reachFrames = 2;

    FrameMean(std::size_t intervals, std::size_t spacing)
    {
        std::vector<double> weights(intervals + 1 + 2 * reachFrames);
        for (std::size_t i = 0; i <= intervals; ++i)
            weights[reachFrames + i] = i == 0 || i == intervals ? 0.5 : 1.0;
        // -1/12 of the first and 11/720 of the third central difference, at the end minus at the start.
        const double difference[] = {-11.0 / 1440.0, 22.0 / 1440.0 + 1.0 / 24.0, 0.0, -22.0 / 1440.0 - 1.0 / 24.0,
                                     11.0 / 1440.0};
        for (std::size_t i = 0; i < 5; ++i)
        {
            weights[intervals + i] += difference[i];
            weights[i] -= difference[i];
        }
        // The fine samples 0 .. n - 1 cover -0.5 to n - 0.5, half a sample earlier than the coarse intervals.
        const double early = 0.5 / static_cast<double>(spacing);
        weights[reachFrames] += early;
        weights[reachFrames + intervals] -= early;
        for (const double weight : weights)
            taps.push_back(static_cast<float>(weight / static_cast<double>(intervals)));
    }

    /// The mean of the frame that starts at x[first]; reads x[first - 2] to x[first + intervals + 2].
    [[nodiscard]] float of(std::span<const float> x, std::size_t first) const noexcept
    {
        return dotProduct(taps.data(), x.data() + first - reachFrames, taps.size());
    }

private:
    std::vector<float> taps;
};

/// The envelope of one band, linear amplitude, one value per `spacing` samples of 8 kHz.
struct BandEnvelope
{
    std::size_t spacing = 0;
    std::vector<float> values;
};

/// Features of one mono signal, divided by `scale`; "in band" is 30-1000 Hz by a zero-phase Butterworth band-pass of
/// order 4.
struct SignalFeatures
{
    static constexpr int sampleRate = 8000;             ///< Hz
    static constexpr std::size_t envelopeSpacing = 8;   ///< samples per value of `wide`: 1 kHz
    static constexpr std::size_t frameSpacing = 80;     ///< samples per frame of the spectral features: 100 Hz
    static constexpr std::size_t bandCount = 12;        ///< log-spaced over 30-1000 Hz
    static constexpr std::size_t thirdOctaveCount = 16; ///< centres 31.25-1000 Hz

    std::size_t length = 0;          ///< samples at 8 kHz
    std::size_t nonFinite = 0;       ///< samples at 8 kHz that were NaN or infinite and count as 0
    double scale = 1.0;              ///< a power of two near the signal's peak
    double rms = 0.0;                ///< in band
    std::optional<double> outOfBand; ///< dB, energy outside the band over energy inside; empty for silence
    std::vector<float> wide;         ///< envelope in band
    std::array<BandEnvelope, bandCount> bands;
    std::array<std::vector<float>, thirdOctaveCount> thirdOctaves; ///< mean powers of 20 ms frames
    std::vector<float> framePower; ///< of 64 ms Hann frames, 30-1000 Hz, in an arbitrary but fixed unit
    std::vector<float> centroid;   ///< Hz, of the same frames; 0 for silence
    std::vector<double> onsets;    ///< s, by the neutral detector
};

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
                Decibels::fromPower(std::max(energies.outside, least) / std::max(energies.inside, least)).value;
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
