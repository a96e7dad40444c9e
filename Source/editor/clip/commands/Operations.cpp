// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/commands/Operations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

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
                                             {"1/4 (a beat)", 1.0 / 4.0},
                                             {"1/8", 1.0 / 8.0},
                                             {"1/8 triplet", 1.0 / 12.0},
                                             {"1/16", 1.0 / 16.0},
                                             {"1/16 triplet", 1.0 / 24.0},
                                             {"1/32", 1.0 / 32.0}}};

double amplitudeOf(double decibels)
{
    return std::pow(10.0, decibels / 20.0);
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
    Operation result;
    result.name = "Gain";
    result.fields = {{.name = "Gain",
                      .unit = "dB",
                      .help = "How much louder (above 0) or softer levels become, in dB",
                      .low = silence,
                      .high = 24.0,
                      .value = 0.0,
                      .decimals = 1}};
    result.make = [scope = selection.scope()](const OperationValues& v)
    {
        return GainEdit{scope, v[0]};
    };
    return result;
}

Operation quantiseOperation(const ClipSelection& selection)
{
    Operation result;
    result.name = "Quantise";
    std::vector<const char*> names;
    for (const Division& division : divisions)
        names.push_back(division.name);
    result.fields = {
        {.name = "Grid", .help = "Whether the grid is in seconds or in beats", .choices = {"Seconds", "Beats"}},
        {.name = "Distance",
         .unit = "s",
         .help = "Distance between the lines of the grid, in s",
         .low = 0.001,
         .high = 10.0,
         .value = 0.1,
         .decimals = 3,
         .counts = whenFirstIs(0.0)},
        {.name = "Tempo",
         .unit = "beats/min",
         .help = "Beats (quarter notes) a minute",
         .low = 20.0,
         .high = 400.0,
         .value = 120.0,
         .decimals = 1,
         .counts = whenFirstIs(1.0)},
        {.name = "Division",
         .help = "Distance between the lines of the grid, as a note",
         .value = 5.0,
         .choices = names,
         .counts = whenFirstIs(1.0)},
        {.name = "First line",
         .unit = "s",
         .help = "Time of any line of the grid, in s",
         .low = 0.0,
         .high = 60.0,
         .value = 0.0,
         .decimals = 3},
        {.name = "Strength",
         .unit = "%",
         .help = "How far times move towards the grid: 100 % is all the way",
         .low = 0.0,
         .high = 100.0,
         .value = 100.0}};
    result.make = [scope = selection.scope()](const OperationValues& v)
    {
        const double whole = 240.0 / v[2]; // s of four beats
        const double step = v[0] == 0.0 ? v[1] : whole * divisions[static_cast<std::size_t>(v[3])].notes;
        return QuantiseEdit{scope, {step, v[4], v[5] / 100.0}};
    };
    return result;
}

Operation humaniseOperation(const ClipSelection& selection)
{
    Operation result;
    result.name = "Humanise";
    result.fields = {{.name = "Time",
                      .unit = "ms",
                      .help = "Largest random shift of times, earlier or later, in ms",
                      .low = 0.0,
                      .high = 200.0,
                      .value = 10.0,
                      .decimals = 1},
                     {.name = "Level",
                      .unit = "dB",
                      .help = "Largest random change of levels, up or down, in dB",
                      .low = 0.0,
                      .high = 12.0,
                      .value = 2.0,
                      .decimals = 1},
                     {.name = "Pitch",
                      .unit = "semitones",
                      .help = "Largest random change of frequencies, up or down, in semitones",
                      .low = 0.0,
                      .high = 12.0,
                      .value = 0.5,
                      .decimals = 2},
                     {.name = "Variation",
                      .unit = "number",
                      .help = "Seed of the random changes: the same number always gives the same result",
                      .low = 1.0,
                      .high = 999.0,
                      .value = 1.0}};
    result.make = [scope = selection.scope()](const OperationValues& v)
    {
        return HumaniseEdit{scope, {v[0] / 1000.0, v[1], v[2], static_cast<std::uint64_t>(v[3])}};
    };
    return result;
}

Operation thinOperation(const ClipSelection& selection)
{
    Operation result;
    result.name = "Thin transients";
    result.fields = {{.name = "Closer than",
                      .unit = "ms",
                      .help = "Of transients closer than this the strongest stays; skin tells 8 to 10 ms apart",
                      .low = 0.0,
                      .high = 500.0,
                      .value = 20.0,
                      .decimals = 1},
                     {.name = "Weaker than",
                      .unit = "dB",
                      .help = "Transients below this level are removed, in dB of full drive; at -60 dB all stay",
                      .low = silence,
                      .high = 0.0,
                      .value = silence,
                      .decimals = 1}};
    result.make = [range = selection.scope().range](const OperationValues& v)
    {
        return ThinEdit{range, v[0] / 1000.0, v[1] <= silence ? 0.0 : amplitudeOf(v[1])};
    };
    return result;
}

Operation transposeOperation()
{
    Operation result;
    result.name = "Transpose";
    result.wholeClip = true;
    result.fields = {{.name = "Shift",
                      .unit = "semitones",
                      .help = "Twelve semitones are an octave: twice the frequency",
                      .low = -48.0,
                      .high = 48.0,
                      .value = 0.0,
                      .decimals = 2}};
    result.make = [](const OperationValues& v)
    {
        return TransposeEdit{v[0]};
    };
    return result;
}

Operation stretchOperation(const EditorModel& model)
{
    const double duration = model.clip()->duration;
    Operation result;
    result.name = "Stretch";
    result.wholeClip = true;
    result.fields = {{.name = "By", .help = "How the new length is given", .choices = {"Percent", "New duration"}},
                     {.name = "Percent",
                      .unit = "%",
                      .help = "New length in percent of the old one; pitches stay",
                      .low = 1.0,
                      .high = 1000.0,
                      .value = 100.0,
                      .decimals = 1,
                      .counts = whenFirstIs(0.0)},
                     {.name = "Duration",
                      .unit = "s",
                      .help = "New length in s; pitches stay",
                      .low = std::max(0.01, 0.01 * duration),
                      .high = std::max(0.1, 10.0 * duration),
                      .value = duration,
                      .decimals = 3,
                      .counts = whenFirstIs(1.0)}};
    result.make = [duration](const OperationValues& v)
    {
        const double ratio = v[0] == 0.0 ? v[1] / 100.0 : duration > 0.0 ? v[2] / duration : 1.0;
        return StretchEdit{ratio};
    };
    return result;
}

Operation repeatOperation()
{
    Operation result;
    result.name = "Repeat";
    result.wholeClip = true;
    result.fields = {{.name = "Times",
                      .unit = "passes",
                      .help = "How many times the clip plays in all",
                      .low = 1.0,
                      .high = 100.0,
                      .value = 2.0}};
    result.make = [](const OperationValues& v)
    {
        return RepeatEdit{static_cast<int>(std::lround(v[0]))};
    };
    return result;
}

} // namespace pacini::editor
