#pragma once

// Channels of a sound that are more than directions.

#include <cstddef>
#include <optional>

namespace pacini
{

/// Which channels of a sound hold low-frequency effects, and the centre, where films have their speech; as far as the
/// file names its channels. Of one or two none is either.
struct SpecialChannels
{
    std::optional<std::size_t> lowFrequency;
    std::optional<std::size_t> centre;

    [[nodiscard]] bool operator==(const SpecialChannels&) const = default;
};

} // namespace pacini
