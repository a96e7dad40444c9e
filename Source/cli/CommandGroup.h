#pragma once

// Command that consists of steps, such as `pacini measure`.

#include "cli/Command.h"

#include <memory>
#include <string>
#include <vector>

namespace pacini::cli
{

/// The command `name`, which runs the one of its steps that was chosen; they are listed in this order.
[[nodiscard]] std::unique_ptr<Command> commandGroup(std::string name, std::string description,
                                                    std::vector<std::unique_ptr<Command> (*)()> steps,
                                                    std::string footer);

} // namespace pacini::cli
