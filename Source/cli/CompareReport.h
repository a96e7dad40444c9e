#pragma once

// Report of a comparison of many pairs, as a table and as JSON.

#include "cli/CompareJob.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// One pair: has a result or a failure once it is done.
struct CompareTask
{
    ComparePair pair;
    std::optional<CompareResult> result;
    std::optional<InputFailure> failure;
};

/// Aligned columns of the pairs that have results, and the means of every column in the last row; "-" for undefined
/// measures. The column of F1 appears if any pair has one.
[[nodiscard]] std::string compareTable(const std::vector<CompareTask>& tasks);

/// All measures of one pair that has a result.
[[nodiscard]] nlohmann::ordered_json pairJson(const CompareTask& task);

/// {"files": [...], "mean": {...}, "events": {...}, "seconds", "timesRealTime"}: the figures of the table and more.
/// Undefined figures are null and not in the means; "events" counts over all files.
[[nodiscard]] nlohmann::ordered_json compareJson(const std::vector<CompareTask>& tasks);

/// One line about the whole work.
[[nodiscard]] std::string compareSummary(const std::vector<CompareTask>& tasks, std::size_t failures);

} // namespace pacini::cli
