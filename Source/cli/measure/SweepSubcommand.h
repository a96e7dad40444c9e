#pragma once

// Subcommand that writes a measurement sweep.

#include "cli/Command.h"
#include "cli/Overwrite.h"

#include <pacini/linearize/Sweep.h>

#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// `pacini measure sweep`: the sound to play on an actuator, and beside it what it was.
class SweepSubcommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    CLI::Option* outputOption = nullptr;
    std::string output = "sweep.wav";
    std::string profile;
    std::optional<double> low;
    double high = 1500.0;
    double duration = 20.0;
    double pause = 1.0;
    int repeats = 1;
    std::vector<double> levels = SweepParams().levels;
    int rate = 48000;
    OverwriteOptions overwriting;
};

} // namespace pacini::cli
