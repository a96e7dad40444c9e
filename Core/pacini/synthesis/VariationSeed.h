#pragma once

// Seeds of the variations of several plays of one clip.

#include <pacini/foundation/Random.h>

#include <cstdint>

namespace pacini
{

/// Returns the seed of the play with number `play`; play 0 keeps `seed`. The seed is hashed, since the numbers of
/// Random from seeds that lie multiples of its increment apart are the same numbers, some draws later.
[[nodiscard]] constexpr std::uint64_t seedOfPlay(std::uint64_t seed, std::uint64_t play) noexcept
{
    return play == 0 ? seed : Random(seed + 0xD1B54A32D192ED03u * play).next();
}

} // namespace pacini
