#pragma once

// Clock for the times at which packets are sent: the real one and a simulated one.

#include <pacini/foundation/Units.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace pacini::devices
{

class SendClock
{
public:
    virtual ~SendClock() = default;

    /// Seconds since some moment, never going back. [any]
    [[nodiscard]] virtual Seconds now() const = 0;

    /// Returns true at `time`, or false as soon as interrupt() has been called, ever. [worker]
    [[nodiscard]] virtual bool waitUntil(Seconds time) = 0;

    /// Returns after `duration`, interrupted or not. [worker]
    virtual void pause(Seconds duration) = 0;

    /// Ends all waiting. [any]
    virtual void interrupt() = 0;
};

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

/// Simulated clock, which waiting moves on at once: for lists of what would be sent and for tests.
class InstantClock : public SendClock
{
public:
    [[nodiscard]] Seconds now() const override { return Seconds(time.load()); }

    [[nodiscard]] bool waitUntil(Seconds until) override
    {
        if (until.value > time.load())
            time.store(until.value);
        return !interrupted.load();
    }

    void pause(Seconds duration) override { time.store(time.load() + duration.value); }

    void interrupt() override { interrupted.store(true); }

private:
    std::atomic<double> time{0.0};
    std::atomic<bool> interrupted{false};
};

} // namespace pacini::devices
