#pragma once

// The benchmarks of `pacini bench`: measurement of a sound, and columns of the table.

#include "cli/BenchOptions.h"
#include "cli/bench/BenchSound.h"
#include "cli/bench/BenchTable.h"

#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace pacini::cli
{

/// A chart of a bench's table over all sounds: one line for every text in the column `series`.
struct BenchFigure
{
    std::string name; ///< of the file, after the bench's
    std::string title;
    std::string series;
    std::string x, y;        ///< columns
    std::string label;       ///< column that distinguishes the points of a line
    std::string filter = {}; ///< column, may be empty
    std::string value = {};  ///< only rows with this text in that column
    bool joined = true;      ///< points of a line are joined
};

/// The chart of the rows at one sample rate: error against time, points not joined.
[[nodiscard]] inline BenchFigure figureAtRate(const char* title, const char* series, const char* label, int kilohertz)
{
    const std::string rate = fmt::format("{} kHz", kilohertz);
    return {fmt::format("{}", kilohertz),
            fmt::format("{} at {}", title, rate),
            series,
            "time",
            "error",
            label,
            "rate",
            rate,
            false};
}

struct Bench
{
    std::string name;
    std::string title;
    std::string note; ///< how the numbers are formed: whole sentences
    std::vector<BenchColumn> columns;
    std::vector<BenchFigure> figures;
    std::vector<std::string> perSound; ///< Markdown shows each sound's row that agrees in these keys with the first row
    /// Adds the rows of one sound.
    void (*measure)(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows);
    bool usesSounds = true;     ///< false: makes its own signals, once
    bool needsProfiles = false; ///< measures on each shipped profile
    std::string sortedBy = {};  ///< column whose largest means come first; empty: rows as they were measured
};

/// The RMS error that a signal-to-noise ratio (dB) means, in % of the signal.
[[nodiscard]] inline double errorShare(double snr)
{
    return 100.0 * Decibels(-snr).gain();
}

[[nodiscard]] Bench simplifyBench();
[[nodiscard]] Bench analysisBench();
[[nodiscard]] Bench bodyBench();
[[nodiscard]] Bench decimateBench();
[[nodiscard]] Bench filtersBench();
[[nodiscard]] Bench methodsBench();
[[nodiscard]] Bench oscillatorsBench();
[[nodiscard]] Bench stagesBench();
[[nodiscard]] Bench synthesisBench();
[[nodiscard]] Bench scenesBench();
[[nodiscard]] Bench actuatorsBench();
[[nodiscard]] Bench equalizersBench();
[[nodiscard]] Bench liveBench();
[[nodiscard]] Bench matchBench();
[[nodiscard]] Bench runtimeBench();
[[nodiscard]] Bench texturesBench();

/// All of them, see benchNames.
[[nodiscard]] inline std::vector<Bench> allBenches()
{
    return {simplifyBench(), decimateBench(),  filtersBench(),    analysisBench(), synthesisBench(), oscillatorsBench(),
            scenesBench(),   actuatorsBench(), equalizersBench(), liveBench(),     bodyBench(),      stagesBench(),
            methodsBench(),  matchBench(),     runtimeBench(),    texturesBench()};
}

} // namespace pacini::cli
