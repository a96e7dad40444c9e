#pragma once

// A recording with a gap.

#include <cstddef>
#include <vector>

namespace pacini::test
{

/// `channels` without `count` frames from `frame` on, as when a buffer was lost.
inline void drop(std::vector<std::vector<float>>& channels, std::size_t frame, std::size_t count)
{
    for (auto& channel : channels)
        channel.erase(channel.begin() + static_cast<std::ptrdiff_t>(frame),
                      channel.begin() + static_cast<std::ptrdiff_t>(frame + count));
}

} // namespace pacini::test
