#pragma once

// Sweep recordings: their options and their analysis, for the steps of a measurement.

#include "cli/Console.h"
#include "io/SweepFile.h"

#include <pacini/linearize/MeasurementParams.h>
#include <pacini/linearize/PlacementAverage.h>
#include <pacini/linearize/SweepMeasurement.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

/// Command-line options of the steps that read recordings.
struct RecordingOptions
{
    std::vector<std::string> recordings;
    std::string sweep;
    std::vector<int> channels;          ///< counted from 1; empty: all
    std::vector<std::string> fullScale; ///< empty: levels are relative
    std::string smoothing = "1/12";
    int points = 240;

    void declare(CLI::App& command);
    [[nodiscard]] double smoothingOctaves() const;

    /// Whether levels are in m/s^2.
    [[nodiscard]] bool isCalibrated() const noexcept { return !fullScale.empty(); }
};

/// Names the first of `results` (empty ones aside) that is one of the recordings or the sweep: the result and why it
/// must not be written; none if all may be.
[[nodiscard]] std::optional<std::pair<std::string, Error>> overwrittenInput(const RecordingOptions& options,
                                                                            const std::vector<std::string>& results);

/// One analysed recording.
struct AnalysedRecording
{
    std::string file;
    SweepMeasurement measurement;
};

struct AnalysedRecordings
{
    SweepFile sweep;
    std::vector<AnalysedRecording> recordings;
    PlacementAverage average; ///< of their responses
};

/// Analyses all recordings. Prints warnings and errors on the console; returns none after an error.
[[nodiscard]] std::optional<AnalysedRecordings> analyseRecordings(Console& console, const RecordingOptions& options);

} // namespace pacini::cli
