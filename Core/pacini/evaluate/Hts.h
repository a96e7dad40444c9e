#pragma once

// Haptic translation similarity (HTS): one score for how well a haptic signal reproduces a sound as heard and
// felt.

#include <pacini/evaluate/EventMatching.h>
#include <pacini/evaluate/HtsAnalyzer.h>
#include <pacini/evaluate/HtsFeatures.h>
#include <pacini/evaluate/SourcePreparation.h>
#include <pacini/foundation/DotProduct.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// The score and the similarities (0..1) that it is made of.
struct HtsScore
{
    double score = 0.0; ///< 0..100
    double wide = 0.0;
    double band = 0.0;
    double spectrum = 0.0;
    double event = 0.0;
    bool operator==(const HtsScore&) const = default;
};

/// HTS compares the audible envelope and events of the source with the felt candidate, which rewards translation of
/// sound above the range of touch; HTS-F compares only the parts that are felt in both.
enum class HtsMode
{
    translation,
    fidelity,
};

namespace detail
{
inline constexpr double sensationRange = 35.0; // dB between threshold and the strongest

/// Sensation level in dB, 0 and above: the strongest value of the reference lies at sensationRange.
[[nodiscard]] inline double sensationLevel(double value, double strongest) noexcept
{
    if (std::max(value, 1e-12) < 0.01 * strongest)
        return 0.0; // -40 dB: below threshold without a logarithm
    return std::max(0.0, sensationRange + Decibels::fromGain(std::max(value, 1e-12) / strongest).value);
}

/// 1 - weighted mean of level differences, with a dead zone of the just noticeable 1.5 dB and saturation at 12 dB; the
/// larger level is the weight.
class LevelSimilarity
{
public:
    void add(double referenceLevel, double candidateLevel) noexcept
    {
        const double weight = std::max(referenceLevel, candidateLevel);
        const double difference = std::clamp((std::abs(referenceLevel - candidateLevel) - 1.5) / 10.5, 0.0, 1.0);
        total += weight;
        lost += weight * difference;
    }
    [[nodiscard]] double value() const noexcept { return total > 0.0 ? 1.0 - lost / total : 1.0; }

private:
    double total = 0.0;
    double lost = 0.0;
};

/// Adds the first `frames` values of two envelopes; the candidate is scaled by `gain` and read `lag` frames later, as
/// silence outside these frames.
inline void addEnvelopes(LevelSimilarity& similarity, std::span<const float> reference,
                         std::span<const float> candidate, std::size_t frames, std::ptrdiff_t lag, double gain,
                         double strongest) noexcept
{
    for (std::size_t t = 0; t < frames; ++t)
    {
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(t) + lag;
        const bool inside = at >= 0 && at < static_cast<std::ptrdiff_t>(frames);
        const double value = inside ? gain * static_cast<double>(candidate[static_cast<std::size_t>(at)]) : 0.0;
        similarity.add(sensationLevel(static_cast<double>(reference[t]), strongest), sensationLevel(value, strongest));
    }
}

/// Lag of the candidate in frames of 5 ms within +-20 ms at which the envelopes correlate best; the smallest of equals.
[[nodiscard]] inline std::ptrdiff_t htsLag(std::span<const float> reference, std::span<const float> candidate) noexcept
{
    constexpr std::ptrdiff_t reach = 4;
    const auto size = static_cast<std::ptrdiff_t>(reference.size());
    std::ptrdiff_t best = 0;
    double highest = -1.0;
    for (std::ptrdiff_t lag = -reach; lag <= reach; ++lag)
    {
        const std::ptrdiff_t overlap = std::max<std::ptrdiff_t>(0, size - std::abs(lag));
        const std::ptrdiff_t begin = std::min(std::max<std::ptrdiff_t>(0, -lag), size);
        const std::ptrdiff_t shifted = std::min(std::max<std::ptrdiff_t>(0, lag), size);
        const double correlation = dotProductIn<double>(reference.data() + begin, candidate.data() + shifted,
                                                        static_cast<std::size_t>(overlap));
        if (correlation > highest * (1.0 + 1e-9))
        {
            highest = correlation;
            best = lag;
        }
    }
    return best;
}

/// F-measure of the events within 8 ms, 0 at what a Poisson train of the candidate's rate would reach by chance.
[[nodiscard]] inline double eventSkill(std::span<const double> reference, std::span<const double> candidate,
                                       double duration)
{
    if (reference.empty() && candidate.empty())
        return 1.0;
    constexpr double tolerance = 0.008;
    const auto n = static_cast<double>(reference.size());
    const auto m = static_cast<double>(candidate.size());
    const double f = 2.0 * static_cast<double>(matchEvents(reference, candidate, tolerance).size()) / (n + m);
    const double hitsByChance = std::min(n * (1.0 - std::exp(-2.0 * tolerance * m / std::max(duration, 1e-9))), m);
    const double chance = 2.0 * hitsByChance / (n + m);
    return std::max(0.0, (f - chance) / std::max(1.0 - chance, 1e-9));
}

[[nodiscard]] inline double highest(std::span<const float> x) noexcept
{
    return x.empty() ? 0.0 : static_cast<double>(*std::max_element(x.begin(), x.end()));
}

[[nodiscard]] inline double energy(std::span<const float> x) noexcept
{
    return dotProductIn<double>(x.data(), x.data(), x.size());
}
} // namespace detail

