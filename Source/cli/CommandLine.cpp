#include "cli/Command.h"
#include "cli/CompareCommand.h"
#include "cli/ConvertCommand.h"
#include "cli/EncodeCommand.h"
#include "cli/InfoCommand.h"
#include "cli/PlotCommand.h"
#include "cli/RenderCommand.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

namespace pacini::cli
{

std::vector<std::unique_ptr<Command>> allCommands()
{
    std::vector<std::unique_ptr<Command>> commands;
    commands.push_back(std::make_unique<EncodeCommand>());
    commands.push_back(std::make_unique<RenderCommand>());
    commands.push_back(std::make_unique<InfoCommand>());
    commands.push_back(std::make_unique<ConvertCommand>());
    commands.push_back(std::make_unique<CompareCommand>());
    commands.push_back(std::make_unique<PlotCommand>());
    return commands;
}

int runCommandLine(int argc, const char* const* argv)
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

    Console console;
    auto commands = allCommands();
    std::vector<CLI::App*> declared;
    for (auto& command : commands)
        declared.push_back(command->declare(app));
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::CallForHelp& help)
    {
        return app.exit(help);
    }
    catch (const CLI::CallForAllHelp& help)
    {
        return app.exit(help);
    }
    catch (const CLI::CallForVersion& version)
    {
        return app.exit(version);
    }
    catch (const CLI::ParseError& error)
    {
        fmt::print(stderr, "pacini: {}\nTry 'pacini --help' or 'pacini COMMAND --help'.\n", error.what());
        return static_cast<int>(Exit::usage);
    }
    try
    {
        for (std::size_t i = 0; i < commands.size(); ++i)
            if (declared[i]->parsed())
                return static_cast<int>(commands[i]->run(console));
    }
    catch (const std::bad_alloc&)
    {
        console.error("", {ErrorCode::tooLarge, "", "ran out of memory; try shorter files, one at a time (-j 1)"});
        return static_cast<int>(Exit::failed);
    }
    catch (const std::exception& error)
    {
        console.error("", {ErrorCode::io, "", error.what()});
        return static_cast<int>(Exit::failed);
    }
    return static_cast<int>(Exit::usage);
}

} // namespace pacini::cli
