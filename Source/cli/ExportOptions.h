#pragma once

// Command-line options of exports, for the commands that write clips for other programs.

#include "cli/Console.h"
#include "io/formats/ClipFormat.h"

#include <pacini/actuator/Strength.h>

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace pacini::cli
{

/// Export options as the user gives them; declared once per command.
class ExportOptions
{
public:
    void declare(CLI::App& command);

    /// The parameters that follow; nothing when the profile cannot be read, and the console has said why.
    [[nodiscard]] std::optional<ExportParams> params(Console& console) const;

    /// Errors: invalidArgument for a given option that changes nothing in `format`, with the formats in which it does.
    [[nodiscard]] Result<void> checkFor(const ClipFormat& format) const;

    /// The first option that was given; empty: none.
    [[nodiscard]] std::string firstGiven() const;

    /// The options in one line, the same for the same choices.
    [[nodiscard]] std::string record() const;

private:
    const CLI::App* declaredIn = nullptr; ///< knows which were given
    double points = 0.0;
    double frequencyPoints = 0.0;
    int rate = 0;
    EnvelopeLimits envelope;
    bool split = false;
    bool quick = false;
    std::string events; ///< empty: the format's own
    std::string profile;
    double strength = standardStrength;
};

} // namespace pacini::cli
