#pragma once

// Background thread that builds the objects that a PreviewEngine plays.

#include "document/PreviewEngine.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace pacini
{

/// Calls service() of an engine, which must outlive it, as soon as wake() is called and every 50 ms.
class PreviewWorker
{
public:
    explicit PreviewWorker(PreviewEngine& engineToServe) : engine(engineToServe), thread([this] { run(); }) {}

    ~PreviewWorker()
    {
        {
            const std::lock_guard lock(mutex);
            ending = true;
        }
        awake.notify_one();
        thread.join();
    }

    PreviewWorker(const PreviewWorker&) = delete;
    PreviewWorker& operator=(const PreviewWorker&) = delete;

    /// There is something new: call after set(), play() and the like. [message]
    void wake()
    {
        {
            const std::lock_guard lock(mutex);
            woken = true;
        }
        awake.notify_one();
    }

    /// Why the last piece could not be built, if so. [any]
    [[nodiscard]] std::optional<Error> lastError() const
    {
        const std::lock_guard lock(mutex);
        return failure;
    }

private:
    void run()
    {
        std::unique_lock lock(mutex);
        while (!ending)
        {
            awake.wait_for(lock, std::chrono::milliseconds(50), [this] { return woken || ending; });
            woken = false;
            if (ending || !engine.wantsService())
                continue;
            lock.unlock();
            const auto done = engine.service();
            lock.lock();
            failure = done ? std::nullopt : std::optional(done.error());
        }
    }

    PreviewEngine& engine;
    mutable std::mutex mutex;
    std::condition_variable awake;
    std::optional<Error> failure;
    bool woken = false;
    bool ending = false;
    std::thread thread;
};

} // namespace pacini
