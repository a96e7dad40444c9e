// Subcommand that runs the benchmarks.

#include "cli/BenchOptions.h"
#include "cli/Command.h"
#include "cli/Options.h"

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
/// `pacini bench`: error against run time, measured on the user's machine and sounds.
struct BenchCommand : Command
{
    explicit BenchCommand(BenchRun toRun) : measure(std::move(toRun)) {}

    CLI::App* declare(CLI::App& app) override
    {
        auto* command = app.add_subcommand("bench", "Measure error against run time");
        std::string names = "all";
        std::vector<std::string> allowed = {"all"};
        for (const std::string_view name : benchNames)
        {
            names += ", " + std::string(name);
            allowed.emplace_back(name);
        }
        addPreset(*command, "what", options.what, "Measurement: " + names, oneOf(allowed), "WHAT");
        addOption(*command, "inputs", options.inputs, "Sounds or folders of sounds [the demo sounds]", "IN");
        addPreset(*command, "-o,--output", options.output, "Folder for the tables and charts", "DIR");
        addPreset(*command, "--repeat", options.settings.repeats,
                  "Number of runs; the fastest one counts. Long runs are not repeated", wholeNumberFrom(1, 1000));
        command->add_flag("--sweep", options.settings.sweep,
                          "Measure more settings: of Pacini's own method (methods); of strength and boost (actuators)");
        addPreset(*command, "--format", options.format, "Format of the charts", oneOf({"svg", "png"}));
        addOption(*command, "--markdown", options.markdown, "Also write all tables into one Markdown page", "FILE");
        options.overwriting.declare(*command);
        return command->footer(
            "Errors and times are measured in the same runs, one at a time, on one processor. Times differ "
            "between\ncomputers; compare ratios.\n"
            "Examples:\n  pacini bench simplify                         the demo sounds, into pacini-bench/\n"
            "  pacini bench methods sounds/ --sweep -o out   all methods over a folder\n"
            "  pacini bench all sounds/ --markdown measurements.md");
    }

    Exit run(Console& console) override { return measure(options, console); }

    BenchRun measure;
    BenchOptions options;
};
} // namespace

std::unique_ptr<Command> benchCommand(BenchRun run)
{
    return std::make_unique<BenchCommand>(std::move(run));
}

} // namespace pacini::cli
