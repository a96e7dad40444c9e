#pragma once

// Parallel loop over a list of tasks, with progress.

#include "cli/Console.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace pacini::cli
{

/// Calls work(i, progress) for i = 0..count-1 on `threads` threads (0: the number of processors); makeWorker() makes
/// each thread's own `work`, neither may throw. `nameOf(i)` is shown on the progress line.
template <typename MakeWorker>
void runTasks(Console& console, std::size_t count, unsigned threads,
              const std::function<std::string(std::size_t)>& nameOf, MakeWorker&& makeWorker)
{
    std::atomic<std::size_t> next = 0;
    std::atomic<std::size_t> finished = 0;
    const auto loop = [&]
    {
        auto work = makeWorker();
        for (std::size_t i = next++; i < count; i = next++)
        {
            const auto progress = [&](double share)
            {
                const auto done = finished.load();
                console.progress((static_cast<double>(done) + share) / static_cast<double>(count),
                                 fmt::format("{} of {}  {}", std::min(done + 1, count), count, nameOf(i)));
            };
            progress(0.0);
            work(i, progress);
            ++finished;
        }
    };
    const std::size_t wanted = threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::thread> others;
    try
    {
        for (std::size_t t = 1; t < std::min(wanted, count); ++t)
            others.emplace_back(loop);
    }
    catch (const std::system_error&)
    {
        // No more threads are to be had: those that run do the work.
    }
    loop();
    for (auto& thread : others)
        thread.join();
    console.endProgress();
}

/// The same for `tasks`, whose inputs' names are shown.
template <typename TaskType, typename MakeWorker>
void runTasks(Console& console, const std::vector<TaskType>& tasks, unsigned threads, MakeWorker&& makeWorker)
{
    const auto nameOf = [&](std::size_t i)
    {
        return tasks[i].input.filename().string();
    };
    runTasks(console, tasks.size(), threads, nameOf, makeWorker);
}

} // namespace pacini::cli
