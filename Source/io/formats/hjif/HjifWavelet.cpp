#include "io/formats/hjif/HjifWavelet.h"

#include "io/formats/hjif/HjifStream.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pacini
{

namespace
{
// Synthesis filters from their centre outwards; they are symmetric.
constexpr std::array<double, 4> lowPass{.788485616405665, .418092273222212, -.040689417609559, -.064538882628938};
constexpr std::array<double, 5> highPass{-.852698679009404, .377402855612654, .110624404418423, -.023849465019380,
                                         -.037828455506995};

/// The sum of a symmetric filter over those samples of x around `centre` that have the parity of `phase`; the others
/// are 0.
template <std::size_t taps>
double filtered(const std::vector<double>& x, std::size_t centre, std::size_t phase,
                const std::array<double, taps>& filter)
{
    const auto last = static_cast<std::ptrdiff_t>(x.size()) - 1;
    const auto at = static_cast<std::ptrdiff_t>(centre);
    const auto mirrored = [last](std::ptrdiff_t i)
    {
        i = std::abs(i);
        return static_cast<std::size_t>(i > last ? 2 * last - i : i);
    };
    const std::size_t first = centre % 2 == phase ? 0 : 1;
    double sum = first == 0 ? filter[0] * x[centre] : 0.0;
    for (std::size_t k = first == 0 ? 2 : 1; k < taps; k += 2)
    {
        const auto away = static_cast<std::ptrdiff_t>(k);
        sum += filter[k] * (x[mirrored(at - away)] + x[mirrored(at + away)]);
    }
    return sum;
}
} // namespace

std::optional<std::size_t> hjifBlockSize(double ticks, double ticksPerSecond, double sampleRate)
{
    for (std::size_t size = hjifSmallestBlock; size <= hjifLargestBlock; size *= 2)
    {
        const double length = static_cast<double>(size) * ticksPerSecond / sampleRate;
        if (length >= ticks - 1e-9 && length < ticks + 1.0)
            return size;
    }
    return {};
}

void invertHjifWavelet(std::span<double> block)
{
    std::vector<double> spread;
    for (std::size_t length = 8; length <= block.size(); length *= 2)
    {
        // Approximation at even places, detail at odd ones.
        spread.resize(length);
        for (std::size_t i = 0; i < length / 2; ++i)
        {
            spread[2 * i] = block[i];
            spread[2 * i + 1] = block[length / 2 + i];
        }
        for (std::size_t i = 0; i < length; ++i)
            block[i] = filtered(spread, i, 0, lowPass) + filtered(spread, i, 1, highPass);
    }
}

std::optional<std::vector<double>> hjifBlockSamples(std::string_view stream, std::size_t size)
{
    const auto block = decodeHjifStream(stream, size);
    if (!block)
        return {};
    std::vector<double> samples(size);
    if (block->step > 0.0)
    {
        std::transform(block->coefficients.begin(), block->coefficients.end(), samples.begin(),
                       [&](int c) { return c * block->step; });
        invertHjifWavelet(samples);
    }
    return samples;
}

} // namespace pacini
