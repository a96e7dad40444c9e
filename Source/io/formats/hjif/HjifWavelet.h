#pragma once

// Inverse wavelet transform: WaveletWave bands as samples.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace pacini
{

/// Blocks have this many samples at least and at most, and a power of two of them.
inline constexpr std::size_t hjifSmallestBlock = 16;
inline constexpr std::size_t hjifLargestBlock = std::size_t(1) << 16;

/// Samples per block of a band whose blocks last `ticks` at `sampleRate` Hz: the power of two that lasts as long, or a
/// fraction of a tick longer, which writers leave away. None when there is no such size within the limits.
[[nodiscard]] std::optional<std::size_t> hjifBlockSize(double ticks, double ticksPerSecond, double sampleRate);

/// The inverse wavelet transform of a block in place, all levels down to four approximation coefficients: the 9/7
/// filter pair of A. Cohen, I. Daubechies and J.-C. Feauveau, "Biorthogonal bases of compactly supported wavelets"
/// (1992), table 6.2, with the signal mirrored about its end samples.
void invertHjifWavelet(std::span<double> block);

/// The samples of a block; none when `stream` has characters that are not of its alphabet.
[[nodiscard]] std::optional<std::vector<double>> hjifBlockSamples(std::string_view stream, std::size_t size);

} // namespace pacini
