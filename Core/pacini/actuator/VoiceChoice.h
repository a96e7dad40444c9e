#pragma once

// Which bands an actuator of few voices plays.

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace pacini
{

/// The indices, in rising order, of at most `voices` bands to be played: those of the lowest priority number (0 comes
/// first), among equals those of the most energy, then the first. Bands without energy (0, negative or NaN) take no
/// voice. Both spans have an element for each band.
[[nodiscard]] inline std::vector<std::size_t> chooseVoices(std::span<const int> priorities,
                                                           std::span<const double> energies, std::size_t voices)
{
    assert(priorities.size() == energies.size());
    std::vector<std::size_t> chosen(energies.size());
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    std::erase_if(chosen, [&](std::size_t i) { return !(energies[i] > 0.0); });
    std::stable_sort(chosen.begin(), chosen.end(),
                     [&](std::size_t a, std::size_t b) {
                         return priorities[a] != priorities[b] ? priorities[a] < priorities[b]
                                                               : energies[a] > energies[b];
                     });
    chosen.resize(std::min(voices, chosen.size()));
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

} // namespace pacini
