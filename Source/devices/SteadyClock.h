#pragma once

// Clock of the real time.

#include "devices/SendClock.h"

#include <pacini/foundation/Units.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace pacini::devices
{

/// Clock of the real time. Waiting until a point of time, not for a duration, adds no error from packet to packet.
class SteadyClock : public SendClock
{
public:
    [[nodiscard]] Seconds now() const override
    {
        return Seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }

    [[nodiscard]] bool waitUntil(Seconds time) override
    {
        const auto end = start + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                     std::chrono::duration<double>(time.value));
        std::unique_lock lock(mutex);
        return !wake.wait_until(lock, end, [&] { return interrupted; });
    }

    void pause(Seconds duration) override
    {
        std::this_thread::sleep_for(std::chrono::duration<double>(duration.value));
    }

    void interrupt() override
    {
        {
            const std::lock_guard lock(mutex);
            interrupted = true;
        }
        wake.notify_all();
    }

private:
    const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::mutex mutex;
    std::condition_variable wake;
    bool interrupted = false;
};

} // namespace pacini::devices
