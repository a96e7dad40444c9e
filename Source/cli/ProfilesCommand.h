#pragma once

// Subcommand that lists the shipped actuator profiles.

#include "cli/Command.h"

namespace pacini::cli
{

/// `pacini profiles`: the actuators that come with Pacini.
class ProfilesCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
};

} // namespace pacini::cli
