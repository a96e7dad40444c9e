#pragma once

// Command group for the measurement of actuators.

#include "cli/Command.h"

#include <memory>
#include <vector>

namespace pacini::cli
{

/// `pacini measure`: from a sweep to an actuator that is flat, step by step.
class MeasureCommand : public Command
{
public:
    MeasureCommand();
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    std::vector<std::unique_ptr<Command>> steps;
    std::vector<CLI::App*> declared;
};

} // namespace pacini::cli
