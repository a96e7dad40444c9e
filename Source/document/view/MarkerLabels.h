#pragma once

// Layout of the labels of markers.

#include "document/view/TimeAxis.h"

#include <pacini/clip/Clip.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// A marker that is in view, and the room that its name has before the next marker begins.
struct MarkerLabel
{
    std::size_t marker = 0;
    double x = 0.0;     ///< pixels
    double width = 0.0; ///< pixels, 0 and above
    bool operator==(const MarkerLabel&) const = default;
};

/// The markers whose flag or name is inside a view of `width` pixels. No name takes more than `most` pixels.
[[nodiscard]] inline std::vector<MarkerLabel> markerLabels(std::span<const Marker> markers, const TimeAxis& axis,
                                                           double width, double most)
{
    std::vector<MarkerLabel> labels;
    for (std::size_t i = 0; i < markers.size(); ++i)
    {
        const double x = axis.xOf(markers[i].time);
        const double next = i + 1 < markers.size() ? axis.xOf(markers[i + 1].time) : x + most;
        const double room = std::clamp(next - x, 0.0, most);
        if (x + std::max(room, 1.0) >= 0.0 && x <= width)
            labels.push_back({i, x, room});
    }
    return labels;
}

} // namespace pacini
