#pragma once

#include "cli/Command.h"

#include <pacini/analysis/Encoder.h>

#include <string>
#include <vector>

namespace pacini::cli
{

/// `pacini encode`: recordings become clips.
class EncodeCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    std::vector<std::string> inputs;
    std::string output;
    std::string format;
    EncoderParams params;
    std::string spacing = "log";
    bool keepLevel = false;
    bool allowNan = false;
    bool allowTruncated = false;
    bool force = false;
    bool json = false;
    unsigned jobs = 0;
};

} // namespace pacini::cli
