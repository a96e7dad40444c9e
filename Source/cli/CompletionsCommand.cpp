// Subcommand that prints shell completions.

#include "cli/Command.h"
#include "cli/CommandTree.h"
#include "cli/Options.h"
#include "cli/ProgramFolder.h"
#include "io/ShippedProfiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::cli
{

namespace
{
/// Completions for the value of an option.
struct Values
{
    std::vector<std::string> words;
    bool files = false;
    bool folders = false;
};

Values valuesOf(const OptionText& option)
{
    if (option.value.empty() || !option.range.empty())
        return {};
    if (!option.choices.empty())
        return {option.choices, false, false};
    Values values;
    for (const char* kind : {"IN", "OUT", "FILE", "CLIP", "REF", "CAND", "PROFILE", "PICTURE", "RESPONSE", "SWEEP",
                             "RECORDING", ".wav", ".json"})
        values.files = values.files || option.value.find(kind) != std::string::npos;
    values.folders = !values.files && option.value.find("DIR") != std::string::npos;
    if (option.value.ends_with("PROFILE"))
        for (const ShippedProfile& profile : shippedProfiles(programFolder()))
            values.words.push_back(profile.name);
    return values;
}

/// `tree` and all that is below it.
std::vector<const CommandText*> allIn(const CommandText& tree)
{
    std::vector<const CommandText*> all{&tree};
    for (const CommandText& command : tree.commands)
        for (const CommandText* inner : allIn(command))
            all.push_back(inner);
    return all;
}

std::string lastWord(const std::string& name)
{
    return name.substr(name.rfind(' ') + 1);
}

std::string optionWords(const CommandText& command)
{
    std::string words;
    for (const OptionText& option : command.options)
        for (const std::string& name : option.names)
            words += (words.empty() ? "" : " ") + name;
    return words;
}

std::string commandWords(const CommandText& command)
{
    std::string words;
    for (const CommandText& inner : command.commands)
        words += (words.empty() ? "" : " ") + lastWord(inner.name);
    return words;
}

/// The choices of an argument that comes first, such as the shell of this command.
std::string argumentWords(const CommandText& command)
{
    std::string words;
    for (const OptionText& argument : command.arguments)
        words += (words.empty() ? "" : " ") + fmt::format("{}", fmt::join(valuesOf(argument).words, " "));
    return words;
}

bool takesFiles(const CommandText& command)
{
    bool takes = false;
    for (const OptionText& argument : command.arguments)
        takes = takes || valuesOf(argument).files;
    return takes;
}

std::string bashScript(const CommandText& program)
{
    std::string commands, own, values;
    for (const CommandText* command : allIn(program))
    {
        const std::string& name = command->name;
        const auto gap = name.rfind(' ');
        if (!name.empty())
            commands += fmt::format("            '{} {}') command='{}' ;;\n",
                                    gap == std::string::npos ? "" : name.substr(0, gap), lastWord(name), name);
        std::string words = commandWords(*command);
        words += (words.empty() || argumentWords(*command).empty() ? "" : " ") + argumentWords(*command);
        if (name == "help")
            words = commandWords(program);
        own += fmt::format("        '{}') words='{}' options='{}' files={} ;;\n", name, words, optionWords(*command),
                           takesFiles(*command) ? 1 : 0);
        for (const OptionText& option : command->options)
        {
            if (option.value.empty())
                continue;
            std::string names;
            for (const std::string& optionName : option.names)
                names += fmt::format("{}'{} {}'", names.empty() ? "" : "|", name, optionName);
            const Values taken = valuesOf(option);
            values += fmt::format("        {}) words='{}' options='' files={} ;;\n", names, fmt::join(taken.words, " "),
                                  taken.files     ? 1
                                  : taken.folders ? 2
                                                  : 0);
        }
    }
    return fmt::format(R"(# Completion of pacini {0} for bash, by 'pacini completions bash'.
_pacini()
{{
    local current="${{COMP_WORDS[COMP_CWORD]}}" previous="${{COMP_WORDS[COMP_CWORD-1]}}"
    local command='' words='' options='' files=0 i
    if [[ $current == '=' ]]; then
        current=''
    elif [[ $previous == '=' ]]; then
        previous="${{COMP_WORDS[COMP_CWORD-2]}}"
    fi
    for ((i = 1; i < COMP_CWORD; i++)); do
        case "$command ${{COMP_WORDS[i]}}" in
{1}        esac
    done
    case "$command" in
{2}    esac
    case "$command $previous" in
{3}    esac
    [[ $current == -* ]] && words="$words $options"
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    if ((files == 1)); then
        mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -f -- "$current")
    elif ((files == 2)); then
        mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -d -- "$current")
    fi
}}
complete -o filenames -F _pacini pacini)",
                       PACINI_VERSION, commands, own, values);
}

/// Between single quotes of a shell.
std::string shellQuoted(std::string_view text)
{
    std::string inside;
    for (const char c : text)
        inside += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return "'" + inside + "'";
}

/// A description within a specification of zsh, where brackets and colons mean something.
std::string zshText(std::string_view text)
{
    std::string escaped;
    for (const char c : text)
        escaped += c == '[' || c == ']' || c == ':' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return escaped;
}

std::string zshAction(const OptionText& option)
{
    const Values values = valuesOf(option);
    if (values.files && !values.words.empty())
        return fmt::format("{{_files; compadd -- {}}}", fmt::join(values.words, " "));
    if (!values.words.empty())
        return fmt::format("({})", fmt::join(values.words, " "));
    return values.files ? "_files" : values.folders ? "_files -/" : " ";
}

