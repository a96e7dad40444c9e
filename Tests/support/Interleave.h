#pragma once

#include <cstddef>
#include <vector>

namespace pacini::test
{

/// Channels of equal length as frames.
inline std::vector<float> interleave(const std::vector<std::vector<float>>& channels)
{
    std::vector<float> frames;
    for (std::size_t i = 0; i < channels.front().size(); ++i)
        for (const auto& channel : channels)
            frames.push_back(channel[i]);
    return frames;
}

} // namespace pacini::test
