#pragma once

#include "cli/Command.h"

#include <string>

namespace pacini::cli
{

/// `pacini convert`: one clip format becomes another.
class ConvertCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    std::string input;
    std::string output;
    std::string format;
    int quantise = 0;
    bool json = false;
};

} // namespace pacini::cli
