#pragma once

// Subcommand that analyses recordings of sweeps.

#include "cli/Command.h"
#include "cli/measure/Recording.h"

#include <pacini/linearize/ResponseFeatures.h>

#include <string>

namespace pacini::cli
{

/// `pacini measure analyse`: what recordings of a sweep tell of an actuator.
class AnalyseSubcommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    Result<std::size_t> drawPicture(const AnalysedRecordings& analysed, const ResponseFeatures& features) const;

    RecordingOptions options;
    std::string output;
    std::string base;
    std::string name;
    std::string picture;
    double distortionLimit = 10.0;
};

} // namespace pacini::cli
