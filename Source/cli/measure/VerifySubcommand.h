#pragma once

// Subcommand that verifies an equaliser by a sweep through it.

#include "cli/Command.h"
#include "cli/measure/Recording.h"

#include <optional>
#include <string>

namespace pacini::cli
{

/// `pacini measure verify`: whether an actuator is flat through its equaliser.
class VerifySubcommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    RecordingOptions options;
    std::string profile;
    std::string output;
    std::string picture;
    std::optional<double> low;
    std::optional<double> high;
    double tolerance = 4.0;
};

} // namespace pacini::cli
