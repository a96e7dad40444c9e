#pragma once

// Offline band analysis: a sound at 4 kHz becomes envelopes and pitches of bands, frame by frame.

#include <pacini/analysis/AnalyticTrack.h>
#include <pacini/clip/BandTiling.h>
#include <pacini/foundation/SplitRealFft.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The cross-fades between adjoining bands: raised cosines on log frequency, centred on the edges. At every frequency
/// the weights of all bands and of what lies outside sum to one, so nothing is lost or counted twice.
class BandFades
{
public:
    /// `overlap` is the width of a cross-fade as a share of the narrower of the two bands (0-1].
    BandFades(std::span<const BandEdges> bands, double overlap)
    {
        const auto ratio = [&](std::size_t k)
        {
            return bands[k].high / bands[k].low;
        };
        for (std::size_t e = 0; e <= bands.size(); ++e)
        {
            const double below = ratio(e > 0 ? e - 1 : 0);
            const double above = ratio(e < bands.size() ? e : e - 1);
            fades.push_back({std::log(e < bands.size() ? bands[e].low : bands.back().high),
                             overlap * std::log(std::min(below, above))});
        }
    }

    /// Lowest and highest frequency that bands `first` to `last` (inclusive) react to, Hz.
    [[nodiscard]] double lowestFrequency(std::size_t first) const
    {
        return std::exp(fades[first].edge - 0.5 * fades[first].width);
    }
    [[nodiscard]] double highestFrequency(std::size_t last) const
    {
        return std::exp(fades[last + 1].edge + 0.5 * fades[last + 1].width);
    }

    /// Weight (0-1) of bands `first` to `last` (inclusive) together at `frequency` > 0.
    [[nodiscard]] double weight(std::size_t first, std::size_t last, double frequency) const
    {
        const double logF = std::log(frequency);
        return above(fades[first], logF) - above(fades[last + 1], logF);
    }

private:
    struct Fade
    {
        double edge; // natural logarithm of Hz
        double width;
    };

    static double above(const Fade& fade, double logF)
    {
        const double u = std::clamp((logF - fade.edge) / fade.width, -0.5, 0.5);
        return 0.5 + 0.5 * std::sin(std::numbers::pi * u);
    }

    std::vector<Fade> fades;
};

/// The sample rate of all offline analysis, Hz: twice the top of the range of touch (1-1.8 kHz) and more.
inline constexpr int analysisRate = 4000;

/// Parameters of the band analysis.
struct BandAnalysisParams
{
    std::vector<BandEdges> bands;  ///< adjoining, frequencies rise
    double overlap = 0.5;          ///< see BandFades
    Seconds envelopeWindow{0.010}; ///< Hann window of the total envelope
    Seconds bandWindow{0.040};     ///< Hann window of band envelopes and pitches
    bool onlyPeak = false;         ///< find nothing but BandAnalysisResult::peak
    bool operator==(const BandAnalysisParams&) const = default;
};

/// Result of the analysis, densely sampled: frame i of an array is at time i * its step.
struct BandAnalysisResult
{
    static constexpr double envelopeStep = 0.005; ///< s
    static constexpr double bandStep = 0.020;     ///< s

    struct Track
    {
        std::vector<float> amplitude; ///< linear: amplitude of the sine of equal power
        std::vector<float> frequency; ///< Hz: power-weighted mean frequency within the band; 0 where silent
    };

    double peak = 0.0;             ///< largest magnitude of the analytic signal of all bands together
    std::vector<float> envelope;   ///< mean magnitude of that analytic signal
    std::vector<Track> tracks;     ///< one for every band
    std::vector<float> heardShare; ///< 0-1 of each value of `envelope`: how far HeardInstead took over; empty: nowhere
    std::vector<std::vector<float>>
        noise; ///< linear RMS, a frame every bandStep, of each noise band of the clip, if any

