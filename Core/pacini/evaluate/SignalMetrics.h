#pragma once

// Neutral signal measures ("the judge") of the similarity of a haptic signal and a sound.

#include <pacini/evaluate/EventMatching.h>
#include <pacini/evaluate/SignalAnalyzer.h>
#include <pacini/filters/Resampler.h>
#include <pacini/foundation/DotProduct.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// All levels in dB. With a silent reference only the first three fields mean anything.
struct SignalMetrics
{
    bool silentReference = false;    ///< in-band RMS of the reference at most 1e-9
    double candidateRms = 0.0;       ///< in band
    std::size_t nonFinite = 0;       ///< samples of the candidate at 8 kHz that were NaN or infinite
    double envelopeSnr = 0.0;        ///< of 12 band envelopes with one gain, 0..60
    double envelopeSnrPerBand = 0.0; ///< mean over the bands that matter, each -10..60
    double wideSnr = 0.0;            ///< of the single 30-1000 Hz envelope, at most 60
    double logSpectralDistance = 0.0;
    double centroidError = 0.0; ///< %, median of the magnitude
    double centroidBias = 0.0;  ///< %, median
    std::optional<int> lag;     ///< ms, candidate late is positive; empty below 0.2 s or for a constant envelope
    std::optional<double>
        outOfBand;              ///< candidate's energy outside 30-1000 Hz over the energy inside; empty for silence
    std::optional<double> gain; ///< that makes the candidate as strong as the reference; empty for silence
    bool operator==(const SignalMetrics&) const = default;
};

namespace detail
{
/// The inner products that a least-squares gain and the error it leaves are made of.
struct EnvelopeSums
{
    double reference = 0.0; // sum R^2
    double candidate = 0.0; // sum C^2
    double cross = 0.0;     // sum R C

    static EnvelopeSums of(std::span<const float> r, std::span<const float> c, double weight) noexcept
    {
        return {weight * dotProductIn<double>(r.data(), r.data(), r.size()),
                weight * dotProductIn<double>(c.data(), c.data(), c.size()),
                weight * dotProductIn<double>(r.data(), c.data(), r.size())};
    }
    void operator+=(const EnvelopeSums& other) noexcept
    {
        reference += other.reference;
        candidate += other.candidate;
        cross += other.cross;
    }
    [[nodiscard]] double bestGain() const noexcept { return candidate > 0.0 ? cross / candidate : 0.0; }

