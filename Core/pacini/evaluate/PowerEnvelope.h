#pragma once

// Envelopes and events of signals at 4 kHz from their analytic power.

#include <pacini/evaluate/AnalyticBand.h>
#include <pacini/evaluate/HannSmoothing.h>
#include <pacini/evaluate/HtsFeatures.h>
#include <pacini/evaluate/RiseDetector.h>
#include <pacini/foundation/SplitRealFft.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// The Hann kernel of `total` length at 4 kHz, rounded to an odd number of taps.
[[nodiscard]] inline HannKernel htsHannKernel(Seconds total)
{
    const auto taps = static_cast<std::size_t>(std::lround(total.frames(HtsFeatures::sampleRate))) | 1u;
    return HannKernel(static_cast<double>(taps / 2 + 1));
}

/// A power envelope and its events.
struct PowerEnvelope
{
    std::vector<float> envelope; ///< linear amplitude, one value per 5 ms, smoothed by 20 ms Hann
    std::vector<double> events;  ///< s, rises of at least 6 dB within 10 ms of the 10 ms Hann envelope; where wanted
};

/// Computes power envelopes. Analytic power has no ripple at twice the frequency, so short kernels suffice. Transforms
/// are planned anew only when the length of the signals changes.
///
/// The score is defined with the analytic signal of a circular transform whose size is the next power of two above the
/// length: the end of a signal reaches its beginning across the zeros between them. Short signals are done just so;
/// pieces of long ones see the same neighbours.
class PowerEnvelopeAnalyzer
{
public:
    [[nodiscard]] PowerEnvelope analyze(std::span<const float> x, bool events = true)
    {
        constexpr std::size_t longest = 65536; // of one transform
        constexpr std::size_t overlap = 2000;
        constexpr std::size_t fade = 1500; // of the overlap
        const std::size_t period = std::bit_ceil(x.size() + 1);
        const std::size_t size = std::clamp<std::size_t>(period, 4, longest);
        const bool whole = period <= longest;
        const std::size_t margin = whole ? 0 : overlap;
        constexpr std::size_t grid = HtsFeatures::envelopeSpacing;
        const std::size_t core = whole ? std::max(x.size(), grid) : (longest - 2 * overlap) / grid * grid;
        if (!plan || plan->forward.size() != size)
            plan.emplace(size);
        PowerEnvelope result;
        std::vector<float> fine;
        for (std::size_t begin = 0; begin < x.size(); begin += core)
        {
            const std::size_t end = std::min(begin + core, x.size());
            for (std::size_t i = 0; i < size; ++i)
            {
                const std::size_t at = (begin + i + period - margin) % period;
                plan->samples[i] = at < x.size() ? x[at] : 0.0f;
            }
            // A cut through the signal would be felt far away: the Hilbert transform fades only as 1 / t.
            for (std::size_t i = 0; !whole && i < fade; ++i)
            {
                const double angle = std::numbers::pi * static_cast<double>(i) / fade;
                const auto gain = static_cast<float>(0.5 - 0.5 * std::cos(angle));
                plan->samples[i] *= gain;
                plan->samples[size - 1 - i] *= gain;
            }
            plan->transform();
            // Power in the core and around it as far as smoothing reaches; silence outside the signal.
            const std::size_t powerBegin = begin > guard ? begin - guard : 0;
            const std::size_t powerEnd = std::min(end + guard, x.size());
            plan->samples.assign(size, 0.0f);
            for (std::size_t at = powerBegin; at < powerEnd; ++at)
            {
                const float re = plan->analytic.re[at + margin - begin];
                const float im = plan->analytic.im[at + margin - begin];
                plan->samples[at + margin - begin] = 0.5f * (re * re + im * im);
            }
            for (std::size_t at = begin; at < end; at += HtsFeatures::envelopeSpacing)
                result.envelope.push_back(std::sqrt(slow.at(plan->samples, at + margin - begin)));
            for (std::size_t at = begin; events && at < end; at += 4)
                fine.push_back(std::sqrt(fast.at(plan->samples, at + margin - begin)));
        }
        const RiseDetectorParams rises{
            .floor = Decibels(-30.0), .rise = Decibels(6.0), .spanFrames = 10, .gapFrames = 10};
        for (const std::size_t frame : detectRises({fine}, rises))
            result.events.push_back(static_cast<double>(frame) / 1000.0);
        return result;
    }

private:
    static constexpr std::size_t guard = 50; // samples that the longer kernel needs on each side

    struct Plan
    {
        explicit Plan(std::size_t size)
            : forward(size),
              wholeBand(size, size, 0, std::vector<float>(size / 2 + 1, 1.0f)),
              samples(size),
              spectrum(size / 2 + 1),
              scratch(size),
              analytic(size)
        {
        }
        void transform()
        {
            forward.forward(samples.data(), spectrum.re.data(), spectrum.im.data());
            wholeBand.sample(spectrum, transforms, scratch, analytic);
        }

        SplitRealFft<float> forward;
        InverseTransforms transforms;
        AnalyticBand wholeBand;
        std::vector<float> samples;
        SplitArray<float> spectrum;
        SplitArray<float> scratch;
        SplitArray<float> analytic;
    };

    HannKernel slow = htsHannKernel(Seconds(0.020));
    HannKernel fast = htsHannKernel(Seconds(0.010));
    std::optional<Plan> plan;
};

} // namespace pacini
