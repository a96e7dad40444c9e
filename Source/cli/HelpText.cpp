#include "cli/HelpText.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr std::size_t column = 28; ///< where descriptions start

/// A name with its description beside it, wrapped; below it where the name is too long.
std::string entry(const std::string& name, const std::string& description, std::size_t width)
{
    std::string text = "  " + name;
    std::size_t used = text.size();
    if (used + 2 > column)
    {
        text += "\n";
        used = 0;
    }
    text += std::string(column - used, ' ');
    used = column;
    bool first = true;
    for (std::size_t start = 0; start < description.size();)
    {
        const std::size_t end = std::min(description.find(' ', start), description.size());
        const std::string word = description.substr(start, end - start);
        if (!first && used + 1 + word.size() > width)
        {
            text += "\n" + std::string(column, ' ');
            used = column;
            first = true;
        }
        text += (first ? "" : " ") + word;
        used += word.size() + (first ? 0 : 1);
        first = false;
        start = end + 1;
    }
    return text + "\n";
}

std::string termOf(const OptionText& option)
{
    std::string text;
    for (const std::string& name : option.names)
        text += (text.empty() ? (name.starts_with("--") ? "    " : "") : ", ") + name;
    if (!option.value.empty())
        text += (text.empty() ? "" : " ") + option.value;
    return text;
}

/// The options below the headings of their groups, in the order in which those first come.
std::string optionList(const CommandText& command, std::size_t width)
{
    std::vector<std::string> groups{""};
    for (const OptionText& option : command.options)
        if (std::find(groups.begin(), groups.end(), option.group) == groups.end())
            groups.push_back(option.group);
    std::string text;
    for (const std::string& group : groups)
    {
        text += group.empty() ? "\nOptions (defaults in brackets):\n" : fmt::format("\n{}:\n", group);
        for (const OptionText& option : command.options)
            if (option.group == group)
                text += entry(termOf(option), wholeDescription(option), width);
    }
    return text;
}

std::string commandList(const CommandText& command, std::size_t width)
{
    std::string text;
    for (const CommandText& step : command.commands)
        text += entry(step.name.substr(step.name.rfind(' ') + 1), step.summary, width);
    return text;
}
} // namespace

std::string helpText(const CommandText& command, std::size_t width)
{
    std::string text = fmt::format("{}\n\nUsage: {}\n", command.summary, synopsis(command));
    if (!command.commands.empty())
        text += fmt::format("\n{}:\n{}", command.name.empty() ? "Commands" : "Steps", commandList(command, width));
    if (!command.arguments.empty())
        text += "\nArguments:\n";
    for (const OptionText& argument : command.arguments)
        text += entry(termOf(argument), wholeDescription(argument), width);
    text += optionList(command, width);
    if (!command.notes.empty())
        text += "\n" + command.notes + "\n";
    text.pop_back();
    return text;
}

std::string shortHelp(const CommandText& program)
{
    return fmt::format("{}\n\nUsage: {}\n\n{}\n'pacini help COMMAND' explains a command, 'pacini help' shows examples.",
                       program.summary, synopsis(program), commandList(program, 100));
}

} // namespace pacini::cli
