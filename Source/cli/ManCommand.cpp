// Subcommand that prints the manual page.

#include "cli/Command.h"
#include "cli/CommandTree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

namespace pacini::cli
{

namespace
{
/// Text that roff prints as it is, which may start a line.
std::string plain(std::string_view text)
{
    std::string escaped = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
    for (const char c : text)
        if (c == '\\')
            escaped += "\\e";
        else if (c == '-')
            escaped += "\\-";
        else
            escaped += c;
    return escaped;
}

std::string upperCase(std::string text)
{
    for (char& c : text)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string optionItem(const OptionText& option)
{
    std::string term;
    for (const std::string& name : option.names)
        term += (term.empty() ? "\\fB" : ", \\fB") + plain(name) + "\\fR";
    if (!option.value.empty())
        term += (term.empty() ? "\\fI" : " \\fI") + plain(option.value) + "\\fR";
    return fmt::format(".TP\n{}\n{}\n", term, plain(wholeDescription(option)));
}

/// Lines as they are: notes are laid out by hand.
std::string literal(const std::string& notes)
{
    std::string text = ".PP\n.nf\n";
    for (std::size_t start = 0; start < notes.size();)
    {
        const std::size_t end = std::min(notes.find('\n', start), notes.size());
        text += plain(std::string_view(notes).substr(start, end - start)) + "\n";
        start = end + 1;
    }
    return text + ".fi\n";
}

/// Options that every command has are explained once.
bool isCommon(const OptionText& option)
{
    const std::string& name = option.names.back();
    return name == "--help" || name == "--quiet" || name == "--json" || name == "--strict";
}

std::string commandSection(const CommandText& command)
{
    std::string text = fmt::format(".SS \"{}\"\n{}.\n.PP\n.B {}\n", plain("pacini " + command.name),
                                   plain(command.summary), plain(synopsis(command)));
    for (const OptionText& argument : command.arguments)
        text += optionItem(argument);
    for (const OptionText& option : command.options)
        if (!isCommon(option))
            text += optionItem(option);
    if (!command.notes.empty())
        text += literal(command.notes);
    for (const CommandText& step : command.commands)
        text += commandSection(step);
    return text;
}

std::string manualPage(const CommandText& program)
{
    std::string text = fmt::format(".TH {} 1 \"\" \"pacini {}\" \"User commands\"\n"
                                   ".SH NAME\npacini \\- sound to touch\n"
                                   ".SH SYNOPSIS\n.B pacini\n.I COMMAND\n[\\fIOPTIONS\\fR] ...\n"
                                   ".SH DESCRIPTION\n{}\n"
                                   "Defaults are in brackets after the description of an option.\n"
                                   ".SH OPTIONS\nOf every command:\n",
                                   upperCase("pacini"), PACINI_VERSION, plain(program.summary));
    for (const OptionText& option : program.options)
        text += optionItem(option);
    text += ".SH COMMANDS\n";
    for (const CommandText& command : program.commands)
        text += commandSection(command);
    text += ".SH \"EXIT STATUS\"\n"
            ".TP\n0\nSuccess.\n"
            ".TP\n1\nAn input or an output failed; messages on standard error name it.\n"
            ".TP\n2\nThe command line could not be understood.\n"
            ".SH NOTES\n"
            "With\n.B \\-\\-json\nevery command prints one object, on success and on failure; "
            "pacini.report.schema.json describes it.\n"
            "Files are written under temporary names and renamed when complete.\n";
    return text;
}

/// `pacini man`: prints the manual page, made from the declarations of the commands.
struct ManCommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        program = &app;
        auto* command = app.add_subcommand("man", "Print the manual page");
        return command->footer("Examples:\n  pacini man > pacini.1 && man -l pacini.1\n"
                               "  pacini man > ~/.local/share/man/man1/pacini.1      for 'man pacini'");
    }

    Exit run(Console& console) override
    {
        std::string text = manualPage(commandTree(*program));
        text.pop_back();
        return console.printText(text);
    }

    const CLI::App* program = nullptr;
};
} // namespace

std::unique_ptr<Command> manCommand()
{
    return std::make_unique<ManCommand>();
}

} // namespace pacini::cli
