#pragma once

// Batch tasks: files to turn into other files, with the result or the error of each.

#include "cli/Console.h"
#include "cli/Counted.h"
#include "cli/InputFiles.h"
#include "cli/Overwrite.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

/// One file: has an error, or a result when it is done, unless its existing output is kept.
template <typename ResultType>
struct Task
{
    std::filesystem::path input;
    std::filesystem::path output;
    std::string key; ///< the manifest's name of the input: its path relative to the given folder, with /
    std::optional<ResultType> result;
    std::optional<Error> error;
    Replaceable replaceable = Replaceable::own;
    bool skipped = false; ///< for the sake of -n
};

/// Ends a list of tasks early: on a full disk all that are left would fail.
class BatchEnd
{
public:
    [[nodiscard]] bool come() const noexcept { return full.load(); }

    /// Whether `error` is still to be reported: of those of a full disk only the first.
    [[nodiscard]] bool isNews(const Error& error) noexcept
    {
        return error.code != ErrorCode::diskFull || !full.exchange(true);
    }

private:
    std::atomic<bool> full = false;
};

/// Runs `work`, which gives a Result<ResultType>, unless the task has failed already or is skipped. Exceptions become
/// the task's error, so that one file does not stop the others.
template <typename ResultType, typename Work>
void attempt(Task<ResultType>& task, const BatchEnd& end, Work&& work)
{
    if (task.error || task.skipped)
        return;
    if (end.come())
    {
        task.error = Error{ErrorCode::diskFull, "", "was skipped, as the disk is full"};
        return;
    }
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
        task.error = Error{ErrorCode::tooLarge, "", "needs more memory than is available; try it alone, with -j 1"};
    }
    catch (const std::exception& failure)
    {
        task.error = Error{ErrorCode::io, "", failure.what()};
    }
}

/// Prints the error of a task, if any; errors that end the whole list are printed once.
template <typename ResultType>
void tellError(Console& console, const Task<ResultType>& task, BatchEnd& end)
{
    if (!task.error)
        return;
    if (end.isNews(*task.error))
        console.error(task.input.string(), *task.error);
    else
        console.repeatedError(task.input.string(), *task.error);
}

/// The error of writing `output`, for a message that starts with the name of the input.
[[nodiscard]] inline Error atOutput(const std::filesystem::path& output, Error error)
{
    error.where = output.string() + (error.where.empty() ? "" : ": " + error.where);
    return error;
}

/// The tasks for the inputs that were named; two that would be written to one file are an error, as are unreadable
/// folders, and one that would be written to any of the inputs; where that is the input itself, the error is what
/// `unreadable` finds wrong with it, if anything. Folders for the outputs are made unless nothing is to be written.
template <typename ResultType>
[[nodiscard]] std::vector<Task<ResultType>>
makeTasks(const InputFiles& found, const OutputNames& names, const OverwriteOptions& overwriting, bool makeFolders,
          const std::function<std::optional<Error>(const std::filesystem::path&)>& unreadable = nullptr)
{
    std::vector<Task<ResultType>> tasks;
    for (const InputFailure& failure : found.failures)
        tasks.push_back({failure.path, {}, failure.path.generic_string(), {}, failure.error, {}, {}});
    std::error_code ignored;
    std::map<std::filesystem::path, std::filesystem::path> inputs; // by where they really are
    for (const InputFile& file : found.files)
        inputs.emplace(realPlace(file.path), file.path);
    std::map<std::filesystem::path, std::filesystem::path> taken;
    for (const InputFile& file : found.files)
    {
        Task<ResultType> task{file.path, {}, file.relative.generic_string(), {}, {}, {}, {}};
        const auto fail = [&task](std::string message)
        {
            task.error = Error{ErrorCode::invalidArgument, "", std::move(message)};
        };
        const auto place = outputFor(file, names, found.several, makeFolders);
        if (!place)
            task.error = place.error();
        else if (isStream(place->path))
        {
            task.output = place->path;
            task.replaceable = Replaceable::named;
        }
        else if (const auto [other, first] = taken.emplace(sameFileKey(place->path), file.path); !first)
            fail("would be written to " + place->path.string() + ", as " + other->second.string() +
                 " is; rename one of them");
        else if (std::filesystem::equivalent(place->path, file.path, ignored))
        {
            fail(alsoInput);
            if (auto wrong = unreadable ? unreadable(file.path) : std::nullopt)
                task.error = std::move(wrong);
        }
        else if (const auto input = inputs.find(realPlace(place->path)); input != inputs.end())
            fail("would overwrite " + input->second.string() +
                 ", which is an input too; choose another output with -o");
        else
        {
            task.output = place->path;
            task.replaceable = overwriting.of(place->named);
            task.skipped = overwriting.keepsAll() && isOccupied(place->path);
        }
        tasks.push_back(std::move(task));
    }
    return tasks;
}

template <typename ResultType>
[[nodiscard]] bool anyFailed(const std::vector<Task<ResultType>>& tasks)
{
    return std::any_of(tasks.begin(), tasks.end(), [](const auto& task) { return task.error.has_value(); });
}

template <typename ResultType>
[[nodiscard]] std::size_t countSkipped(const std::vector<Task<ResultType>>& tasks)
{
    return static_cast<std::size_t>(
        std::count_if(tasks.begin(), tasks.end(), [](const auto& task) { return task.skipped; }));
}

/// ", 2 up to date, 1 exists and was left, 3 failed": how many were not worked on, as far as there are any.
[[nodiscard]] inline std::string restText(std::size_t upToDate, std::size_t skipped, std::size_t failed)
{
    std::string text = upToDate > 0 ? fmt::format(", {} up to date", upToDate) : "";
    if (skipped > 0)
        text += ", " + counted(skipped, "exists and was kept", "exist and were kept");
    if (failed > 0)
        text += fmt::format(", {} failed", failed);
    return text;
}

/// Prints the action for each file that `work` only checked; results that are up to date are skipped.
template <typename ResultType>
void reportPlan(Console& console, const std::vector<Task<ResultType>>& tasks)
{
    auto files = nlohmann::ordered_json::array();
    for (const auto& task : tasks)
    {
        if (!task.result && !task.skipped)
            continue;
        std::error_code ignored;
        const bool fresh = !task.skipped && task.result->upToDate;
        const char* action = fresh || task.skipped                           ? "skip"
                             : std::filesystem::exists(task.output, ignored) ? "overwrite"
                                                                             : "write";
        files.push_back({{"input", task.input.string()}, {"output", task.output.string()}, {"action", action}});
        console.print(fmt::format("would {} {}, {} {}", action, printable(task.output.string()),
                                  fresh          ? "up to date with"
                                  : task.skipped ? "which exists, from"
                                                 : "from",
                                  printable(task.input.string())));
    }
    console.addToReport({{"dryRun", true}, {"files", files}});
}

/// The list of files of a report: toJson(task) for each result; `alone` as for fileList(). Kept outputs are listed
/// under "skipped". The console knows the failures.
template <typename ResultType, typename ToJson>
[[nodiscard]] nlohmann::ordered_json jsonReport(const std::vector<Task<ResultType>>& tasks, ToJson&& toJson,
                                                bool alone = false)
{
    auto files = nlohmann::ordered_json::array();
    auto skipped = nlohmann::ordered_json::array();
    for (const auto& task : tasks)
        if (task.result)
            files.push_back(toJson(task));
        else if (task.skipped)
            skipped.push_back({{"input", task.input.string()}, {"output", task.output.string()}});
    auto list = fileList(std::move(files), alone);
    list["skipped"] = std::move(skipped);
    return list;
}

} // namespace pacini::cli