    /// Returns the time up to which all frames are complete, s. O(bands).
    [[nodiscard]] double seconds() const noexcept
    {
        std::size_t frames = tracks.front().amplitude.size();
        for (const Track& track : tracks)
            frames = std::min(frames, track.amplitude.size());
        return std::min(static_cast<double>(frames) * bandStep, static_cast<double>(envelope.size()) * envelopeStep);
    }

    /// Removes the first `length` s, a multiple of bandStep below seconds(). The remaining times decrease by `length`.
    /// Both parts contain the frame at the cut, and the peak.
    [[nodiscard]] BandAnalysisResult takeFirst(double length)
    {
        const auto cut = [length](std::vector<float>& frames, double step)
        {
            const auto at = frames.begin() + static_cast<std::ptrdiff_t>(std::llround(length / step));
            std::vector<float> first(frames.begin(), at + 1);
            frames.erase(frames.begin(), at);
            return first;
        };
        BandAnalysisResult first;
        first.peak = peak;
        first.envelope = cut(envelope, envelopeStep);
        if (!heardShare.empty())
            first.heardShare = cut(heardShare, envelopeStep);
        for (Track& track : tracks)
            first.tracks.push_back({cut(track.amplitude, bandStep), cut(track.frequency, bandStep)});
        for (std::vector<float>& levels : noise)
            first.noise.push_back(cut(levels, bandStep));
        return first;
    }
};

/// Zero-phase analysis of a stream of one or more channels at analysisRate. The signal is cut into blocks with short
/// cross-fades; each block is transformed once, the channels are mixed in the spectrum so that nothing can cancel, and
/// each band is transformed back from just its own bins, at a low rate, as an analytic signal. Bands are linear
/// filters, so blocks add up to what one transform of the whole sound would give, but for the ringing that outlasts the
/// 0.25 s guard. Transforms are in float: their rounding lies 130 dB below the peak of a block, and clips end at -72
/// dB. Memory grows only with the result, 5.6 kB per second for 12 bands, and not even so where takeFirst() carries
/// that off. reset() makes the object ready for the next sound and keeps its transforms, whose making costs as much as
/// a second of sound.
class BandAnalysis
{
public:
    explicit BandAnalysis(const BandAnalysisParams& params)
        : settings(params),
          fades(params.bands, params.overlap),
          wide(envelopeRate, params.envelopeWindow.value, BandAnalysisResult::envelopeStep)
    {
        assert(!params.bands.empty());
        for (std::size_t k = 0; k < bandCount(); ++k)
        {
            // The lowest of a few rates that holds the band with room for its frequency to be read off the rotation.
            const double width = fades.highestFrequency(k) - fades.lowestFrequency(k);
            int rate = 250;
            while (rate < envelopeRate && width > 0.8 * rate)
                rate *= 2;
            tracks.emplace_back(rate, settings.bandWindow.value, BandAnalysisResult::bandStep);
        }
        reset(1);
    }

    /// Starts over with a sound of `channels` channels. Room for `expected` samples of it, 4 hours at most, spares the
    /// results from being moved, and memory from holding them twice, while they grow; they may become longer.
    void reset(std::size_t channels, std::uint64_t expected = 0)
    {
        pending.assign(channels, {});
        blockStart = 0;
        received = 0;
        wide.reset();
        for (AnalyticTrack& track : tracks)
            track.reset();
        output = {};
        output.tracks.resize(bandCount());
        const double seconds =
            settings.onlyPeak ? 0.0 : std::min(static_cast<double>(expected) / analysisRate, longestReserved);
        const auto frames = [seconds](double step)
        {
            return static_cast<std::size_t>(seconds / step) + 2;
        };
        output.envelope.reserve(frames(BandAnalysisResult::envelopeStep));
        for (BandAnalysisResult::Track& track : output.tracks)
        {
            track.amplitude.reserve(frames(BandAnalysisResult::bandStep));
            track.frequency.reserve(frames(BandAnalysisResult::bandStep));
        }
    }

