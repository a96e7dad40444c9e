#include "cli/BenchProgram.h"
#include "cli/Command.h"
#include "cli/CommandTree.h"
#include "cli/HelpText.h"
#include "cli/Retry.h"
#include "cli/Terminal.h"
#include "cli/UsageText.h"
#include "cli/Version.h"

#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::cli
{

namespace
{
/// Whether --json is given, found without the parser, which may have stopped before it.
bool asksForJson(int argc, const char* const* argv)
{
    for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i)
        if (std::string_view(argv[i]) == "--json")
            return true;
    return false;
}

/// Prints what was asked for instead of work.
Exit answer(Console& console, int argc, const char* const* argv, const std::string& command, const std::string& text)
{
    if (asksForJson(argc, argv))
        console.beJson(command);
    console.addToReport({{"text", text}});
    console.print(text);
    return Exit::ok;
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
Exit parseAndRun(Console& console, int argc, const char* const* argv, const BenchRun& bench)
{
    CLI::App app(
        "Pacini turns sound into touch: it encodes recordings as haptic clips and renders clips as drive signals.",
        "pacini");
    app.set_help_flag("-h,--help", "Print this help");
    app.set_version_flag("--version", "pacini " + versionAndCommit(), "Print the version");
    app.allow_windows_style_options(false); // a path may begin with a slash there, too
    app.require_subcommand(1);
    app.fallthrough(false);
    std::vector<std::unique_ptr<Command>> commands; // in the order of the help text
    for (const auto make : {encodeCommand, renderCommand, infoCommand, convertCommand, lintCommand, profilesCommand,
                            devicesCommand, playCommand, liveCommand, serveCommand, compareCommand, manifestCommand,
                            measureCommand, studyCommand, textureCommand, plotCommand})
        commands.push_back(make());
    commands.push_back(benchCommand(bench));
    for (const auto make : {helpCommand, completionsCommand, manCommand})
        commands.push_back(make());
    std::vector<CLI::App*> declared;
    bool quiet = false, json = false, strict = false;
    const auto addCommon = [&](CLI::App& where)
    {
        where.add_flag("-q,--quiet", quiet, "Print only results, warnings and errors");
        where.add_flag("--json", json, "Print one JSON object instead of text, also on failure");
        where.add_flag("--strict", strict, "Refuse clips, scenes and profiles with unknown keys");
    };
    addCommon(app);
    for (auto& command : commands)
    {
        declared.push_back(command->declare(app));
        addCommon(*declared.back());
        for (CLI::App* step : declared.back()->get_subcommands(nullptr))
            addCommon(*step);
    }
    app.footer("Examples:\n"
               "  pacini encode impact.wav -o impact.pacb     encodes a recording as a clip of a few hundred bytes\n"
               "  pacini render impact.pacb -o impact.wav     renders the clip as the drive signal of an actuator\n"
               "  pacini encode sounds/ -o clips/ --format packed\n"
               "  pacini compare sounds/ rendered/           scores how much of each sound its haptic signal keeps\n"
               "'pacini help COMMAND' explains a command.");
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::CallForVersion& version)
    {
        return answer(console, argc, argv, "", version.what());
    }
    catch (const CLI::CallForHelp&)
    {
        const std::string path = commandPath(app);
        return answer(console, argc, argv, path,
                      helpText(*commandNamed(commandTree(app), path), terminal::textWidth()));
    }
    catch (const CLI::ParseError& error)
    {
        if (asksForJson(argc, argv))
            console.beJson(commandPath(app));
        if (argc < 2)
            console.print(shortHelp(commandTree(app)));
        return console.fail("", {ErrorCode::invalidArgument, "", usageText(error, app)}, Exit::usage);
    }
    if (quiet)
        console.beQuiet();
    if (strict)
        console.beStrict();
    if (json)
        console.beJson(commandPath(app));
    for (std::size_t i = 0; i < commands.size(); ++i)
        if (declared[i]->parsed())
            return runCommand(*commands[i], console);
    return Exit::usage;
}
} // namespace

int runCommandLine(int argc, const char* const* argv, const BenchRun& bench)
{
    Console console;
    std::vector<const char*> words(argv, argv + argc);
    const auto retried = retriedCommand({words.begin(), words.end()});
    if (retried)
    {
        words.clear();
        for (const std::string& word : *retried)
            words.push_back(word.c_str());
    }
    const auto start = [&words](const BenchOptions&, Console& where)
    {
        return runBenchProgram({words.begin(), words.end()}, where);
    };
    Exit exit = parseAndRun(console, static_cast<int>(words.size()), words.data(), bench ? bench : BenchRun(start));
    console.endReport(exit == Exit::ok);
    if (const auto failure = console.printFailure())
    {
        console.error("standard output", *failure);
        exit = exit == Exit::ok ? Exit::failed : exit;
    }
    return static_cast<int>(exit);
}

} // namespace pacini::cli
