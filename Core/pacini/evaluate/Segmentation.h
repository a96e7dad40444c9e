#pragma once

// Overlap-save segmentation: cuts a signal of any length into pieces for spectral filters, so that memory and transform
// sizes stay bounded.

#include <pacini/foundation/Fft.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// One piece: the results for the samples coreBegin .. coreEnd - 1 come from the transform of the samples that start at
/// `begin` (negative: silence before the signal).
struct Segment
{
    std::ptrdiff_t begin = 0;
    std::size_t coreBegin = 0;
    std::size_t coreEnd = 0;

    /// Index of the signal's sample `at` in a buffer of the segment that holds every `spacing`-th sample.
    [[nodiscard]] std::size_t localIndex(std::size_t at, std::size_t spacing = 1) const noexcept
    {
        return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) - begin) / spacing;
    }
};

/// Parameters of segmentation; all lengths in samples, all multiples of `quantum`.
struct SegmentationParams
{
    std::size_t quantum = 1;     ///< every piece begins on a multiple of it and the transform size is one
    std::size_t lead = 0;        ///< silence before a signal in one piece; part of `padding`
    std::size_t padding = 0;     ///< least silence around a signal in one piece, so that its ends do not meet
    std::size_t overlap = 0;     ///< of pieces with their neighbours on each side: how far impulse responses matter
    std::size_t longestCore = 1; ///< a longer signal is cut into pieces of this core
};

/// Pieces of one size whose cores cover the signal exactly.
class Segmentation
{
public:
    Segmentation(std::size_t length, const SegmentationParams& params)
    {
        const auto roundedUp = [&](std::size_t n)
        {
            return (n + params.quantum - 1) / params.quantum * params.quantum;
        };
        const bool single = length <= params.longestCore;
        const std::size_t core = single ? std::max(roundedUp(length), params.quantum) : params.longestCore;
        const std::size_t lead = single ? params.lead : params.overlap;
        const std::size_t needed = core + (single ? params.padding : 2 * params.overlap);
        transformSize = params.quantum * nextFastFftSize(needed / params.quantum);
        for (std::size_t at = 0; at == 0 || at < length; at += core)
            pieces.push_back(
                {static_cast<std::ptrdiff_t>(at) - static_cast<std::ptrdiff_t>(lead), at, std::min(at + core, length)});
    }

    /// Samples of every transform: quantum times an even number without prime factors above 5.
    [[nodiscard]] std::size_t size() const noexcept { return transformSize; }

    /// The pieces, in order; at least one, whose core may be empty.
    [[nodiscard]] std::span<const Segment> segments() const noexcept { return pieces; }

private:
    std::size_t transformSize = 0;
    std::vector<Segment> pieces;
};

/// Fills `buffer` with gain times the samples of `x` from segment.begin on; zeros before and after x, and zeros for
/// samples that are not finite.
template <typename Sample, typename Real>
void copySegment(std::span<const Sample> x, const Segment& segment, Real gain, std::span<Real> buffer) noexcept
{
    const auto length = static_cast<std::ptrdiff_t>(x.size());
    const auto size = static_cast<std::ptrdiff_t>(buffer.size());
    const std::ptrdiff_t first = std::clamp<std::ptrdiff_t>(-segment.begin, 0, size);
    const std::ptrdiff_t last = std::clamp<std::ptrdiff_t>(length - segment.begin, first, size);
    std::fill(buffer.begin(), buffer.begin() + first, Real(0));
    for (std::ptrdiff_t i = first; i < last; ++i)
    {
        const Sample value = x[static_cast<std::size_t>(i + segment.begin)];
        buffer[static_cast<std::size_t>(i)] = std::isfinite(value) ? gain * static_cast<Real>(value) : Real(0);
    }
    std::fill(buffer.begin() + last, buffer.end(), Real(0));
}

} // namespace pacini