    /// Takes the next samples, one span per channel, all of one length.
    void push(std::span<const std::span<const float>> channels)
    {
        assert(channels.size() == pending.size());
        for (std::size_t c = 0; c < channels.size(); ++c)
            pending[c].insert(pending[c].end(), channels[c].begin(), channels[c].end());
        received += channels.front().size();
        // The last block must stay whole, since it has no fade-out: go on only when more than a block is there.
        while (pending.front().size() > bodyFrames)
            analyseAndAdvance();
    }

    /// Values of the envelope that finish() will have found in all.
    [[nodiscard]] std::int64_t envelopeFrames() const noexcept { return framesEvery(BandAnalysisResult::envelopeStep); }

    /// The completed frames. Frames taken from the front are not kept.
    [[nodiscard]] BandAnalysisResult& found() noexcept { return output; }

    /// Completes the analysis of the sound and returns the frames that were not taken.
    [[nodiscard]] BandAnalysisResult finish()
    {
        analyseBlock(pending.front().size(), true);
        return std::exchange(output, {});
    }

private:
    static constexpr std::size_t guardFrames = 1024; // ringing before and after a block
    static constexpr std::size_t longestFft = 8192;  // 2.048 s
    static constexpr std::size_t bodyFrames = longestFft - 2 * guardFrames;
    static constexpr std::size_t fadeFrames = 512;
    static constexpr std::size_t hopFrames = bodyFrames - fadeFrames;
    static constexpr int envelopeRate = 2000;
    static constexpr double longestReserved = 4.0 * 3600.0; // s: memory shall not follow what a header claims

    /// Transform and weights of one range of bins.
    struct BinRange
    {
        std::size_t first = 0;
        std::vector<float> weights; // with the scale of the transforms and the 2 of analytic signals
        SplitFft<float> inverse;
    };

    /// Everything that depends on the size of a block; short sounds take a short block.
    struct Plan
    {
        SplitRealFft<float> forward;
        BinRange wide;
        std::vector<BinRange> bands;
    };

    [[nodiscard]] std::size_t bandCount() const noexcept { return settings.bands.size(); }

    /// Number of frames for the samples received, one every `step` s.
    [[nodiscard]] std::int64_t framesEvery(double step) const noexcept
    {
        return static_cast<std::int64_t>(std::floor(static_cast<double>(received) / analysisRate / step + 1e-9)) + 1;
    }

    [[nodiscard]] BinRange makeRange(std::size_t size, std::size_t firstBand, std::size_t lastBand, int rate) const
    {
        const double binWidth = static_cast<double>(analysisRate) / static_cast<double>(size);
        BinRange range{0, {}, SplitFft<float>(size * static_cast<std::size_t>(rate) / analysisRate)};
        range.first = static_cast<std::size_t>(std::max(1.0, std::ceil(fades.lowestFrequency(firstBand) / binWidth)));
        const auto last = static_cast<std::size_t>(fades.highestFrequency(lastBand) / binWidth);
        const std::size_t end = std::min({last + 1, size / 2, range.first + range.inverse.size()});
        for (std::size_t b = range.first; b < end; ++b)
            range.weights.push_back(
                static_cast<float>(2.0 / static_cast<double>(size) *
                                   fades.weight(firstBand, lastBand, static_cast<double>(b) * binWidth)));
        return range;
    }

    Plan& planFor(std::size_t frames, bool only)
    {
        std::size_t size = only ? 2 * guardFrames : longestFft;
        while (size < frames + 2 * guardFrames)
            size *= 2;
        for (const auto& plan : plans)
            if (plan->forward.size() == size)
                return *plan;
        auto plan = std::make_unique<Plan>(
            Plan{SplitRealFft<float>(size), makeRange(size, 0, bandCount() - 1, envelopeRate), {}});
        for (std::size_t k = 0; k < bandCount(); ++k)
            plan->bands.push_back(makeRange(size, k, k, tracks[k].rate()));
        plans.push_back(std::move(plan));
        return *plans.back();
    }