std::string zshFunction(const CommandText& command)
{
    std::string specs;
    for (const OptionText& option : command.options)
        for (const std::string& name : option.names)
        {
            const std::string others = option.several ? "*" : fmt::format("({})", fmt::join(option.names, " "));
            std::string spec = fmt::format("{}{}[{}]", others, name, zshText(option.description));
            if (!option.value.empty())
                spec += fmt::format(":{}:{}", zshText(option.value), zshAction(option));
            specs += " \\\n        " + shellQuoted(spec);
        }
    std::string function = command.name;
    for (char& c : function)
        c = c == ' ' ? '-' : c;
    function = "_pacini" + (function.empty() ? "" : "-" + function);
    if (command.commands.empty())
    {
        std::size_t number = 0;
        for (const OptionText& argument : command.arguments)
            specs += " \\\n        " +
                     shellQuoted(fmt::format("{}:{}:{}", argument.several ? "*" : fmt::format("{}", ++number),
                                             zshText(argument.value), zshAction(argument)));
        return fmt::format("{}()\n{{\n    _arguments -s{}\n}}\n", function, specs);
    }
    std::string inner, described;
    for (const CommandText& step : command.commands)
    {
        std::string name = step.name;
        for (char& c : name)
            c = c == ' ' ? '-' : c;
        inner += fmt::format("            {}) _pacini-{} ;;\n", lastWord(step.name), name);
        described += " \\\n            " + shellQuoted(lastWord(step.name) + ":" + zshText(step.summary));
    }
    return fmt::format("{0}()\n{{\n    local state line\n    _arguments -C{1} \\\n        '1: :->command' "
                       "'*:: :->rest'\n    case $state in\n    command)\n        local -a commands=({2})\n        "
                       "_describe command commands ;;\n    rest)\n        case $line[1] in\n{3}        esac ;;\n    "
                       "esac\n}}\n",
                       function, specs, described, inner);
}

std::string zshScript(const CommandText& program)
{
    std::string text = fmt::format("#compdef pacini\n# Completion of pacini {} for zsh, by 'pacini completions zsh'.\n",
                                   PACINI_VERSION);
    for (const CommandText* command : allIn(program))
        text += zshFunction(*command);
    return text + "if [ \"$funcstack[1]\" = _pacini ]; then\n    _pacini \"$@\"\nelse\n    compdef _pacini pacini\nfi";
}

/// When a command was chosen, in fish: its words were seen and, of a command with steps, none of these.
std::string fishCondition(const CommandText& command)
{
    if (command.name.empty())
        return "__fish_use_subcommand";
    std::string condition;
    for (std::size_t start = 0; start < command.name.size();)
    {
        const std::size_t end = std::min(command.name.find(' ', start), command.name.size());
        condition += (condition.empty() ? "" : "; and ") +
                     fmt::format("__fish_seen_subcommand_from {}", command.name.substr(start, end - start));
        start = end + 1;
    }
    if (!command.commands.empty())
        condition += fmt::format("; and not __fish_seen_subcommand_from {}", commandWords(command));
    return condition;
}

std::string fishScript(const CommandText& program)
{
    std::string text = fmt::format("# Completion of pacini {} for fish, by 'pacini completions fish'.\n"
                                   "complete -c pacini -f\n",
                                   PACINI_VERSION);
    for (const CommandText* command : allIn(program))
    {
        const std::string start = "complete -c pacini -n " + shellQuoted(fishCondition(*command));
        for (const CommandText& inner : command->commands)
            text += fmt::format("{} -a {} -d {}\n", start, lastWord(inner.name), shellQuoted(inner.summary));
        for (const OptionText& argument : command->arguments)
        {
            const Values values = valuesOf(argument);
            if (values.files)
                text += start + " -F\n";
            if (!values.words.empty())
                text += fmt::format("{} -a {}\n", start, shellQuoted(fmt::format("{}", fmt::join(values.words, " "))));
        }
        for (const OptionText& option : command->options)
        {
            std::string line = start;
            for (const std::string& name : option.names)
                line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.value.empty())
            {
                const Values values = valuesOf(option);
                line += values.files || values.folders ? " -r -F" : " -x";
                if (!values.words.empty())
                    line += " -a " + shellQuoted(fmt::format("{}", fmt::join(values.words, " ")));
            }
            text += fmt::format("{} -d {}\n", line, shellQuoted(option.description));
        }
    }
    text.pop_back();
    return text;
}

/// `pacini completions`: prints shell scripts that complete commands, options and their values.
struct CompletionsCommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        program = &app;
        auto* command = app.add_subcommand("completions", "Print the completion script of a shell");
        addOption(*command, "shell", shell, "Which shell", oneOf({"bash", "zsh", "fish"}), "SHELL")->required();
        return command->footer("Examples:\n"
                               "  pacini completions bash > ~/.local/share/bash-completion/completions/pacini\n"
                               "  pacini completions zsh > ~/.zfunc/_pacini                  a folder of $fpath\n"
                               "  pacini completions fish > ~/.config/fish/completions/pacini.fish");
    }

    Exit run(Console& console) override
    {
        const CommandText tree = commandTree(*program);
        const std::string text = shell == "bash"  ? bashScript(tree)
                                 : shell == "zsh" ? zshScript(tree)
                                                  : fishScript(tree);
        return console.printText(text);
    }

    const CLI::App* program = nullptr;
    std::string shell;
};
} // namespace

std::unique_ptr<Command> completionsCommand()
{
    return std::make_unique<CompletionsCommand>();
}

} // namespace pacini::cli
