#include "cli/BenchCommand.h"
#include "cli/Command.h"
#include "cli/CompareCommand.h"
#include "cli/ConvertCommand.h"
#include "cli/DevicesCommand.h"
#include "cli/EncodeCommand.h"
#include "cli/InfoCommand.h"
#include "cli/LintCommand.h"
#include "cli/PlayCommand.h"
#include "cli/PlotCommand.h"
#include "cli/ProfilesCommand.h"
#include "cli/RenderCommand.h"
#include "cli/measure/MeasureCommand.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <string_view>

namespace pacini::cli
{

std::vector<std::unique_ptr<Command>> allCommands()
{
    std::vector<std::unique_ptr<Command>> commands;
    commands.push_back(std::make_unique<EncodeCommand>());
    commands.push_back(std::make_unique<RenderCommand>());
    commands.push_back(std::make_unique<InfoCommand>());
    commands.push_back(std::make_unique<ConvertCommand>());
    commands.push_back(std::make_unique<LintCommand>());
    commands.push_back(std::make_unique<ProfilesCommand>());
    commands.push_back(std::make_unique<DevicesCommand>());
    commands.push_back(std::make_unique<PlayCommand>());
    commands.push_back(std::make_unique<CompareCommand>());
    commands.push_back(std::make_unique<MeasureCommand>());
    commands.push_back(std::make_unique<PlotCommand>());
    commands.push_back(std::make_unique<BenchCommand>());
    return commands;
}

namespace
{
/// The names of the subcommands, each after a blank.
std::string namesOf(const CLI::App& app)
{
    std::string names;
    for (const CLI::App* command : app.get_subcommands(nullptr))
        names += " " + command->get_name();
    return names;
}

/// One line that says what is wrong with the command line and where to read on.
std::string usageText(const CLI::ParseError& error, const CLI::App& app)
{
    const CLI::App* chosen = &app;
    std::string called = "pacini";
    std::string path;
    while (!chosen->get_subcommands().empty())
    {
        chosen = chosen->get_subcommands().front();
        path += (path.empty() ? "" : " ") + chosen->get_name();
        called += " " + chosen->get_name();
    }
    std::string what = error.what();
    const bool namesAnOption = what.starts_with("--");
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && !namesAnOption)
    {
        const std::string kind = chosen != &app ? "step" : "command";
        const auto rest = app.remaining(true);
        if (chosen->get_subcommands(nullptr).empty())
            what = "a file to work on is missing";
        else
            what = (rest.empty() ? "a " + kind + " is missing" : "'" + rest.front() + "' is not a " + kind) +
                   "; there are" + namesOf(*chosen);
    }
    return (path.empty() ? "" : path + ": ") + what + "; try '" + called + " --help'";
}

/// The command that was chosen, such as "measure fit".
std::string commandPath(const CLI::App& app)
{
    std::string path;
    for (const CLI::App* chosen = &app; !chosen->get_subcommands().empty();)
    {
        chosen = chosen->get_subcommands().front();
        path += (path.empty() ? "" : " ") + chosen->get_name();
    }
    return path;
}

/// Whether --json is given, found without the parser, which may have stopped before it.
bool asksForJson(int argc, const char* const* argv)
{
    for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i)
        if (std::string_view(argv[i]) == "--json")
            return true;
    return false;
}

Exit runCommand(Command& command, Console& console)
{
    try
    {
        return command.run(console);
    }
    catch (const std::bad_alloc&)
    {
        console.error("", {ErrorCode::tooLarge, "", "ran out of memory; try shorter files, one at a time (-j 1)"});
    }
    catch (const std::exception& error)
    {
        console.error("", {ErrorCode::io, "", error.what()});
    }
    return Exit::failed;
}

/// Parses and runs; what is to be printed at the end is not yet.
Exit parseAndRun(Console& console, int argc, const char* const* argv)
{
    CLI::App app(
        "Pacini turns sound into touch: it encodes recordings as haptic clips and renders clips as drive signals.",
        "pacini");
    app.set_version_flag("--version", "pacini " PACINI_VERSION);
    app.require_subcommand(1);
    app.fallthrough(false);
    app.footer("Examples:\n"
               "  pacini encode impact.wav -o impact.pacb     a recording becomes a clip of a few hundred bytes\n"
               "  pacini render impact.pacb -o impact.wav     the clip becomes a drive signal for an actuator\n"
               "  pacini encode sounds/ -o clips/ --format packed\n"
               "  pacini compare sounds/ rendered/           how much of each sound its haptic signal keeps\n"
               "'pacini COMMAND --help' explains a command.");

    auto commands = allCommands();
    std::vector<CLI::App*> declared;
    bool quiet = false, json = false;
    const auto addCommon = [&](CLI::App& where)
    {
        where.add_flag("-q,--quiet", quiet, "Say nothing but results, warnings and errors");
        where.add_flag("--json", json, "Print one JSON object instead of text, also when something fails");
    };
    addCommon(app);
    for (auto& command : commands)
    {
        declared.push_back(command->declare(app));
        addCommon(*declared.back());
        for (CLI::App* step : declared.back()->get_subcommands(nullptr))
            addCommon(*step);
    }
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::Success& asked) // for help or the version
    {
        std::ostringstream text;
        app.exit(asked, text, text);
        std::string lines = text.str();
        lines.erase(lines.find_last_not_of('\n') + 1);
        if (asksForJson(argc, argv))
            console.beJson(commandPath(app));
        console.addToReport({{"text", lines}});
        console.print(lines);
        return Exit::ok;
    }
    catch (const CLI::ParseError& error)
    {
        if (asksForJson(argc, argv))
            console.beJson(commandPath(app));
        console.error("", {ErrorCode::invalidArgument, "", usageText(error, app)});
        return Exit::usage;
    }
    if (quiet)
        console.beQuiet();
    if (json)
        console.beJson(commandPath(app));
    for (std::size_t i = 0; i < commands.size(); ++i)
        if (declared[i]->parsed())
            return runCommand(*commands[i], console);
    return Exit::usage;
}
} // namespace

int runCommandLine(int argc, const char* const* argv)
{
    Console console;
    Exit exit = parseAndRun(console, argc, argv);
    console.endReport(exit == Exit::ok);
    if (const auto failure = console.printFailure())
    {
        console.error("standard output", *failure);
        exit = exit == Exit::ok ? Exit::failed : exit;
    }
    return static_cast<int>(exit);
}

} // namespace pacini::cli
