#pragma once

// Error accumulation: what leaving several things out costs together.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <tuple>

namespace pacini::detail
{

/// Adds up errors. Parts of one sound that start together add in amplitude, others in power; the sum is raised by 1.5
/// dB for what different sounds may have in common by chance.
class ErrorSum
{
public:
    using Key = std::tuple<std::size_t, double, double>; // clip, start, transposition

    [[nodiscard]] double with(const Key& key, double energy) const
    {
        const auto found = amplitudes.find(key);
        const double before = found == amplitudes.end() ? 0.0 : found->second;
        const double after = before + std::sqrt(energy);
        return margin * (power - before * before + after * after);
    }
    void add(const Key& key, double energy)
    {
        double& amplitude = amplitudes[key];
        power -= amplitude * amplitude;
        amplitude += std::sqrt(energy);
        power += amplitude * amplitude;
    }
    [[nodiscard]] double total() const { return margin * std::max(power, 0.0); }

private:
    static constexpr double margin = 1.41;
    std::map<Key, double> amplitudes;
    double power = 0.0;
};

inline double errorInDecibels(double energy, double whole)
{
    return energy > 0.0 && whole > 0.0 ? 10.0 * std::log10(energy / whole) : -std::numeric_limits<double>::infinity();
}

} // namespace pacini::detail
