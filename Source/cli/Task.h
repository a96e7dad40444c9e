#pragma once

// A list of files to turn into other files, and what came of each.

#include "cli/Console.h"
#include "cli/InputFiles.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

/// One file: has an error, or a result once it is done.
template <typename ResultType>
struct Task
{
    std::filesystem::path input;
    std::filesystem::path output;
    std::optional<ResultType> result;
    std::optional<Error> error;
};

/// The tasks for the inputs that were named; two that would be written to one file are an error, as are unreadable
/// folders.
template <typename ResultType>
[[nodiscard]] std::vector<Task<ResultType>> makeTasks(const InputFiles& found, const std::string& output,
                                                      const std::string& extension)
{
    std::vector<Task<ResultType>> tasks;
    for (const InputFailure& failure : found.failures)
        tasks.push_back({failure.path, {}, {}, failure.error});
    std::map<std::filesystem::path, std::filesystem::path> taken;
    for (const InputFile& file : found.files)
    {
        Task<ResultType> task{file.path, {}, {}, {}};
        const auto target = outputFor(file, output, found.several, extension);
        if (!target)
            task.error = target.error();
        else if (const auto [other, first] = taken.emplace(*target, file.path); !first)
            task.error = Error{ErrorCode::invalidArgument, "",
                               "would be written to " + target->string() + ", as " + other->second.string() +
                                   " is; rename one of them"};
        else if (std::error_code ignored; std::filesystem::equivalent(*target, file.path, ignored))
            task.error = Error{ErrorCode::invalidArgument, "",
                               "would be overwritten by its own result; name another output with -o"};
        else
            task.output = *target;
        tasks.push_back(std::move(task));
    }
    return tasks;
}

template <typename ResultType>
[[nodiscard]] bool anyFailed(const std::vector<Task<ResultType>>& tasks)
{
    return std::any_of(tasks.begin(), tasks.end(), [](const auto& task) { return task.error.has_value(); });
}

/// {"files": [...], "failures": [...]}: toJson(task) for each result, the place and the message of each error.
template <typename ResultType, typename ToJson>
[[nodiscard]] std::string jsonReport(const std::vector<Task<ResultType>>& tasks, ToJson&& toJson)
{
    nlohmann::ordered_json report{{"files", nlohmann::json::array()}, {"failures", nlohmann::json::array()}};
    for (const auto& task : tasks)
        if (task.result)
            report["files"].push_back(toJson(task));
        else
            report["failures"].push_back(
                {{"input", task.input.string()}, {"where", task.error->where}, {"message", task.error->message}});
    return report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace pacini::cli
