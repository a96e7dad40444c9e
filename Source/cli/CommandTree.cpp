#include "cli/CommandTree.h"

#include <fmt/format.h>

namespace pacini::cli
{

namespace
{
/// What stands for a value of a type that no name was given.
std::string valueName(const std::string& type)
{
    if (type == "TEXT")
        return "NAME";
    if (type == "FLOAT")
        return "X";
    return type == "INT" || type == "UINT" ? "N" : type;
}

std::vector<std::string> choicesIn(const std::string& set)
{
    std::vector<std::string> choices;
    for (std::size_t start = 1; start < set.size();)
    {
        const std::size_t end = set.find_first_of(",}", start);
        choices.push_back(set.substr(start, end - start));
        start = end + 1;
    }
    return choices;
}

/// A list of numbers as it is typed: without brackets.
std::string presetText(std::string preset)
{
    if (preset.starts_with('[') && preset.ends_with(']'))
        preset = preset.substr(1, preset.size() - 2);
    return preset;
}

std::string listed(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

CommandText commandText(const CLI::App& app, const std::string& name)
{
    CommandText text{name, app.get_description(), app.get_footer(), {}, {}, {}};
    for (const CLI::Option* option : app.get_options())
        (option->get_positional() ? text.arguments : text.options).push_back(optionText(*option));
    for (const CLI::App* command : app.get_subcommands(nullptr))
        text.commands.push_back(commandText(*command, name + (name.empty() ? "" : " ") + command->get_name()));
    return text;
}
} // namespace

OptionText optionText(const CLI::Option& option)
{
    OptionText text;
    for (const std::string& name : option.get_snames())
        text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        text.names.push_back("--" + name);
    text.description = option.get_description();
    text.required = option.get_required();
    text.several = option.get_items_expected_max() > 1;
    if (option.get_group() != CLI::OptionDefaults().get_group())
        text.group = option.get_group();
    for (const CLI::Option* other : option.get_needs())
        text.with = other->get_name();
    if (option.get_items_expected_max() == 0)
        return text;
    const std::string type = option.get_type_name(); // VALUE:CHECK, where VALUE may be NAME:SIZE
    std::size_t end = type.find(':');
    while (end != std::string::npos && end + 1 < type.size() && type[end + 1] >= 'A' && type[end + 1] <= 'Z')
        end = type.find(':', end + 1);
    const std::string check = end == std::string::npos ? "" : type.substr(end + 1);
    text.value = valueName(type.substr(0, end));
    if (check.starts_with('{'))
        text.choices = choicesIn(check);
    else
        text.range = check;
    text.preset = presetText(option.get_default_str());
    return text;
}

CommandText commandTree(const CLI::App& app)
{
    return commandText(app, "");
}

const CommandText* commandNamed(const CommandText& tree, const std::string& name)
{
    if (tree.name == name)
        return &tree;
    for (const CommandText& command : tree.commands)
        if (const CommandText* found = commandNamed(command, name))
            return found;
    return nullptr;
}

std::string synopsis(const CommandText& command)
{
    std::string text = "pacini" + (command.name.empty() ? "" : " " + command.name);
    if (!command.commands.empty())
        return text + (command.name.empty() ? " COMMAND ..." : " STEP ...");
    for (const OptionText& option : command.options)
        if (option.required)
            text += fmt::format(" {} {}", option.names.back(), option.value);
    text += " [OPTIONS]";
    for (const OptionText& argument : command.arguments)
    {
        const std::string value =
            argument.value + (argument.several && argument.value.find("...") == std::string::npos ? "..." : "");
        text += argument.required ? " " + value : " [" + value + "]";
    }
    return text;
}

std::string wholeDescription(const OptionText& option)
{
    // What is taken without the option comes last, also where the description says it.
    const std::size_t last = option.description.ends_with(']') ? option.description.rfind(" [") : std::string::npos;
    std::string text = option.description.substr(0, last);
    const std::string limits = option.choices.empty() ? option.range : listed(option.choices);
    // Few names are best in the sentence itself, which may explain them.
    bool said = !option.choices.empty();
    for (const std::string& choice : option.choices)
        said = said && option.description.find(choice) != std::string::npos;
    if (!limits.empty() && !said)
        text += option.choices.empty() ? " (" + limits + ")" : ": " + limits;
    if (!option.with.empty() && option.description.find(option.with) == std::string::npos)
        text += fmt::format("; needs {}", option.with);
    if (option.required && !option.names.empty())
        text += " (required)";
    if (last != std::string::npos)
        text += option.description.substr(last);
    else if (!option.preset.empty())
        text += fmt::format(" [{}]", option.preset);
    return text;
}

} // namespace pacini::cli
