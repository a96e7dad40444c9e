#pragma once

// Subcommand that draws charts.

#include "cli/Command.h"
#include "cli/Overwrite.h"
#include "cli/plot/Figure.h"
#include "cli/plot/Waveform.h"

#include <pacini/synthesis/Scene.h>

#include <filesystem>
#include <optional>
#include <string>

namespace pacini::cli
{

/// `pacini plot`: a clip, a scene, a sound and the clip it becomes, or an actuator, as a picture.
class PlotCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    /// What is shown of something that lasts `duration` s. Errors: invalidArgument.
    [[nodiscard]] Result<plot::TimeRange> rangeWithin(double duration) const;

    Exit plotScene(Console& console, const std::filesystem::path& target, const Scene& scene,
                   const plot::FigureStyle& style) const;
    Exit write(Console& console, const std::filesystem::path& target, const plot::Figure& figure,
               const plot::FigureStyle& style) const;

    std::string input;
    std::string output;
    std::string sound;
    std::string profile;
    std::string clipFolder;
    std::string size = "1600x1000";
    std::optional<double> from;
    std::optional<double> to;
    bool dark = false;
    OverwriteOptions overwriting;
    Replaceable replaceable = Replaceable::named; ///< at the target
};

} // namespace pacini::cli
