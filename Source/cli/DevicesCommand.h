#pragma once

// Subcommand that lists the connected haptic devices.

#include "cli/Command.h"

namespace pacini::cli
{

/// `pacini devices`: the connected game controllers that can play haptics.
class DevicesCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
};

} // namespace pacini::cli
