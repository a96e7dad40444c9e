#pragma once

// Numbers of bits, kinds and codes of HMPG files.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pacini
{

enum class HmpgUnit : unsigned
{
    initialisation = 0,
    temporal = 1,
    spatial = 2,
    silent = 3
};

enum class HmpgPacket : unsigned
{
    timing = 0,
    file = 1,
    perception = 2,
    channel = 3,
    band = 4,
    data = 5,
    library = 6,
    checksum32 = 7,
    checksum16 = 8,
    checksumOfAll16 = 9,
    checksumOfAll32 = 10,
    firstTiming = 11
};

inline constexpr std::size_t hmpgUnitHeader = 9;   ///< bytes
inline constexpr std::size_t hmpgPacketHeader = 3; ///< bytes
inline constexpr std::size_t hmpgFirstTiming = 15; ///< bytes of this packet behind its header
inline constexpr unsigned hmpgUnitLength = 128;    ///< ticks, of the reference program

/// Names in HJIF files by their code.
inline constexpr std::array<std::string_view, 14> hmpgModalities{
    "Other", "Pressure", "Acceleration",         "Velocity",  "Position", "Temperature",   "Vibrotactile", "Water",
    "Wind",  "Force",    "Vibrotactile Texture", "Stiffness", "Friction", "Electrotactile"};
inline constexpr std::array<std::string_view, 4> hmpgBandTypes{"Transient", "Curve", "VectorialWave", "WaveletWave"};
inline constexpr std::array<std::string_view, 6> hmpgCurves{"Unknown", "Cubic", "Linear", "Akima", "Bezier", "Bspline"};
inline constexpr std::array<std::string_view, 5> hmpgSignals{"Sine", "Square", "Triangle", "SawToothUp",
                                                             "SawToothDown"};
inline constexpr std::array<std::string_view, 3> hmpgEffects{"Basis", "Reference", "Composite"};

/// Index of `name`, 0 if there is none.
template <std::size_t size>
[[nodiscard]] constexpr std::uint64_t hmpgCodeOf(const std::array<std::string_view, size>& names, std::string_view name)
{
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? 0 : static_cast<std::uint64_t>(found - names.begin());
}

/// A number in equal steps from `low` to `high`, both of which are codes.
struct HmpgScale
{
    int bits;
    double low, high;

    [[nodiscard]] double steps() const { return std::ldexp(1.0, bits) - 1.0; }
    [[nodiscard]] std::uint64_t codeOf(double value) const
    {
        const double place = std::clamp((value - low) / (high - low), 0.0, 1.0);
        return static_cast<std::uint64_t>(std::llround(place * steps()));
    }
    [[nodiscard]] double valueOf(std::uint64_t code) const
    {
        return low + static_cast<double>(code) / steps() * (high - low);
    }
};

inline constexpr HmpgScale hmpgGain{32, -10000.0, 10000.0};
inline constexpr HmpgScale hmpgMixing{32, 0.0, 10000.0};
inline constexpr HmpgScale hmpgPhase{16, 0.0, 6.28318}; ///< rad

/// Amplitudes have no code for 0: the reference program writes the one below, which is read as silence here.
struct HmpgAmplitude
{
    static constexpr HmpgScale scale{8, -1.0, 1.0};
    static constexpr std::uint64_t silence = 127;

    [[nodiscard]] static std::uint64_t codeOf(double value)
    {
        return std::abs(value) < 1e-6 ? silence : scale.codeOf(value);
    }
    [[nodiscard]] static double valueOf(std::uint64_t code) { return code == silence ? 0.0 : scale.valueOf(code); }
};

} // namespace pacini
