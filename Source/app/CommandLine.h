// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Command-line parsing for the programs with a window: --help, --version and wrong usage.

#include <CLI/CLI.hpp>
#include <juce_core/juce_core.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace pacini::app
{

/// Sets the values described by `options`. Returns an exit code if the program has to end: 0 after help or the version,
/// 2 after wrong usage, both with a text on the terminal. [message]
[[nodiscard]] inline std::optional<int> readCommandLine(CLI::App& options, const std::string& version,
                                                        const juce::StringArray& arguments)
{
    options.set_version_flag("--version", version, "Print the version and exit");
#if JUCE_MAC
    options.allow_extras(); // the system adds some of its own
#endif
    std::vector<std::string> words;
    for (const juce::String& argument : arguments)
        words.push_back(argument.unquoted().toStdString());
    std::reverse(words.begin(), words.end()); // as CLI11 takes them
    try
    {
        options.parse(std::move(words));
        return std::nullopt;
    }
    catch (const CLI::ParseError& problem)
    {
        return options.exit(problem) == 0 ? 0 : 2;
    }
}

} // namespace pacini::app
