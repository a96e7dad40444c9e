#include "cli/UsageText.h"

#include "cli/CommandTree.h"
#include "io/NearestName.h"

#include <fmt/format.h>

#include <vector>

namespace pacini::cli
{

namespace
{
const CLI::App& chosenCommand(const CLI::App& app)
{
    const CLI::App* chosen = &app;
    while (!chosen->get_subcommands().empty())
        chosen = chosen->get_subcommands().front();
    return *chosen;
}

/// The names of the commands below, or of the steps of a command.
std::vector<std::string> commandNames(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands(nullptr))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> optionNames(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

/// A command or a step is missing, or is none.
std::string missingCommand(const CLI::App& app)
{
    const std::string kind = app.get_parent() == nullptr ? "command" : "step";
    const auto names = commandNames(app);
    const auto rest = app.remaining(true);
    const std::string all = fmt::format("; there are {}", fmt::join(names, ", "));
    if (rest.empty())
        return fmt::format("a {} is missing{}", kind, all);
    if (rest.front().starts_with('-'))
        return fmt::format("unknown option {}{}", rest.front(), meantText(rest.front(), optionNames(app)));
    const std::string meant = meantText(rest.front(), names);
    return fmt::format("unknown {1} '{0}'{2}", rest.front(), kind, meant.empty() ? all : meant);
}

/// The first word that was not understood and looks like an option; empty when there is none.
std::string unknownOption(const std::vector<std::string>& words)
{
    for (const std::string& word : words)
        if (word.starts_with('-') && word.size() > 1)
            return word.substr(0, word.find('='));
    return "";
}

/// More than is asked for, behind the command `chosen` or before it.
std::string surplus(const CLI::App& program, const CLI::App& chosen)
{
    const auto words = chosen.remaining(true);
    if (const std::string name = unknownOption(words); !name.empty())
        return fmt::format("unknown option {} of '{}'{}", name, commandPath(program),
                           meantText(name, optionNames(chosen)));
    if (const std::string name = unknownOption(program.remaining(true)); !name.empty())
        return fmt::format("unknown option {}{}", name, meantText(name, optionNames(program)));
    return fmt::format("unexpected argument '{}'", words.empty() ? "" : words.front());
}

/// What must be there and is not.
std::string missingArgument(const std::string& what, const CLI::App& app)
{
    const std::string name = what.substr(0, what.find(' '));
    for (const CLI::Option* option : app.get_options())
        if (option->get_name() == name && option->get_positional() && optionText(*option).choices.empty())
            return "the input file is missing";
    return name + " is missing";
}

/// The option that the message of an error starts with, such as "--bands: ..."; nothing when it does not.
const CLI::Option* optionIn(const std::string& message, const CLI::App& app)
{
    const std::string name = message.substr(0, message.find(':'));
    for (const CLI::Option* option : app.get_options())
        if (option->get_name() == name || option->check_name(name))
            return option;
    return nullptr;
}

std::string wrongCount(const CLI::ParseError& error, const CLI::App& app)
{
    const std::string what = error.what();
    const CLI::Option* option = optionIn(what, app);
    if (option == nullptr)
        return what;
    if (what.ends_with("missing"))
        return fmt::format("{}: a value is missing", option->get_name());
    return fmt::format("{} is given more than once", option->get_name());
}

std::string whatIsWrong(const CLI::ParseError& error, const CLI::App& program)
{
    const CLI::App& app = chosenCommand(program);
    const std::string what = error.what();
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    {
        if (!commandNames(app).empty())
            return missingCommand(app);
        // A word that was not understood explains more than what is missing without it.
        return unknownOption(app.remaining(true)).empty() ? missingArgument(what, app) : surplus(program, app);
    }
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
        return surplus(program, app);
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
        return wrongCount(error, app);
    if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr)
    {
        const auto gap = what.find(" requires ");
        return gap == std::string::npos ? what : what.substr(0, gap) + " needs " + what.substr(gap + 10);
    }
    return what;
}
} // namespace

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

std::string usageText(const CLI::ParseError& error, const CLI::App& app)
{
    const std::string path = commandPath(app);
    const std::string what = (path.empty() ? "" : path + ": ") + whatIsWrong(error, app);
    return what.ends_with('?') ? what : fmt::format("{}; try 'pacini {}{}--help'", what, path, path.empty() ? "" : " ");
}

} // namespace pacini::cli
