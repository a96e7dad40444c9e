#pragma once

// Subcommand that simulates the recording of a sweep.

#include "cli/Command.h"
#include "cli/Overwrite.h"

#include <cstdint>
#include <string>

namespace pacini::cli
{

/// `pacini measure simulate`: what an accelerometer on a worn actuator would record, to learn and to test by.
class SimulateSubcommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    std::string input;
    std::string output;
    std::string profile = "l5-wristband";
    unsigned wearer = 0;
    unsigned wearers = 0;
    double contact = 0.0;
    double latency = 12.0;
    double drift = 50.0;
    double noise = 250.0;
    double distortion = 0.0;
    double range = 5.0; ///< g, of the ADXL325
    int axes = 3;
    int bits = 12;
    std::uint64_t seed = 1;
    OverwriteOptions overwriting;
};

} // namespace pacini::cli