/// The similarity of a candidate to a source. Only the part that both have counts; a silent source gives 100 for a
/// silent candidate and 0 for any other. Not dependent on the candidate's gain; a candidate that is up to 20 ms late or
/// early is aligned first.
[[nodiscard]] inline HtsScore compare(const HtsFeatures& source, const HtsFeatures& candidate, HtsMode mode)
{
    const bool translation = mode == HtsMode::translation;
    const std::vector<float>& envelope = translation ? source.audible : source.felt;
    const double strongest = detail::highest(envelope);
    if (!(strongest > 0.0))
    {
        const double similarity = detail::highest(candidate.felt) > 0.0 ? 0.0 : 1.0;
        return {100.0 * similarity, similarity, similarity, similarity, similarity};
    }
    const std::size_t frames = std::min(envelope.size(), candidate.felt.size());
    const auto a = std::span(envelope).first(frames);
    const auto b = std::span(candidate.felt).first(frames);
    const std::ptrdiff_t lag = detail::htsLag(a, b);
    const double candidateEnergy = std::max(detail::energy(b), 1e-30);
    const double gain = std::sqrt(detail::energy(a) / candidateEnergy);
    const double feltGain = std::sqrt(detail::energy(std::span(source.felt).first(frames)) / candidateEnergy);
    const double strongestFelt = std::max(detail::highest(source.felt), 1e-12);

    detail::LevelSimilarity wide;
    detail::addEnvelopes(wide, a, b, frames, lag, gain, strongest);
    detail::LevelSimilarity band;
    for (std::size_t k = 0; k < HtsFeatures::bandCount; ++k)
        detail::addEnvelopes(band, source.bands[k], candidate.bands[k], frames, lag, feltGain, strongestFelt);

    detail::LevelSimilarity spectrum;
    double strongestCell = 1e-12;
    for (const auto& frame : source.spectrum)
        strongestCell = std::max(strongestCell, detail::highest(frame));
    for (std::size_t m = 0; m < std::min(source.spectrum.size(), candidate.spectrum.size()); ++m)
        for (std::size_t k = 0; k < HtsFeatures::spectrumCount; ++k)
            spectrum.add(
                detail::sensationLevel(static_cast<double>(source.spectrum[m][k]), strongestCell),
                detail::sensationLevel(feltGain * static_cast<double>(candidate.spectrum[m][k]), strongestCell));

    std::vector<double> events = candidate.feltEvents;
    for (double& t : events)
        t -= static_cast<double>(lag) * 0.005;
    const double skill =
        detail::eventSkill(translation ? source.audibleEvents : source.feltEvents, events, source.duration);

    // Share of the source that is in the range of touch at all.
    const double tactile =
        translation
            ? std::clamp(1.0 + Decibels::fromGain(strongestFelt / strongest).value / detail::sensationRange, 0.0, 1.0)
            : 1.0;
    const double weighted =
        0.35 * wide.value() + 0.25 * skill + tactile * (0.20 * band.value() + 0.20 * spectrum.value());
    return {100.0 * weighted / (0.60 + 0.40 * tactile), wide.value(), band.value(), spectrum.value(), skill};
}

/// The features of a mono source at `sampleRate` Hz: band-limited and normalised by prepareSource(), then at 4 kHz.
/// ErrorCode::invalidArgument for rates outside 2000 to 768000 Hz.
template <typename Sample>
[[nodiscard]] Result<HtsFeatures> htsSourceFeatures(HtsAnalyzer& analyzer, std::span<const Sample> samples,
                                                    int sampleRate)
{
    const auto x = prepareSource(samples, sampleRate, HtsFeatures::sampleRate);
    if (!x)
        return x.error();
    return analyzer.analyze(std::span<const Sample>(*x), HtsRole::source);
}

/// The features of a mono candidate (drive signal or acceleration) at `sampleRate` Hz, only resampled to 4 kHz.
/// Samples that are not finite count as 0. Errors as htsSourceFeatures().
template <typename Sample>
[[nodiscard]] Result<HtsFeatures> htsCandidateFeatures(HtsAnalyzer& analyzer, std::span<const Sample> samples,
                                                       int sampleRate)
{
    const auto x = resampleFinite(samples, sampleRate, HtsFeatures::sampleRate);
    if (!x)
        return x.error();
    return analyzer.analyze(std::span<const Sample>(*x), HtsRole::candidate);
}

} // namespace pacini
