#include "io/formats/ImportedClip.h"

#include <pacini/clip/BandPriority.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace pacini
{

void ImportReport::warn(std::string_view where, std::string_view message)
{
    constexpr std::size_t most = 50;
    if (warnings.size() < most)
        warnings.push_back(fmt::format("{}: {}", where, message));
}

void ImportReport::fail(std::string where, std::string message, ErrorCode code)
{
    if (!error)
        error = Error{code, std::move(where), std::move(message)};
}

Band* ImportLanes::take(double start, double end, std::size_t most)
{
    std::size_t lane = 0;
    while (lane < bands.size() && ends[lane] > start)
        ++lane;
    if (lane == bands.size())
    {
        if (bands.size() >= most)
            return nullptr;
        bands.emplace_back();
        ends.push_back(0.0);
    }
    ends[lane] = end;
    return &bands[lane];
}

void finishImported(Clip& clip)
{
    std::stable_sort(clip.transients.begin(), clip.transients.end(),
                     [](const Transient& a, const Transient& b) { return a.time < b.time; });
    std::vector<double> energies;
    for (const Band& band : clip.bands)
        energies.push_back(curveEnergy(band.amplitude, clip.duration));
    const auto priorities = prioritiesByEnergy(energies);
    for (std::size_t i = 0; i < clip.bands.size(); ++i)
        clip.bands[i].priority = priorities[i];
}

} // namespace pacini