    void analyseAndAdvance()
    {
        analyseBlock(bodyFrames, false);
        for (auto& channel : pending)
            channel.erase(channel.begin(), channel.begin() + static_cast<std::ptrdiff_t>(hopFrames));
        blockStart += static_cast<std::int64_t>(hopFrames);
    }

    void analyseBlock(std::size_t frames, bool last)
    {
        Plan& plan = planFor(frames, blockStart == 0 && last);
        const std::size_t size = plan.forward.size();
        spectra.resize(pending.size());
        block.assign(size, 0.0f);
        for (std::size_t c = 0; c < pending.size(); ++c)
        {
            std::copy_n(pending[c].begin(), frames, block.begin() + guardFrames);
            for (std::size_t i = 0; blockStart > 0 && i < std::min(frames, fadeFrames); ++i)
                block[guardFrames + i] *= fadeIn[i];
            for (std::size_t i = hopFrames; !last && i < frames; ++i)
                block[guardFrames + i] *= 1.0f - fadeIn[i - hopFrames];
            spectra[c].re.resize(plan.forward.bins());
            spectra[c].im.resize(plan.forward.bins());
            plan.forward.forward(block.data(), spectra[c].re.data(), spectra[c].im.data());
        }
        if (spectra.size() > 1)
            mixChannels(plan);

        // Frames before the next block's guard are complete.
        const std::int64_t complete =
            last ? std::numeric_limits<std::int64_t>::max() / 2
                 : blockStart + static_cast<std::int64_t>(hopFrames) - static_cast<std::int64_t>(guardFrames);
        const auto feed = [&]<FrameContent content>(BinRange& range, AnalyticTrack& track, double step, auto&& emit)
        {
            const std::int64_t perSample = analysisRate / track.rate();
            computeAnalytic(range, size);
            track.add((blockStart - static_cast<std::int64_t>(guardFrames)) / perSample, part.re, part.im);
            track.drain<content>(complete / perSample, framesEvery(step), emit);
        };
        feed.template operator()<FrameContent::magnitude>(
            plan.wide, wide, BandAnalysisResult::envelopeStep,
            [&](const AnalyticFrame& frame)
            {
                if (!settings.onlyPeak)
                    output.envelope.push_back(static_cast<float>(frame.magnitude));
                output.peak = std::max(output.peak, std::sqrt(frame.peakPower));
            });
        for (std::size_t k = 0; !settings.onlyPeak && k < bandCount(); ++k)
        {
            const double base = static_cast<double>(plan.bands[k].first) * analysisRate / static_cast<double>(size);
            feed.template operator()<FrameContent::powerAndRotation>(
                plan.bands[k], tracks[k], BandAnalysisResult::bandStep,
                [&](const AnalyticFrame& frame) { emitBand(output.tracks[k], frame, base, tracks[k].rate()); });
        }
    }

    /// Fills `part` with the analytic signal of a range of bins, turned down by the frequency of its first bin and by
    /// the same phase in every block, so that blocks add up.
    void computeAnalytic(BinRange& range, std::size_t size)
    {
        const std::size_t n = range.inverse.size();
        const double turns = static_cast<double>(range.first) *
                             static_cast<double>(blockStart - static_cast<std::int64_t>(guardFrames)) /
                             static_cast<double>(size);
        const double angle = -2.0 * std::numbers::pi * (turns - std::floor(turns));
        const auto c = static_cast<float>(std::cos(angle));
        const auto s = static_cast<float>(std::sin(angle));
        for (auto* array : {&bins.re, &bins.im, &part.re, &part.im})
            array->resize(n);
        const float* re = spectra.front().re.data() + range.first;
        const float* im = spectra.front().im.data() + range.first;
        const std::size_t used = range.weights.size();
        for (std::size_t i = 0; i < used; ++i)
        {
            bins.re[i] = range.weights[i] * (re[i] * c - im[i] * s);
            bins.im[i] = range.weights[i] * (re[i] * s + im[i] * c);
        }
        std::fill(bins.re.begin() + static_cast<std::ptrdiff_t>(used), bins.re.end(), 0.0f);
        std::fill(bins.im.begin() + static_cast<std::ptrdiff_t>(used), bins.im.end(), 0.0f);
        range.inverse.inverse(bins.re.data(), bins.im.data(), part.re.data(), part.im.data());
    }

