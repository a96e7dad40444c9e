#pragma once

// Commands and options as declared, as a tree from which help, the manual page and completions are made.

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace pacini::cli
{

/// An option, or an argument without a name.
struct OptionText
{
    std::vector<std::string> names;   ///< such as "-o" and "--output"; none for an argument
    std::string value;                ///< placeholder of its value, such as "HZ"; empty for a flag
    std::string description;          ///< one line
    std::string range;                ///< such as "1 to 32"; empty when it has none or choices
    std::vector<std::string> choices; ///< the only values, if they are few
    std::string preset;               ///< the value without the option; empty when the description says it
    std::string with;                 ///< the option that it needs, if any
    std::string group;                ///< heading in help texts; empty: none of its own
    bool required = false;
    bool several = false; ///< may be given several times or with several values
};

/// A command, or a step of one.
struct CommandText
{
    std::string name; ///< as typed after "pacini", such as "measure fit"; empty for the program
    std::string summary;
    std::string notes; ///< text after the options: explanations and examples, in lines
    std::vector<OptionText> arguments;
    std::vector<OptionText> options;
    std::vector<CommandText> commands;
};

/// The help text of one option.
[[nodiscard]] OptionText optionText(const CLI::Option& option);

/// All that is below `app`.
[[nodiscard]] CommandText commandTree(const CLI::App& app);

/// The part of `tree` with that name; nothing when there is none.
[[nodiscard]] const CommandText* commandNamed(const CommandText& tree, const std::string& name);

/// The usage line, such as "pacini encode [OPTIONS] [IN...]".
[[nodiscard]] std::string synopsis(const CommandText& command);

/// The description with range, choices and preset, in one line.
[[nodiscard]] std::string wholeDescription(const OptionText& option);

} // namespace pacini::cli
