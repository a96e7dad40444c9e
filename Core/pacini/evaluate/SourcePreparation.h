#pragma once

// Preprocessing of signals before they are compared.

#include <pacini/evaluate/SectionCascade.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/filters/Resampler.h>
#include <pacini/foundation/Result.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pacini
{

/// `samples` limited to 5-1800 Hz at their own rate (causal Butterworth high-pass of order 2 and low-pass of order 4;
/// no low-pass below 3674 Hz, where there is nothing to remove), resampled to `outputRate`, and scaled so that the peak
/// before resampling was 1. Silence stays silence. Samples that are not finite count as 0. The band is that of M.
/// Weber, "A Framework for Audio-Tactile Signal Translation", 2020, section 4.3. Works in blocks: the limited signal is
/// never held as a whole. ErrorCode::invalidArgument for rates outside 2000 to 768000 Hz.
template <typename Sample>
[[nodiscard]] Result<std::vector<Sample>> prepareSource(std::span<const Sample> samples, int sampleRate, int outputRate)
{
    for (const int rate : {sampleRate, outputRate})
        if (auto valid = checkResamplerRate(rate); !valid)
            return valid.error();

    const double fs = sampleRate;
    const auto highpass = designBiquad({BiquadType::highpass, Hertz(5.0)}, fs);
    std::array<BiquadCoefficients, 3> sections{highpass}; // the others pass everything
    if (1800.0 < 0.49 * fs)
    {
        const auto lowpass = designButterworth({ButterworthType::lowpass, 4, Hertz(1800.0)}, fs);
        std::transform(lowpass.sections.begin(), lowpass.sections.end(), sections.begin() + 1,
                       [](const StateVariableCoefficients& section) { return section.directForm(); });
    }
    SectionCascade<3> filter(sections);

    const Resampler<Sample> resampler(sampleRate, outputRate);
    std::vector<Sample> out(resampler.outputFrames(samples.size()));
    constexpr std::size_t blockFrames = 16384;
    std::vector<Sample> window; // filtered input from windowBegin on, as far back as the next output needs it
    std::int64_t windowBegin = 0;
    double peak = 0.0;
    std::size_t written = 0;
    for (std::size_t read = 0; read < samples.size(); read += blockFrames)
    {
        const auto block = samples.subspan(read, std::min(blockFrames, samples.size() - read));
        const std::size_t kept = window.size();
        window.resize(kept + block.size());
        const auto filtered = std::span(window).subspan(kept);
        std::transform(block.begin(), block.end(), filtered.begin(),
                       [](Sample v) { return std::isfinite(v) ? v : Sample(0); });
        filter.process(filtered);
        for (const Sample v : filtered)
            peak = std::max(peak, std::abs(static_cast<double>(v)));

        const auto available = static_cast<std::int64_t>(read + block.size());
        const bool last = read + block.size() == samples.size();
        std::size_t ready = written;
        while (ready < out.size() && (last || resampler.lastInput(ready) < available))
            ++ready;
        resampler.process(window, windowBegin, written, std::span(out).subspan(written, ready - written));
        written = ready;
        if (written < out.size())
        {
            const auto keepFrom = std::clamp<std::int64_t>(resampler.firstInput(written), windowBegin, available);
            window.erase(window.begin(), window.begin() + static_cast<std::ptrdiff_t>(keepFrom - windowBegin));
            windowBegin = keepFrom;
        }
    }
    if (peak > 0.0)
        for (Sample& v : out)
            v = static_cast<Sample>(static_cast<double>(v) / peak);
    return out;
}

/// `samples` resampled to `outputRate`, with 0 for those that are not finite. ErrorCode::invalidArgument for rates
/// outside 2000 to 768000 Hz.
template <typename Sample>
[[nodiscard]] Result<std::vector<Sample>> resampleFinite(std::span<const Sample> samples, int sampleRate,
                                                         int outputRate)
{
    std::vector<Sample> finite; // a copy only when something has to be changed
    if (!std::all_of(samples.begin(), samples.end(), [](Sample v) { return std::isfinite(v); }))
    {
        finite.assign(samples.begin(), samples.end());
        std::replace_if(
            finite.begin(), finite.end(), [](Sample v) { return !std::isfinite(v); }, Sample(0));
        samples = finite;
    }
    return resample(samples, sampleRate, outputRate);
}

} // namespace pacini