    /// Mixes all channels into spectra.front(): the mean, except in bands where the mean has lost more than half of the
    /// power that unrelated channels would keep (antiphase); there the strongest channel takes over gradually.
    void mixChannels(const Plan& plan)
    {
        const auto n = static_cast<float>(spectra.size());
        const std::size_t size = spectra.front().re.size();
        SplitArray<float> mean(size);
        for (const auto& spectrum : spectra)
            for (std::size_t b = 0; b < size; ++b)
            {
                mean.re[b] += spectrum.re[b] / n;
                mean.im[b] += spectrum.im[b] / n;
            }
        SplitArray<float> mixed = mean;
        for (const BinRange& range : plan.bands)
        {
            const auto powerOf = [&](const SplitArray<float>& spectrum)
            {
                double power = 0.0;
                for (std::size_t i = 0; i < range.weights.size(); ++i)
                {
                    const float re = spectrum.re[range.first + i];
                    const float im = spectrum.im[range.first + i];
                    power += static_cast<double>(range.weights[i] * (re * re + im * im));
                }
                return power;
            };
            double total = 0.0;
            double strongest = -1.0;
            const SplitArray<float>* loudest = nullptr;
            for (const auto& spectrum : spectra)
            {
                const double power = powerOf(spectrum);
                total += power;
                if (power > strongest)
                {
                    strongest = power;
                    loudest = &spectrum;
                }
            }
            const double kept = total > 0.0 ? powerOf(mean) * static_cast<double>(n * n) / total : 1.0; // 1: unrelated
            const auto share = static_cast<float>(std::clamp((0.5 - kept) / 0.25, 0.0, 1.0));
            const auto scale = static_cast<float>(size - 1); // half the transform: takes its scale out of the weights
            for (std::size_t i = 0; share > 0.0f && i < range.weights.size(); ++i)
            {
                const std::size_t b = range.first + i;
                const float weight = share * range.weights[i] * scale;
                mixed.re[b] += weight * (loudest->re[b] - mean.re[b]);
                mixed.im[b] += weight * (loudest->im[b] - mean.im[b]);
            }
        }
        spectra.front() = std::move(mixed);
    }

    static void emitBand(BandAnalysisResult::Track& track, const AnalyticFrame& frame, double base, int rate)
    {
        double turns = std::atan2(frame.rotation.imag(), frame.rotation.real()) / (2.0 * std::numbers::pi);
        if (turns < 0.0)
            turns += 1.0;
        track.amplitude.push_back(static_cast<float>(std::sqrt(frame.power)));
        track.frequency.push_back(frame.power > 0.0 ? static_cast<float>(base + turns * rate) : 0.0f);
    }

    [[nodiscard]] static std::vector<float> makeFade()
    {
        std::vector<float> fade(fadeFrames);
        for (std::size_t i = 0; i < fadeFrames; ++i)
            fade[i] = static_cast<float>(0.5 - 0.5 * std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) /
                                                              static_cast<double>(fadeFrames)));
        return fade;
    }

    const std::vector<float> fadeIn = makeFade();
    BandAnalysisParams settings;
    BandFades fades;
    AnalyticTrack wide;
    std::vector<AnalyticTrack> tracks;
    std::vector<std::unique_ptr<Plan>> plans;

    std::vector<std::vector<float>> pending; // samples of each channel from blockStart on
    std::int64_t blockStart = 0;
    std::uint64_t received = 0;
    BandAnalysisResult output;

    std::vector<float> block;
    std::vector<SplitArray<float>> spectra;
    SplitArray<float> bins, part;
};

} // namespace pacini
