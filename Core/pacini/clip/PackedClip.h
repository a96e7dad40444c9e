#pragma once

// The packed form of a clip (.pacb): quantised, predicted and entropy-coded.

#include <pacini/clip/ClipCoder.h>
#include <pacini/clip/ClipGrids.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

namespace detail
{

/// CRC-16 (CCITT, polynomial 0x1021): catches a damaged or truncated file before its contents are believed.
inline std::uint16_t crc16(std::span<const std::byte> data)
{
    std::uint16_t crc = 0xFFFF;
    for (std::byte b : data)
    {
        crc = static_cast<std::uint16_t>(crc ^ (static_cast<std::uint16_t>(b) << 8));
        for (int i = 0; i < 8; ++i)
            crc = static_cast<std::uint16_t>((crc & 0x8000u) != 0 ? (crc << 1) ^ 0x1021 : crc << 1);
    }
    return crc;
}

inline constexpr std::array<char, 4> packedMagic = {'P', 'A', 'C', 'B'};
/// Version 2 is written where a band has a phase only, so that programs that know version 1 read all other clips, and
/// refuse what they would play otherwise than it is.
inline constexpr std::uint8_t packedVersion = 2;
inline constexpr std::size_t packedHeaderBytes = 7; // magic, version, checksum of what follows

/// A payload behind its magic, version and checksum.
inline std::vector<std::byte> withHeader(std::span<const std::byte> payload, std::uint8_t version = 1)
{
    std::vector<std::byte> bytes;
    bytes.reserve(packedHeaderBytes + payload.size());
    for (char c : packedMagic)
        bytes.push_back(static_cast<std::byte>(c));
    bytes.push_back(static_cast<std::byte>(version));
    const std::uint16_t crc = crc16(payload);
    bytes.push_back(static_cast<std::byte>(crc >> 8));
    bytes.push_back(static_cast<std::byte>(crc & 0xFF));
    bytes.insert(bytes.end(), payload.begin(), payload.end());
    return bytes;
}

template <typename Coder>
void codePackParams(Coder& coder, PackParams& params)
{
    AdaptiveBit millisecond(0.95, 4);
    std::uint32_t bits = 0;
    for (int i = 3; i >= 0; --i)
        bits = (bits << 1) | static_cast<std::uint32_t>(coder.bit((((params.bits - 4) >> i) & 1) != 0));
    params.bits = static_cast<int>(bits) + 4;
    AdaptiveNumber ticks(1000.0);
    if (coder.bit(params.ticksPerSecond == 1000, millisecond))
        params.ticksPerSecond = 1000;
    else
        params.ticksPerSecond =
            static_cast<std::uint32_t>(std::clamp<std::uint64_t>(ticks.code(coder, params.ticksPerSecond), 1, 1000000));
}

} // namespace detail

/// The grids to pack a clip on: the encoder's `quantise` bits where the clip says them, else `otherwise`.
[[nodiscard]] inline PackParams packParamsFor(const Clip& clip, const PackParams& otherwise = {})
{
    PackParams params = otherwise;
    for (const EncoderParameter& parameter : clip.encoder)
        if (parameter.name == "quantise")
            if (const auto* bits = std::get_if<double>(&parameter.value))
                params.bits = static_cast<int>(std::clamp(*bits, 4.0, 16.0));
    return params;
}

/// Sets the bits that packParamsFor() finds.
inline void setQuantise(Clip& clip, int bits)
{
    for (EncoderParameter& parameter : clip.encoder)
        if (parameter.name == "quantise")
        {
            parameter.value = static_cast<double>(bits);
            return;
        }
    clip.encoder.push_back({"quantise", static_cast<double>(bits)});
}

/// The packed form of a valid clip: "PACB", a version, a checksum, and a range-coded rest. Amplitudes, frequencies and
/// times are rounded to the grids of `params` (bits outside 4-16 are clamped); what is on the grids already is kept
/// exactly.
[[nodiscard]] inline std::vector<std::byte> packClip(Clip clip, PackParams params = {})
{
    params.bits = std::clamp(params.bits, 4, 16);
    params.ticksPerSecond = std::clamp<std::uint32_t>(params.ticksPerSecond, 1, 1000000);
    RangeWriter writer;
    detail::codePackParams(writer, params);
    detail::ClipCoder<RangeWriter> coder(writer, params);
    coder.code(clip);
    const bool phases = std::any_of(clip.bands.begin(), clip.bands.end(),
                                    [](const Band& band) { return detail::ClipGrids::phaseCode(band.phase) != 0; });
    if (phases)
        coder.codePhases(clip);
    std::vector<std::byte> payload = writer.finish();
    payload.resize(std::max(payload.size(), coder.leastBytes())); // the reader takes what is missing as zeros anyway
    return detail::withHeader(payload, phases ? 2 : 1);
}

/// Reads a packed clip. Errors: invalidData (not a packed clip, or damaged), truncated, unsupportedVersion, tooLarge.
/// The result is a valid clip.
[[nodiscard]] inline Result<Clip> unpackClip(std::span<const std::byte> bytes)
{
    using namespace detail;
    for (std::size_t i = 0; i < packedMagic.size(); ++i)
        if (i >= bytes.size() || static_cast<char>(bytes[i]) != packedMagic[i])
            return Error{ErrorCode::invalidData, "header", "is not a packed Pacini clip"};
    if (bytes.size() < packedHeaderBytes)
        return Error{ErrorCode::truncated, "header", "ends too early"};
    const auto version = static_cast<int>(bytes[4]);
    if (version > packedVersion)
        return Error{ErrorCode::unsupportedVersion, "header",
                     "was written by a newer version (" + std::to_string(version) +
                         ") of the format; this program reads version " +
                         std::to_string(static_cast<int>(packedVersion))};
    const auto payload = bytes.subspan(packedHeaderBytes);
    if (crc16(payload) != ((static_cast<std::uint16_t>(bytes[5]) << 8) | static_cast<std::uint16_t>(bytes[6])))
        return Error{ErrorCode::invalidData, "checksum", "does not match: the file is damaged or truncated"};
    RangeReader reader(payload);
    PackParams params;
    codePackParams(reader, params);
    Clip clip;
    ClipCoder<RangeReader> coder(reader, params, payload.size());
    if (!coder.code(clip))
        return Error{ErrorCode::invalidData, "contents", "are invalid: the file is damaged"};
    if (version >= 2)
        coder.codePhases(clip);
    if (auto valid = validate(clip); !valid)
        return valid.error();
    return clip;
}

/// A valid clip on the grids that packParamsFor() finds, as packing and unpacking leave it.
[[nodiscard]] inline Clip onGrids(Clip clip)
{
    detail::ClipGrids(packParamsFor(clip)).round(clip);
    return clip;
}

} // namespace pacini
