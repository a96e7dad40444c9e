#pragma once

// A list of files to turn into other files, and what came of each.

#include "cli/Console.h"
#include "cli/InputFiles.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
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

/// Runs `work`, which gives a Result<ResultType>, unless the task has failed already. What it throws becomes the task's
/// error: one file must not stop the others.
template <typename ResultType, typename Work>
void attempt(Task<ResultType>& task, Work&& work)
{
    if (task.error)
        return;
    try
    {
        auto result = work();
        if (result)
            task.result = *result;
        else
            task.error = result.error();
    }
    catch (const std::bad_alloc&)
    {
        task.error = Error{ErrorCode::tooLarge, "", "needs more memory than there is; try it alone, with -j 1"};
    }
    catch (const std::exception& failure)
    {
        task.error = Error{ErrorCode::io, "", failure.what()};
    }
}

/// The error of writing `output`, for a message that starts with the name of the input.
[[nodiscard]] inline Error atOutput(const std::filesystem::path& output, Error error)
{
    error.where = output.string() + (error.where.empty() ? "" : ": " + error.where);
    return error;
}

/// The tasks for the inputs that were named; two that would be written to one file are an error, as are unreadable
/// folders. Folders for the outputs are made unless nothing is to be written.
template <typename ResultType>
[[nodiscard]] std::vector<Task<ResultType>> makeTasks(const InputFiles& found, const std::string& output,
                                                      const std::string& extension, bool makeFolders)
{
    std::vector<Task<ResultType>> tasks;
    for (const InputFailure& failure : found.failures)
        tasks.push_back({failure.path, {}, {}, failure.error});
    std::map<std::filesystem::path, std::filesystem::path> taken;
    for (const InputFile& file : found.files)
    {
        Task<ResultType> task{file.path, {}, {}, {}};
        const auto target = outputFor(file, output, found.several, extension, makeFolders);
        if (!target)
            task.error = target.error();
        else if (const auto [other, first] = taken.emplace(sameFileKey(*target), file.path); !first)
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

/// Says what would be done with each file that `work` only looked at: a result that is up to date is skipped.
template <typename ResultType>
void reportPlan(Console& console, const std::vector<Task<ResultType>>& tasks)
{
    auto files = nlohmann::ordered_json::array();
    for (const auto& task : tasks)
    {
        if (!task.result)
            continue;
        std::error_code ignored;
        const bool fresh = task.result->upToDate;
        const char* action = fresh ? "skip" : std::filesystem::exists(task.output, ignored) ? "overwrite" : "write";
        files.push_back({{"input", task.input.string()}, {"output", task.output.string()}, {"action", action}});
        console.print(fmt::format("would {} {}, {} {}", action, printable(task.output.string()),
                                  fresh ? "up to date with" : "from", printable(task.input.string())));
    }
    console.addToReport({{"dryRun", true}, {"files", files}});
}

/// The list of files of a report: toJson(task) for each result; `alone` as for fileList(). The console knows the
/// failures.
template <typename ResultType, typename ToJson>
[[nodiscard]] nlohmann::ordered_json jsonReport(const std::vector<Task<ResultType>>& tasks, ToJson&& toJson,
                                                bool alone = false)
{
    auto files = nlohmann::ordered_json::array();
    for (const auto& task : tasks)
        if (task.result)
            files.push_back(toJson(task));
    return fileList(std::move(files), alone);
}

} // namespace pacini::cli
