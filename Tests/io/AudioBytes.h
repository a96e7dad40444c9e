#pragma once

// Audio files byte by byte, as their specifications have them, and as no sane program would write them.

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace pacini::test
{

inline std::string littleEndian(std::uint64_t value, int bytes)
{
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += static_cast<char>(value >> (8 * i) & 0xFF);
    return text;
}

inline std::string bigEndian(std::uint64_t value, int bytes)
{
    const auto reversed = littleEndian(value, bytes);
    return {reversed.rbegin(), reversed.rend()};
}

struct WavHeader
{
    std::uint16_t channels = 1;
    std::uint32_t sampleRate = 8000;
    std::uint16_t bits = 16;
    std::uint16_t tag = 1;                                 ///< 1 PCM, 3 float
    std::optional<std::uint32_t> dataBytes = std::nullopt; ///< what the header claims; empty: the truth
};

inline std::string wavBytes(const WavHeader& header, const std::string& data)
{
    const auto claimed = header.dataBytes.value_or(static_cast<std::uint32_t>(data.size()));
    const auto frameBytes = static_cast<std::uint32_t>(header.channels * header.bits / 8);
    return "RIFF" + littleEndian(36u + claimed, 4) + "WAVEfmt " + littleEndian(16, 4) + littleEndian(header.tag, 2) +
           littleEndian(header.channels, 2) + littleEndian(header.sampleRate, 4) +
           littleEndian(header.sampleRate * frameBytes, 4) + littleEndian(frameBytes, 2) +
           littleEndian(header.bits, 2) + "data" + littleEndian(claimed, 4) + data;
}

/// Sun AU: 32-bit counts of everything.
inline std::string auBytes(std::uint32_t channels, std::uint32_t claimedBytes, const std::string& data)
{
    constexpr std::uint32_t pcm8 = 2;
    return ".snd" + bigEndian(24, 4) + bigEndian(claimedBytes, 4) + bigEndian(pcm8, 4) + bigEndian(8000, 4) +
           bigEndian(channels, 4) + data;
}

inline std::string pcm16(const std::vector<int>& samples)
{
    std::string data;
    for (int sample : samples)
        data += littleEndian(static_cast<std::uint64_t>(sample), 2);
    return data;
}

inline std::string float32(const std::vector<float>& samples)
{
    std::string data(samples.size() * 4, '\0');
    if (!samples.empty())
        std::memcpy(data.data(), samples.data(), data.size());
    return data;
}

} // namespace pacini::test
