// Subcommand that prints help.

#include "cli/Command.h"
#include "cli/HelpText.h"
#include "cli/Options.h"
#include "cli/Terminal.h"
#include "io/NearestName.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
/// What is said of a command that is none.
Error unknownCommand(const CommandText& program, const std::vector<std::string>& topic)
{
    const CommandText* parent = commandNamed(program, topic.front());
    const bool isStep = parent != nullptr && topic.size() > 1;
    std::vector<std::string> names;
    for (const CommandText& command : (isStep ? *parent : program).commands)
        names.push_back(command.name.substr(command.name.rfind(' ') + 1));
    const std::string& word = isStep ? topic[1] : topic.front();
    if (names.empty())
        return {ErrorCode::invalidArgument, "help", fmt::format("'{}' has no steps", topic.front())};
    const std::string meant = meantText(word, names);
    return {ErrorCode::invalidArgument, "help",
            fmt::format("unknown {1} '{0}'{2}", word, isStep ? "step" : "command",
                        meant.empty() ? fmt::format("; there are {}", fmt::join(names, ", ")) : meant)};
}

/// `pacini help`: explains the commands and their options.
struct HelpCommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        program = &app;
        auto* command = app.add_subcommand("help", "Explain a command");
        addOption(*command, "command", topic, "Command, and a step of it if it has steps [a summary of all commands]",
                  "COMMAND");
        return command->footer("Examples:\n  pacini help encode\n  pacini help measure fit");
    }

    Exit run(Console& console) override
    {
        const CommandText tree = commandTree(*program);
        const CommandText* command = commandNamed(tree, fmt::format("{}", fmt::join(topic, " ")));
        if (command == nullptr)
            return console.fail("", unknownCommand(tree, topic), Exit::usage);
        const std::string text = helpText(*command, terminal::textWidth());
        return console.printText(text);
    }

    const CLI::App* program = nullptr;
    std::vector<std::string> topic;
};
} // namespace

std::unique_ptr<Command> helpCommand()
{
    return std::make_unique<HelpCommand>();
}

} // namespace pacini::cli
