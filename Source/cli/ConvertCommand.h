#pragma once

#include "cli/Command.h"

#include <string>

namespace pacini::cli
{

/// `pacini convert`: one format of clips, or of profiles, becomes another.
class ConvertCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    Exit convertClip(Console& console);
    Exit convertProfile(Console& console);
    /// Whether output would overwrite input, which is said.
    bool overwritesInput(Console& console) const;

    std::string input;
    std::string output;
    std::string format;
    int quantise = 0;
    bool json = false;
};

} // namespace pacini::cli
