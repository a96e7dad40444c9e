// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Settings to start from.

#include "plugin/ParameterValues.h"

#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace pacini::plugin
{

struct ProgramValue
{
    ParameterId parameter;
    double value;
};

/// Everything that is not named has its default; routing, actuator and bypass stay as they are.
struct Program
{
    const char* name;
    std::array<ProgramValue, 6> values; ///< filled up with the default of bypass
};

inline constexpr ProgramValue noValue{ParameterId::bypass, 0.0};

inline constexpr std::array<Program, 7> programs{{
    {"Faithful", {noValue, noValue, noValue, noValue, noValue, noValue}},
    {"Bass and drums",
     {{{ParameterId::rumbleLevel, 4.0},
       {ParameterId::textureLevel, -6.0},
       {ParameterId::transientLevel, 3.0},
       {ParameterId::transientSensitivity, 0.55},
       noValue,
       noValue}}},
    {"Only events",
     {{{ParameterId::rumbleMute, 1.0},
       {ParameterId::textureMute, 1.0},
       {ParameterId::transientLevel, 3.0},
       {ParameterId::transientSensitivity, 0.6},
       noValue,
       noValue}}},
    {"Soft rumble",
     {{{ParameterId::textureLevel, -18.0},
       {ParameterId::transientMute, 1.0},
       {ParameterId::direct, 0.0},
       {ParameterId::attack, 20.0},
       {ParameterId::release, 80.0},
       noValue}}},
    {"Fine texture",
     {{{ParameterId::rumbleLevel, -9.0},
       {ParameterId::textureLevel, 6.0},
       {ParameterId::transientLevel, -3.0},
       {ParameterId::transientSharpness, 0.4},
       noValue,
       noValue}}},
    {"Speech",
     {{{ParameterId::rumbleLevel, -12.0},
       {ParameterId::textureLevel, 3.0},
       {ParameterId::transientSensitivity, 0.35},
       {ParameterId::gateThreshold, -55.0},
       {ParameterId::gateRelease, 120.0},
       noValue}}},
    {"An octave lower",
     {{{ParameterId::transposition, -12.0}, {ParameterId::release, 20.0}, noValue, noValue, noValue, noValue}}},
}};

/// Whether a program leaves a parameter as it is.
[[nodiscard]] constexpr bool staysInPrograms(ParameterId parameter) noexcept
{
    using enum ParameterId;
    return parameter == source || parameter == sourceMix || parameter == outputMode || parameter == outputChannel ||
           parameter == profile || parameter == bypass;
}

/// The values of a program on top of `before`.
[[nodiscard]] inline ParameterValues withProgram(ParameterValues before, const Program& program) noexcept
{
    for (const ParameterRow& row : parameterTable)
        if (!staysInPrograms(row.parameter))
            before.set(row.parameter, row.standard);
    for (const ProgramValue& value : program.values)
        if (!staysInPrograms(value.parameter))
            before.set(value.parameter, value.value);
    return before;
}

} // namespace pacini::plugin