    /// 10 log10(sum R^2 / sum (R - gain C)^2).
    [[nodiscard]] double snr(double gain) const noexcept
    {
        const double error = reference - 2.0 * gain * cross + gain * gain * candidate;
        return Decibels::fromPower(std::max(reference, 1e-300) / std::max(error, 1e-300)).value;
    }
};

/// Sums over one band in units of the 1 kHz grid that the measure is defined on, from coarser or finer samples. By the
/// Euler-Maclaurin formula (F. Hildebrand, "Introduction to Numerical Analysis", 1956, section 5.8) two sums with
/// different spacings of one smooth curve differ only by values and slopes at its ends. Envelopes begin and end steeply
/// where a file is cut off, and short files consist of ends. The slopes are simple differences: with better ones some
/// weights would be negative, and with them the energy of an error could be.
[[nodiscard]] inline EnvelopeSums sumBand(const BandEnvelope& reference, const BandEnvelope& candidate,
                                          std::size_t gridFrames) noexcept
{
    const std::span<const float> r(reference.values);
    const std::span<const float> c(candidate.values);
    const double s = static_cast<double>(reference.spacing) / static_cast<double>(SignalFeatures::envelopeSpacing);
    EnvelopeSums sums = EnvelopeSums::of(r, c, s);
    if (r.size() < 2 || reference.spacing == SignalFeatures::envelopeSpacing)
        return sums;

    // The grid ends this many of its frames after the last value.
    const double rest = static_cast<double>(gridFrames - 1) - static_cast<double>(r.size() - 1) * s;
    const double slope = (1.0 - s * s) / 12.0; // weight of the slope per grid frame
    const double slopeAtEnd = slope + rest * (1.0 + rest) / 2.0;
    sums += EnvelopeSums::of(r.first(1), c.first(1), 0.5 - s / 2.0 + slope / s);
    sums += EnvelopeSums::of(r.subspan(1, 1), c.subspan(1, 1), -slope / s);
    sums += EnvelopeSums::of(r.last(1), c.last(1), 0.5 - s / 2.0 + rest + slopeAtEnd / s);
    sums += EnvelopeSums::of(r.last(2).first(1), c.last(2).first(1), -slopeAtEnd / s);
    return sums;
}

inline constexpr double snrCeiling = 60.0; // dB: what identical signals get

inline void compareBands(const SignalFeatures& reference, const SignalFeatures& candidate, SignalMetrics& measures)
{
    std::array<EnvelopeSums, SignalFeatures::bandCount> sums;
    EnvelopeSums total;
    double strongest = 0.0;
    for (std::size_t k = 0; k < sums.size(); ++k)
    {
        sums[k] = sumBand(reference.bands[k], candidate.bands[k], reference.wide.size());
        total += sums[k];
        strongest = std::max(strongest, sums[k].reference);
    }
    const double gain = total.bestGain();
    measures.envelopeSnr = std::min(total.snr(gain), snrCeiling);
    double sum = 0.0;
    std::size_t count = 0;
    for (const EnvelopeSums& band : sums)
        if (band.reference > strongest * 1e-4)
        {
            sum += std::clamp(band.snr(gain), -10.0, snrCeiling);
            ++count;
        }
    measures.envelopeSnrPerBand = sum / static_cast<double>(count);
}

/// Root mean square level difference of the third-octave cells that are within 40 dB of the reference's strongest, on
/// average over the frames that have such cells. `powerGain` levels the candidate.
[[nodiscard]] inline double logSpectralDistance(const SignalFeatures& reference, const SignalFeatures& candidate,
                                                double powerGain)
{
    float strongest = 0.0f;
    for (const auto& band : reference.thirdOctaves)
        strongest = std::max(strongest, *std::max_element(band.begin(), band.end()));
    const double floor = static_cast<double>(strongest) * 1e-4;
    double sum = 0.0;
    std::size_t frames = 0;
    for (std::size_t t = 0; t < reference.thirdOctaves.front().size(); ++t)
    {
        double squares = 0.0;
        std::size_t cells = 0;
        for (std::size_t k = 0; k < reference.thirdOctaves.size(); ++k)
        {
            const auto r = static_cast<double>(reference.thirdOctaves[k][t]);
            const double c = powerGain * static_cast<double>(candidate.thirdOctaves[k][t]);
            if (!(r > floor || c > floor))
                continue;
            const double difference = Decibels::fromPower(std::max(r, floor) / std::max(c, floor)).value;
            squares += difference * difference;
            ++cells;
        }
        if (cells == 0)
            continue;
        sum += std::sqrt(squares / static_cast<double>(cells));
        ++frames;
    }
    return frames == 0 ? 0.0 : sum / static_cast<double>(frames);
}

inline void compareCentroids(const SignalFeatures& reference, const SignalFeatures& candidate, double powerGain,
                             SignalMetrics& measures)
{
    const auto strongest =
        static_cast<double>(*std::max_element(reference.framePower.begin(), reference.framePower.end()));
    std::vector<double> errors;
    for (std::size_t t = 0; t < reference.framePower.size(); ++t)
        if (static_cast<double>(reference.framePower[t]) > strongest * 1e-4)
        {
            const bool audible = static_cast<double>(candidate.framePower[t]) * powerGain > strongest * 1e-6;
            errors.push_back(audible ? static_cast<double>(candidate.centroid[t] / reference.centroid[t] - 1.0f) * 100.0
                                     : -100.0);
        }
    measures.centroidBias = median(errors).value_or(0.0);
    for (double& error : errors)
        error = std::abs(error);
    measures.centroidError = median(std::move(errors)).value_or(0.0);
}

/// The shift within +-100 ms at which the mean-free wide envelopes correlate best; positive when the candidate is late.
[[nodiscard]] inline std::optional<int> envelopeLag(std::span<const float> reference, std::span<const float> candidate)
{
    constexpr std::size_t reach = 100;
    const std::size_t size = reference.size();
    if (size <= 2 * reach)
        return std::nullopt;
    // With `reach` zeros on both sides of the candidate every lag correlates the whole reference.
    const auto meanFree = [](std::span<const float> x, std::size_t margin)
    {
        const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
        std::vector<float> y(x.size() + 2 * margin);
        std::transform(x.begin(), x.end(), y.begin() + static_cast<std::ptrdiff_t>(margin),
                       [mean](float v) { return static_cast<float>(static_cast<double>(v) - mean); });
        return y;
    };
    const auto a = meanFree(reference, 0);
    const auto b = meanFree(candidate, reach);
    if (std::all_of(b.begin(), b.end(), [](float v) { return v == 0.0f; }))
        return std::nullopt;
    std::array<double, 2 * reach + 1> correlation{};
    constexpr std::size_t blockFrames = 2048; // short enough for the cache and for sums in single precision
    for (std::size_t begin = 0; begin < size; begin += blockFrames)
        for (std::size_t lag = 0; lag < correlation.size(); ++lag)
            correlation[lag] += static_cast<double>(
                dotProduct(a.data() + begin, b.data() + begin + lag, std::min(blockFrames, size - begin)));
    const auto best = std::max_element(correlation.begin(), correlation.end()) - correlation.begin();
    return static_cast<int>(best) - static_cast<int>(reach);
}
} // namespace detail

