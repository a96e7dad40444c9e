#pragma once

// Subcommand that fits an equaliser to a measured response.

#include "cli/Command.h"

#include <pacini/linearize/EqualizerFitParams.h>

#include <optional>
#include <string>

namespace pacini::cli
{

/// `pacini measure fit`: the equaliser that flattens a measured response.
class FitSubcommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    Result<std::size_t> drawPicture(const FrequencyResponse& response, const EqualizerFit& fit,
                                    const EqualizerFitParams& params) const;

    std::string input;
    std::string output;
    std::string base;
    std::string picture;
    std::string sections = "auto";
    double rate = 48000.0;
    double maxBoost = 12.0;
    double goal = 2.0;
    std::optional<double> low;
    std::optional<double> high;
    std::optional<double> highpass;
    bool boostOutside = false;
    bool peaksOnly = false;
};

} // namespace pacini::cli
