#pragma once

// Axis of a chart: its range, scale and ticks.

#include <string>
#include <vector>

namespace pacini::plot
{

/// A mark on an axis; without a label it is a minor one.
struct Tick
{
    double value = 0.0;
    std::string label;
    bool operator==(const Tick&) const = default;
};

enum class Scale
{
    linear,
    logarithmic, ///< low above 0
    time,        ///< linear in seconds, labelled in seconds or as minutes:seconds
};

struct Axis
{
    std::string title; ///< with the unit
    Scale scale = Scale::linear;
    double low = 0.0;
    double high = 1.0;            ///< above low
    std::vector<Tick> fixedTicks; ///< instead of those of the scale, where not empty
};

/// Returns the place of `value` on the axis: 0 at the low end, 1 at the high end, outside of 0 to 1 beyond them. On a
/// logarithmic scale, values without a logarithm lie well below 0.
[[nodiscard]] double positionOn(const Axis& axis, double value) noexcept;

/// The ticks between the ends of the axis in rising order, at most `most` (1 or more) of them labelled.
[[nodiscard]] std::vector<Tick> ticksOf(const Axis& axis, int most);

/// Multiples of 1, 2 or 5 times a power of ten, the finest that give at most `most` ticks from `low` to `high`.
[[nodiscard]] std::vector<Tick> linearTicks(double low, double high, int most);

/// Labelled at 1, 2 and 5 times powers of ten when these are at most `most`, else at powers of ten, else at every n-th
/// power; the other whole multiples are minor ticks. A range too short for two such values gets linear ticks. Labels
/// are plain numbers when all lie from 0.001 to 100000, else powers.
[[nodiscard]] std::vector<Tick> logarithmicTicks(double low, double high, int most);

/// As linearTicks for ranges within 120 s; beyond, steps that divide minutes and hours, labelled 1:30 or 1:00:00.
[[nodiscard]] std::vector<Tick> timeTicks(double low, double high, int most);

/// The axis of `scale` that shows all of `values` with a little room around them; on a logarithmic scale values of 0
/// and below do not count. Without any value: 0 to 1, or 0.1 to 1 on a logarithmic scale.
[[nodiscard]] Axis axisAround(std::string title, Scale scale, const std::vector<double>& values);

} // namespace pacini::plot
