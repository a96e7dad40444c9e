#pragma once

// Subcommand that compares haptic signals with the sounds they were made from.

#include "cli/Command.h"

#include <string>

namespace pacini::cli
{

/// `pacini compare`: how much of a sound a haptic signal keeps.
class CompareCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    std::string reference;
    std::string candidate;
    std::string onsets;
    std::string events;
    unsigned jobs = 0;
    bool allowTruncated = false;
};

} // namespace pacini::cli
