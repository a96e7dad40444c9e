// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/commands/Operations.h"

#include "document/ActuatorTrace.h"

#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr double silence = -60.0; // dB: the floor of the lanes

struct Division
{
    const char* name;
    double notes; ///< of a whole note
};
constexpr std::array<Division, 8> divisions{{{"1/1", 1.0},
                                             {"1/2", 1.0 / 2.0},
                                             {"1/4 (beat)", 1.0 / 4.0},
                                             {"1/8", 1.0 / 8.0},
                                             {"1/8 triplet", 1.0 / 12.0},
                                             {"1/16", 1.0 / 16.0},
                                             {"1/16 triplet", 1.0 / 24.0},
                                             {"1/32", 1.0 / 32.0}}};

double amplitudeOf(double decibels)
{
    return Decibels(decibels).gain();
}

/// A number from `low` to `high`, at first `value`.
OperationField number(const char* name, const char* unit, const char* help, double low, double high, double value,
                      int decimals = 0, std::function<bool(const OperationValues&)> counts = {})
{
    return {name, unit, help, low, high, value, decimals, {}, std::move(counts)};
}

/// An actuator that a clip could have been designed on.
bool isOther(const Actuators& actuators, const NamedProfile& named)
{
    return named.name != actuators.profileName() && canBeAlike(*named.profile);
}

std::function<bool(const OperationValues&)> whenFirstIs(double choice)
{
    return [choice](const OperationValues& v)
    {
        return v[0] == choice;
    };
}
} // namespace

Operation gainOperation(const ClipSelection& selection)
{
    return {"Gain",
            false,
            {number("Gain", "dB", "Level change in dB; above 0 is louder", silence, 24.0, 0.0, 1)},
            [scope = selection.scope()](const OperationValues& v)
            {
                return GainEdit{scope, v[0]};
            }};
}

Operation quantiseOperation(const ClipSelection& selection)
{
    std::vector<std::string> names;
    for (const Division& division : divisions)
        names.push_back(division.name);
    const auto make = [scope = selection.scope()](const OperationValues& v)
    {
        const double whole = 240.0 / v[2]; // s of four beats
        const double step = v[0] == 0.0 ? v[1] : whole * divisions[static_cast<std::size_t>(v[3])].notes;
        return QuantiseEdit{scope, {step, v[4], v[5] / 100.0}};
    };
    return {"Quantise",
            false,
            {{.name = "Grid", .help = "Grid in seconds or beats", .choices = {"Seconds", "Beats"}},
             number("Distance", "s", "Distance between grid lines, in s", 0.001, 10.0, 0.1, 3, whenFirstIs(0.0)),
             number("Tempo", "bpm", "Quarter notes per minute", 20.0, 400.0, 120.0, 1, whenFirstIs(1.0)),
             {.name = "Division",
              .help = "Distance between grid lines, as a note value",
              .value = 5.0,
              .choices = names,
              .counts = whenFirstIs(1.0)},
             number("Offset", "s", "Time of any grid line, in s", 0.0, 60.0, 0.0, 3),
             number("Strength", "%", "Strength of quantising: 100 % moves points onto the grid", 0.0, 100.0, 100.0)},
            make};
}

Operation humaniseOperation(const ClipSelection& selection)
{
    return {
        "Humanise",
        false,
        {number("Time", "ms", "Max. random time shift, earlier or later, in ms", 0.0, 200.0, 10.0, 1),
         number("Level", "dB", "Max. random level change, up or down, in dB", 0.0, 12.0, 2.0, 1),
         number("Pitch", "semitones", "Max. random pitch change, up or down, in semitones", 0.0, 12.0, 0.5, 2),
         number("Variation", "number", "Random seed; the same number always gives the same result", 1.0, 999.0, 1.0)},
        [scope = selection.scope()](const OperationValues& v)
        {
            return HumaniseEdit{scope, {v[0] / 1000.0, v[1], v[2], static_cast<std::uint64_t>(v[3])}};
        }};
}

Operation thinOperation(const ClipSelection& selection)
{
    return {
        "Thin events",
        false,
        {number("Closer than", "ms", "Of events closer than this only the strongest stays; skin resolves 8 to 10 ms",
                0.0, 500.0, 20.0, 1),
         number("Weaker than", "dB", "Removes events below this level, in dB re full drive; at -60 dB all stay",
                silence, 0.0, silence, 1)},
        [range = selection.scope().range](const OperationValues& v)
        {
            return ThinEdit{range, v[0] / 1000.0, v[1] <= silence ? 0.0 : amplitudeOf(v[1])};
        }};
}

Operation transposeOperation()
{
    return {"Transpose",
            true,
            {number("Shift", "semitones", "Twelve semitones are one octave, twice the frequency", -48.0, 48.0, 0.0, 2)},
            [](const OperationValues& v)
            {
                return TransposeEdit{v[0]};
            }};
}

Operation stretchOperation(const EditorModel& model)
{
    const double duration = model.clip()->duration;
    return {"Stretch",
            true,
            {{.name = "By", .help = "How the new length is entered", .choices = {"Percent", "New length"}},
             number("Percent", "%", "New length in percent of the old; pitch is kept", 1.0, 1000.0, 100.0, 1,
                    whenFirstIs(0.0)),
             number("Length", "s", "New length in s; pitch is kept", std::max(0.01, 0.01 * duration),
                    std::max(0.1, 10.0 * duration), duration, 3, whenFirstIs(1.0))},
            [duration](const OperationValues& v)
            {
                const double ratio = v[0] == 0.0 ? v[1] / 100.0 : duration > 0.0 ? v[2] / duration : 1.0;
                return StretchEdit{ratio};
            }};
}

Operation repeatOperation()
{
    return {"Repeat",
            true,
            {number("Times", "passes", "How many times the clip plays in total", 1.0, 100.0, 2.0)},
            [](const OperationValues& v)
            {
                return RepeatEdit{static_cast<int>(std::lround(v[0]))};
            }};
}

bool hasAlike(const Actuators& actuators)
{
    const auto here = actuators.profile();
    return here && canBeAlike(*here) &&
           std::any_of(actuators.profiles().begin(), actuators.profiles().end(),
                       [&](const NamedProfile& named) { return isOther(actuators, named); });
}

Operation alikeOperation(const Actuators& actuators)
{
    const auto here = actuators.profile();
    std::vector<std::shared_ptr<const Profile>> others;
    std::vector<std::string> names;
    for (const NamedProfile& named : actuators.profiles())
        if (isOther(actuators, named))
        {
            others.push_back(named.profile);
            names.push_back(shortNameOf(*named.profile));
        }
    const auto make = [here, others, strength = actuators.strength()](const Clip& clip,
                                                                      const OperationValues& v) -> Result<MadeClip>
    {
        auto made = feltAlike(clip, *others[static_cast<std::size_t>(v[0])], *here, strength);
        if (!made)
            return made.error();
        return MadeClip{std::move(made->clip), fmt::format("{}", fmt::join(made->lost, "\n"))};
    };
    return {.name = "Feel as on",
            .wholeClip = true,
            .fields = {{.name = "Designed on",
                        .help = "The actuator whose feel is kept on the chosen one",
                        .choices = names}},
            .make = {},
            .makeClip = make};
}

} // namespace pacini::editor
