#pragma once

// Edits of the markers of a clip. Pure functions from one list sorted by time to another.

#include <pacini/clip/Clip.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// "Marker 3" with the lowest number that no other has.
[[nodiscard]] inline std::string freeMarkerName(std::span<const Marker> markers)
{
    for (std::size_t number = 1;; ++number)
    {
        std::string name = "Marker " + std::to_string(number);
        if (std::none_of(markers.begin(), markers.end(), [&](const Marker& marker) { return marker.name == name; }))
            return name;
    }
}

/// The marker nearest to `time` that is at most `reach` seconds away; of equally near ones the first.
[[nodiscard]] inline std::optional<std::size_t> markerNear(std::span<const Marker> markers, double time, double reach)
{
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < markers.size(); ++i)
    {
        const double distance = std::abs(markers[i].time - time);
        if (distance > reach || (best && distance >= std::abs(markers[*best].time - time)))
            continue;
        best = i;
    }
    return best;
}

/// The time of the first marker behind `time`, or of the last one before it; at least a microsecond away.
[[nodiscard]] inline std::optional<double> markerAfter(std::span<const Marker> markers, double time)
{
    for (const Marker& marker : markers)
        if (marker.time > time + 1e-6)
            return marker.time;
    return std::nullopt;
}

[[nodiscard]] inline std::optional<double> markerBefore(std::span<const Marker> markers, double time)
{
    for (std::size_t i = markers.size(); i-- > 0;)
        if (markers[i].time < time - 1e-6)
            return markers[i].time;
    return std::nullopt;
}

/// A marker more, behind those at its time.
[[nodiscard]] inline std::vector<Marker> withMarker(std::vector<Marker> markers, Marker added)
{
    const auto place = std::upper_bound(markers.begin(), markers.end(), added.time,
                                        [](double time, const Marker& marker) { return time < marker.time; });
    markers.insert(place, std::move(added));
    return markers;
}

/// Indices that do not exist change nothing, here and below.
[[nodiscard]] inline std::vector<Marker> withoutMarker(std::vector<Marker> markers, std::size_t index)
{
    if (index < markers.size())
        markers.erase(markers.begin() + static_cast<std::ptrdiff_t>(index));
    return markers;
}

[[nodiscard]] inline std::vector<Marker> renamedMarker(std::vector<Marker> markers, std::size_t index, std::string name)
{
    if (index < markers.size())
        markers[index].name = std::move(name);
    return markers;
}

/// The marker may pass others. `time` is limited to 0..duration.
[[nodiscard]] inline std::vector<Marker> movedMarker(std::vector<Marker> markers, std::size_t index, double time,
                                                     double duration)
{
    if (index >= markers.size())
        return markers;
    Marker moved = markers[index];
    moved.time = std::clamp(time, 0.0, duration);
    return withMarker(withoutMarker(std::move(markers), index), std::move(moved));
}

} // namespace pacini
