#pragma once

// What came of a bench, and the files that keep it.

#include "cli/bench/Bench.h"

#include <pacini/foundation/Result.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace pacini::cli
{

/// The measurements of one bench on all sounds.
struct BenchReport
{
    Bench bench;
    BenchTable rows;  ///< of every sound
    BenchTable means; ///< over the sounds
};

/// {"bench", "title", "note", "units", "means": [...], "rows": [...]}.
[[nodiscard]] nlohmann::ordered_json toJson(const BenchReport& report);

/// A section with heading, note and table; for whole methods also the table of every sound under its default settings.
[[nodiscard]] std::string toMarkdown(const BenchReport& report);

/// Writes NAME.csv (every sound), NAME.json and the figures (NAME.svg, NAME-FIGURE.svg; `format` svg or png) into
/// `folder`, which is made if need be; returns their paths. Errors: io.
[[nodiscard]] Result<std::vector<std::filesystem::path>>
writeReport(const BenchReport& report, const std::filesystem::path& folder, const std::string& format);

} // namespace pacini::cli
