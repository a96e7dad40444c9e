#pragma once

// Command-line options of exports, for the commands that write clips for other programs.

#include "cli/Console.h"
#include "cli/DescribedOptions.h"
#include "io/formats/ExportParameters.h"

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

    /// The parameters that follow for `format`, which checkFor() takes; of `settings` those count that change anything
    /// in it. Nothing when the profile cannot be read, and the console has said why.
    [[nodiscard]] std::optional<ExportParams> params(Console& console, const ClipFormat& format,
                                                     const GivenParameters& settings = {}) const;

    /// Errors: invalidArgument for a given option without effect in `format`, with the formats in which it has one.
    [[nodiscard]] Result<void> checkFor(const ClipFormat& format) const;

    /// The first option that was given; empty: none.
    [[nodiscard]] std::string firstGiven() const;

    /// The options in one line, the same for the same choices.
    [[nodiscard]] std::string record() const;

private:
    [[nodiscard]] GivenParameters given() const;

    DescribedOptions described;
    std::string profile;
};

} // namespace pacini::cli
