#pragma once

// Report of a benchmark: its tables and their files (CSV, JSON, figures).

#include "cli/Overwrite.h"
#include "cli/bench/Bench.h"

#include <pacini/foundation/Result.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

/// The measurements of one bench on all sounds.
struct BenchReport
{
    explicit BenchReport(Bench benchToRun) : bench(std::move(benchToRun)), rows(bench.columns), means(bench.columns) {}

    /// Measures one more sound. Sounds that give no rows (silence, for some) do not count.
    void measure(const BenchSound& sound, const BenchSettings& settings)
    {
        if (!bench.usesSounds && sounds > 0)
            return;
        const std::size_t before = rows.rows();
        bench.measure(sound, settings, rows);
        sounds += rows.rows() > before ? 1u : 0u;
    }

    Bench bench;
    BenchTable rows;  ///< of every sound
    BenchTable means; ///< over the sounds: rows.overSounds()
    std::size_t sounds = 0;
};

/// "one sound", "means over 8 sounds" or "made signals".
[[nodiscard]] std::string overText(const BenchReport& report);

/// {"bench", "title", "note", "sounds", "units", "means": [...], "rows": [...]}.
[[nodiscard]] nlohmann::ordered_json toJson(const BenchReport& report);

/// A section with heading, note and table; where the bench says so also of every sound.
[[nodiscard]] std::string toMarkdown(const BenchReport& report);

/// Writes NAME.csv (every sound), NAME.json and the figures (NAME.svg, NAME-FIGURE.svg; `format` svg or png) into
/// `folder`, which is made if need be; returns their paths. Files that exist are replaced beside an earlier report
/// of the same bench, or when any may be. Errors: io.
[[nodiscard]] Result<std::vector<std::filesystem::path>> writeReport(const BenchReport& report,
                                                                     const std::filesystem::path& folder,
                                                                     const std::string& format,
                                                                     Replaceable replaceable);

} // namespace pacini::cli
