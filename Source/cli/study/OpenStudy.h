#pragma once

// Opening of a study that was named on the command line.

#include "cli/Console.h"
#include "study/Study.h"
#include "study/StudyResults.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace pacini::cli
{

/// Adds the subcommand `name` with the study to open as its first argument.
CLI::App* addStudyCommand(CLI::App& app, const std::string& name, const std::string& description, std::string& study);

/// A study and where it lies.
struct OpenedStudy
{
    study::Study study;
    std::filesystem::path file;
    std::filesystem::path folder;
};

/// The study in a folder or file; nothing when it cannot be read, and the console has said why.
[[nodiscard]] std::optional<OpenedStudy> openStudy(Console& console, const std::string& named);

/// The answers in the folder of a study; nothing when they cannot be read, and the console has said why.
[[nodiscard]] std::optional<study::StudyResults> openResults(Console& console, const std::string& named);

/// The actuator that `given` (--profile) names, else that of the study: a shipped name, or a file, which counts from
/// the study's folder.
[[nodiscard]] std::string actuatorOf(const study::Study& study, const std::filesystem::path& folder,
                                     const std::string& given);

} // namespace pacini::cli
