#include "cli/measure/MeasureCommand.h"

#include "cli/measure/AnalyseSubcommand.h"
#include "cli/measure/FitSubcommand.h"
#include "cli/measure/SimulateSubcommand.h"
#include "cli/measure/SweepSubcommand.h"
#include "cli/measure/VerifySubcommand.h"

namespace pacini::cli
{

MeasureCommand::MeasureCommand()
{
    steps.push_back(std::make_unique<SweepSubcommand>());
    steps.push_back(std::make_unique<AnalyseSubcommand>());
    steps.push_back(std::make_unique<FitSubcommand>());
    steps.push_back(std::make_unique<VerifySubcommand>());
    steps.push_back(std::make_unique<SimulateSubcommand>());
}

CLI::App* MeasureCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("measure", "Measure an actuator and make it flat");
    command->require_subcommand(1);
    for (auto& step : steps)
        declared.push_back(step->declare(*command));
    command->footer(
        "From a bare actuator to a profile, with an accelerometer on it:\n"
        "  pacini measure sweep -o sweep.wav              play this, record the accelerometer\n"
        "  pacini measure analyse recorded.wav --sweep sweep.json --full-scale 5g -o mine.json\n"
        "  pacini measure fit mine.json -o mine.json      adds the equaliser that flattens it\n"
        "  pacini measure sweep -o flat.wav --profile mine.json\n"
        "  pacini measure verify flat-recorded.wav --sweep flat.json --full-scale 5g --profile mine.json\n"
        "Record the same actuator several times, attached anew or on other people, and name all recordings:\n"
        "their average leaves out the odd ones. 'pacini measure simulate' records without hardware.");
    return command;
}

Exit MeasureCommand::run(Console& console)
{
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (declared[i]->parsed())
            return steps[i]->run(console);
    return Exit::usage;
}

} // namespace pacini::cli
