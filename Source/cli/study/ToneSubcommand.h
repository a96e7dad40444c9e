#pragma once

// Step of `pacini study` for the level of sounds.

#include "cli/Command.h"

#include <memory>

namespace pacini::cli
{

[[nodiscard]] std::unique_ptr<Command> toneStudySubcommand();

} // namespace pacini::cli
