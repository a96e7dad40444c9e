#pragma once

// Feature extraction for the haptic translation similarity.

#include <pacini/evaluate/FeltSpectrum.h>
#include <pacini/evaluate/HtsFeatures.h>
#include <pacini/evaluate/PeakScale.h>
#include <pacini/evaluate/PowerEnvelope.h>
#include <pacini/evaluate/SectionCascade.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Side of a signal in the comparison. The audible envelope and the events are only computed for a source, the low
/// envelopes not for a source as its own candidate.
enum class HtsRole
{
    source,
    candidate,
    sourceItself,
};

/// Computes HtsFeatures; plans new transforms only if the length of the signals changes.
class HtsAnalyzer
{
public:
    /// The features of a mono signal at 4 kHz; samples that are not finite count as 0. The weighting approximates the
    /// acceleration threshold of the skin: flat from 20 to 300 Hz, then -24 dB per octave (Butterworth high-pass of
    /// order 2, Linkwitz-Riley low-pass of order 4, both causal).
    template <typename Sample>
    [[nodiscard]] HtsFeatures analyze(std::span<const Sample> samples, HtsRole role)
    {
        HtsFeatures features;
        features.duration = static_cast<double>(samples.size()) / fs;
        const double scale = 1.0 / peakScale(samples);
        std::vector<float> x(samples.size());
        std::transform(samples.begin(), samples.end(), x.begin(),
                       [scale](Sample v)
                       { return std::isfinite(v) ? static_cast<float>(scale * static_cast<double>(v)) : 0.0f; });

        SectionCascade<1>({designBiquad({BiquadType::highpass, Hertz(20.0)}, fs)}).process(std::span(x));
        if (role == HtsRole::source)
        {
            auto audible = powerEnvelopes.analyze(x);
            features.audible = std::move(audible.envelope);
            features.audibleEvents = std::move(audible.events);
        }
        if (role != HtsRole::sourceItself)
            features.low = lowEnvelopes(x);
        const auto lowpass = designBiquad({BiquadType::lowpass, Hertz(300.0)}, fs);
        SectionCascade<2>({lowpass, lowpass}).process(std::span(x));
        auto felt = powerEnvelopes.analyze(x);
        features.felt = std::move(felt.envelope);
        features.feltEvents = std::move(felt.events);
        features.bands = bandEnvelopes(x);
        features.spectrum = spectra.analyze(x);
        return features;
    }

private:
    static constexpr double fs = HtsFeatures::sampleRate;

    /// Envelopes of causal Butterworth bands: squared, smoothed over 20 ms or a period of the lower edge.
    static std::array<std::vector<float>, HtsFeatures::bandCount> bandEnvelopes(std::span<const float> x)
    {
        constexpr std::array<double, HtsFeatures::bandCount + 1> edges{25.0, 60.0, 125.0, 250.0, 500.0, 1000.0};
        std::array<std::vector<float>, HtsFeatures::bandCount> envelopes;
        std::vector<float> y(x.size());
        for (std::size_t b = 0; b < envelopes.size(); ++b)
        {
            std::copy(x.begin(), x.end(), y.begin());
            const auto design =
                designButterworth({ButterworthType::bandpass, 2, Hertz(edges[b]), Hertz(edges[b + 1])}, fs);
            SectionCascade<2>({design.sections[0].directForm(), design.sections[1].directForm()}).process(std::span(y));
            for (float& v : y)
                v *= v;
            const HannKernel kernel = htsHannKernel(Seconds(std::max(0.020, 1.0 / edges[b])));
            for (std::size_t at = 0; at < y.size(); at += HtsFeatures::envelopeSpacing)
                envelopes[b].push_back(std::sqrt(kernel.at(y, at)));
        }
        return envelopes;
    }

    /// Envelopes of bands with slopes of 24 dB per octave.
    [[nodiscard]] std::array<std::vector<float>, HtsFeatures::lowCount> lowEnvelopes(std::span<const float> x)
    {
        constexpr std::array<double, HtsFeatures::lowCount + 1> edges{30.0, 120.0, 300.0};
        std::array<std::vector<float>, HtsFeatures::lowCount> envelopes;
        std::vector<float> y(x.size());
        for (std::size_t b = 0; b < envelopes.size(); ++b)
        {
            std::copy(x.begin(), x.end(), y.begin());
            const auto low = designButterworth({ButterworthType::highpass, 4, Hertz(edges[b])}, fs);
            const auto high = designButterworth({ButterworthType::lowpass, 4, Hertz(edges[b + 1])}, fs);
            SectionCascade<4>({low.sections[0].directForm(), low.sections[1].directForm(),
                               high.sections[0].directForm(), high.sections[1].directForm()})
                .process(std::span(y));
            envelopes[b] = powerEnvelopes.analyze(y, false).envelope;
        }
        return envelopes;
    }

    PowerEnvelopeAnalyzer powerEnvelopes;
    FeltSpectrumAnalyzer spectra;
};

} // namespace pacini
