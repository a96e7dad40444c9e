// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Background job queue, for work that takes too long for the message thread.

#include <juce_events/juce_events.h>

#include <memory>
#include <utility>

namespace pacini::editor
{

/// One thread that runs jobs in order and returns each result to the message thread. The destructor waits for the
/// current job; no results are returned afterwards. [message]
class Jobs
{
public:
    Jobs() = default;
    ~Jobs() { pool.removeAllJobs(true, -1); }
    Jobs(const Jobs&) = delete;
    Jobs& operator=(const Jobs&) = delete;

    /// Calls work() on the thread, then done(its result) on the message thread.
    template <typename Work, typename Done>
    void run(Work work, Done done)
    {
        pool.addJob(
            [work = std::move(work), done = std::move(done), watch = std::weak_ptr<int>(alive)]() mutable
            {
                auto result = std::make_shared<decltype(work())>(work());
                juce::MessageManager::callAsync(
                    [result, done = std::move(done), watch]
                    {
                        if (!watch.expired())
                            done(std::move(*result));
                    });
            });
    }

private:
    std::shared_ptr<int> alive = std::make_shared<int>(0);
    juce::ThreadPool pool{1};
};

} // namespace pacini::editor
