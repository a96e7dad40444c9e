#pragma once

// Interface of the clock for the times at which packets are sent.

#include <pacini/foundation/Units.h>

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

} // namespace pacini::devices
