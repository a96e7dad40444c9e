#pragma once

// Subcommand that describes files.

#include "cli/Command.h"

#include <string>
#include <vector>

namespace pacini::cli
{

/// `pacini info`: what a clip, a scene, a sound file or a profile holds.
class InfoCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    std::vector<std::string> inputs;
    std::string clipFolder;
};

} // namespace pacini::cli
