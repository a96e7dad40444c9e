#include "io/FoundMarkers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

namespace pacini
{

void appendFound(FoundMarkers& all, FoundMarkers found)
{
    std::move(found.markers.begin(), found.markers.end(), std::back_inserter(all.markers));
    std::move(found.warnings.begin(), found.warnings.end(), std::back_inserter(all.warnings));
}

void addMarkers(FoundMarkers& all, FoundMarkers found, double offset)
{
    std::set<std::pair<std::string_view, long long>> there; // times in ms
    for (const Marker& marker : all.markers)
        there.emplace(marker.name, std::llround(marker.time * 1000.0));
    std::vector<Marker> fresh;
    for (Marker& marker : found.markers)
    {
        marker.time += offset;
        const auto ms = std::llround(marker.time * 1000.0);
        const bool isThere = there.contains({marker.name, ms}) || there.contains({marker.name, ms - 1}) ||
                             there.contains({marker.name, ms + 1});
        if (!isThere)
            fresh.push_back(std::move(marker));
    }
    there.clear();
    appendFound(all, {std::move(fresh), std::move(found.warnings)});
    std::stable_sort(all.markers.begin(), all.markers.end(),
                     [](const Marker& a, const Marker& b) { return a.time < b.time; });
}

} // namespace pacini
