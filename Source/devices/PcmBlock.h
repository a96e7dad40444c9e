#pragma once

// Samples for a controller that plays a signal instead of levels.

#include <array>
#include <cstddef>
#include <cstdint>

namespace pacini::devices
{

/// Samples of both sides for one report; those beyond SampleStream::samples do not count.
struct PcmBlock
{
    static constexpr std::size_t most = 32;
    std::array<std::int16_t, most> left{};
    std::array<std::int16_t, most> right{};
    bool operator==(const PcmBlock&) const = default;
};

/// Rate and length of such blocks.
struct SampleStream
{
    int rate = 8000;         ///< Hz
    std::size_t samples = 0; ///< of each side in a report
};

} // namespace pacini::devices
