#pragma once

// Subcommand that renders clips and scenes.

#include "cli/Command.h"
#include "cli/InputFiles.h"
#include "cli/Overwrite.h"

#include <pacini/synthesis/ClipAdaptation.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// `pacini render`: clips and scenes become drive signals, or what is felt of them.
class RenderCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    /// The clips and scenes to render. Of a folder those of other programs only where no clip of Pacini's has the same
    /// name, which they are then an export of.
    [[nodiscard]] InputFiles findClips() const;

    /// All options that change what is written.
    [[nodiscard]] std::string record() const;

    CLI::App* command = nullptr;
    std::vector<std::string> inputs;
    std::string output;
    std::string profile;
    double rate = 48000.0;
    std::string encoding = "float32";
    std::string carriers = "auto";
    std::string envelope = "auto";
    std::string pulse = "auto";
    double pulseFrequency = 0.0;
    double pulseCycles = 1.0;
    std::uint64_t seed = 0;
    double variation = 0.0;
    std::string variationPer = "breakpoint";
    double transpose = 0.0;
    double stretch = 1.0;
    double gain = 0.0;
    double delay = 0.0;
    double from = 0.0;
    std::optional<double> to;
    bool dryRun = false;
    double tolerance = -60.0;
    std::string clipFolder;
    double feltFullScale = 100.0;
    unsigned wearer = 0;
    unsigned jobs = 0;
    bool felt = false;
    bool everything = false;
    bool noAdaptation = false;
    std::string mapping = "profile";
    double maxBoost = AdaptationParams{}.maxBoost.value; // dB
    bool noProtection = false;
    bool force = false;
    OverwriteOptions overwriting;
    bool explain = false;
    bool measured = false;
};

} // namespace pacini::cli
