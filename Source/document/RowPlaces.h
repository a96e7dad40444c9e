#pragma once

// Places of the actuators of a row, and where a position lies among them.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace pacini
{

/// Up to 16 actuators at places 0 to 1, in any order; several may be at one. Touches no heap.
class RowPlaces
{
public:
    static constexpr std::size_t most = 16;

    RowPlaces() = default;
    /// Those behind the first `most` are left out.
    explicit RowPlaces(std::span<const double> places) noexcept : count(std::min(places.size(), most))
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            for (std::size_t other = 0; other < count; ++other)
                ranks[i] += places[other] < places[i] || (places[other] == places[i] && other < i);
            ranked[ranks[i]] = places[i];
        }
    }

    /// Places that are spread evenly.
    [[nodiscard]] static RowPlaces even(std::size_t actuators) noexcept
    {
        std::array<double, most> places{};
        const std::size_t used = std::min(actuators, most);
        for (std::size_t i = 0; i < used; ++i)
            places[i] = placeOf(i, used);
        return RowPlaces(std::span(places).first(used));
    }
    [[nodiscard]] static double placeOf(std::size_t actuator, std::size_t actuators) noexcept
    {
        return static_cast<double>(actuator) / static_cast<double>(std::max<std::size_t>(actuators, 2) - 1);
    }

    [[nodiscard]] std::size_t size() const noexcept { return count; }

    /// Which one of the row an actuator is, from place 0 on.
    [[nodiscard]] std::size_t rank(std::size_t actuator) const noexcept { return ranks[actuator]; }

    /// `position` on a row whose actuators stand evenly from 0 to 1: at each place it is at that actuator, nothing is
    /// beyond the outer ones.
    [[nodiscard]] double onRow(double position) const noexcept
    {
        if (count < 2)
            return 0.0;
        std::size_t below = 0;
        while (below + 1 < count && ranked[below + 1] <= position)
            ++below;
        const double way = below + 1 < count ? ranked[below + 1] - ranked[below] : 0.0;
        const double part = way > 0.0 ? std::clamp((position - ranked[below]) / way, 0.0, 1.0) : 0.0;
        return (static_cast<double>(below) + part) / static_cast<double>(count - 1);
    }

private:
    std::size_t count = 0;
    std::array<std::size_t, most> ranks{};
    std::array<double, most> ranked{};
};

} // namespace pacini
