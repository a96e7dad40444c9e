#pragma once

// Command that consists of steps, such as `pacini measure`.

#include "cli/Command.h"

#include <memory>
#include <utility>
#include <vector>

namespace pacini::cli
{

/// Runs the one of its steps that was chosen.
class CommandGroup : public Command
{
public:
    Exit run(Console& console) override
    {
        for (const auto& [step, declared] : steps)
            if (declared->parsed())
                return step->run(console);
        return Exit::usage;
    }

protected:
    /// Declares a step below `command`.
    void addStep(CLI::App& command, std::unique_ptr<Command> step)
    {
        auto* declared = step->declare(command);
        steps.emplace_back(std::move(step), declared);
    }

private:
    std::vector<std::pair<std::unique_ptr<Command>, CLI::App*>> steps;
};

} // namespace pacini::cli
