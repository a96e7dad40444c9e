#pragma once

// Subcommand that encodes sounds.

#include "cli/Command.h"
#include "cli/ExportOptions.h"
#include "cli/InputFiles.h"
#include "cli/Overwrite.h"

#include <pacini/analysis/Encoder.h>
#include <pacini/analysis/methods/Method.h>

#include <string>
#include <vector>

namespace pacini::cli
{

/// `pacini encode`: recordings become clips, or drive signals by methods that make no clip.
class EncodeCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    /// Complains of options that the method does not have.
    [[nodiscard]] Result<void> checkOptions(const MethodInfo& method) const;
    [[nodiscard]] Result<void> checkFormat() const;
    [[nodiscard]] MethodChoices choices() const;

    /// The sounds to encode, without drive signals that Pacini made, which may lie beside them.
    [[nodiscard]] InputFiles findSounds() const;

    CLI::App* command = nullptr;
    std::vector<std::string> inputs;
    std::string methodName = "a2vt";
    bool listMethods = false;
    std::string output;
    std::string format;
    ExportOptions exporting;
    EncoderParams params;
    std::string spacing = "log";
    bool keepLevel = false;
    bool allowNan = false;
    bool allowTruncated = false;
    bool force = false;
    OverwriteOptions overwriting;
    bool dryRun = false;
    unsigned jobs = 0;
};

} // namespace pacini::cli
