#pragma once

// Bit stream decoder (SPIHT) for one block of a WaveletWave band.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace pacini
{

/// Wavelet coefficients of a block, in the order approximation, coarsest to finest detail.
struct HjifBlock
{
    std::vector<int> coefficients;
    double step = 0.0; ///< amplitude of a coefficient of 1
};

/// Decodes `text`, six bits per character of the Base64 alphabet, as a block of `size` (a power of two, 16 or more)
/// samples: set partitioning in hierarchical trees after A. Said and W. Pearlman, "A new, fast, and efficient image
/// codec based on set partitioning in hierarchical trees" (1996), on one dimension, behind the adaptive arithmetic
/// coder of I. Witten, R. Neal and J. Cleary, "Arithmetic coding for data compression" (1987). Bits that are missing at
/// the end are 0, so every text of that alphabet is a block. None for other characters but `=` at the end.
[[nodiscard]] std::optional<HjifBlock> decodeHjifStream(std::string_view text, std::size_t size);

} // namespace pacini
