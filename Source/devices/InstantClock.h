#pragma once

// Simulated clock.

#include "devices/SendClock.h"

#include <pacini/foundation/Units.h>

#include <atomic>

namespace pacini::devices
{

/// Simulated clock that waiting advances at once, for dry runs and tests.
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
