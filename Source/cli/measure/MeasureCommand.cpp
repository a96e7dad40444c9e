// Command group for the measurement of actuators: from a sweep to an actuator that is flat, step by step.

#include "cli/CommandGroup.h"

namespace pacini::cli
{

std::unique_ptr<Command> measureCommand()
{
    return commandGroup(
        "measure", "Measure and flatten an actuator",
        {sweepSubcommand, analyseSubcommand, reportSubcommand, fitSubcommand, verifySubcommand, simulateSubcommand,
         compensateSubcommand},
        "From a bare actuator to a profile, with an accelerometer on it:\n"
        "  pacini measure sweep -o sweep.wav              play this, record the accelerometer\n"
        "  pacini measure analyse recorded.wav --sweep sweep.json --full-scale 5g -o mine.json\n"
        "  pacini measure fit mine.json -o mine.json      adds the equaliser that flattens it\n"
        "  pacini measure sweep -o flat.wav --profile mine.json\n"
        "  pacini measure verify flat-recorded.wav --sweep flat.json --full-scale 5g --profile mine.json\n"
        "Record the same actuator several times, attached again or on other people, and name all recordings:\nthe "
        "average leaves out outliers. 'pacini measure simulate' records without hardware.");
}

} // namespace pacini::cli