/// Compares a candidate with a reference of equal length (asserted): both from one SignalAnalyzer or from analyzers of
/// one length. No alignment in time. The signal-to-noise ratios use least-squares gains, everything else equal in-band
/// RMS, so the measures do not depend on the gain or the polarity of either signal.
[[nodiscard]] inline SignalMetrics compare(const SignalFeatures& reference, const SignalFeatures& candidate)
{
    assert(reference.length == candidate.length);
    SignalMetrics measures;
    measures.candidateRms = candidate.rms * candidate.scale;
    measures.nonFinite = candidate.nonFinite;
    measures.silentReference = reference.rms * reference.scale <= 1e-9;
    if (measures.silentReference)
        return measures;

    detail::compareBands(reference, candidate, measures);
    const auto wide = detail::EnvelopeSums::of(reference.wide, candidate.wide, 1.0);
    measures.wideSnr = std::min(wide.snr(wide.bestGain()), detail::snrCeiling);

    const double gain = measures.candidateRms > 1e-12 ? reference.rms / candidate.rms : 0.0; // of the scaled features
    measures.logSpectralDistance = detail::logSpectralDistance(reference, candidate, gain * gain);
    detail::compareCentroids(reference, candidate, gain * gain, measures);
    measures.lag = detail::envelopeLag(reference.wide, candidate.wide);
    measures.outOfBand = candidate.outOfBand;
    if (gain > 0.0)
        measures.gain = Decibels::fromGain(gain * reference.scale / candidate.scale).value;
    return measures;
}

/// Returns the length at 8 kHz of a signal of `samples` samples at `sampleRate` Hz, which a SignalAnalyzer for this
/// reference requires.
[[nodiscard]] inline std::size_t signalAnalysisLength(std::size_t samples, int sampleRate) noexcept
{
    return resampledFrames(samples, sampleRate, SignalFeatures::sampleRate);
}

/// The features of a mono signal at `sampleRate` Hz, cut or padded to the analyzer's length.
/// ErrorCode::invalidArgument for rates outside 2000 to 768000 Hz.
template <typename Sample>
[[nodiscard]] Result<SignalFeatures> signalFeatures(SignalAnalyzer& analyzer, std::span<const Sample> samples,
                                                    int sampleRate)
{
    if (sampleRate == SignalFeatures::sampleRate)
        return analyzer.analyze(samples);
    const auto x = resample(samples, sampleRate, SignalFeatures::sampleRate);
    if (!x)
        return x.error();
    return analyzer.analyze(std::span<const Sample>(*x));
}

} // namespace pacini
