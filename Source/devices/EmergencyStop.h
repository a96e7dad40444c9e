#pragma once

// Crash handler that silences a controller with a last report.

#include "devices/ReportSink.h"

namespace pacini::devices
{

/// While it lives and is armed, a signal that ends the program first writes a report that silences a controller:
/// SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGSYS and SIGABRT, and also SIGINT, SIGTERM, SIGHUP and SIGQUIT where the program
/// does not take them in itself. Then the signal has its usual effect; a program that survives sends nothing more.
/// Everything is prepared before: the handler only reads this object's lasting place and writes, by one system call.
/// Once more after 20 ms, as another thread may have been about to send. SIGKILL cannot be caught. Does nothing where
/// there are no such signals.
class EmergencyStop
{
public:
    /// `fileDescriptor` stays open longer than this lives. With more than eight of them at a time the rest does
    /// nothing.
    explicit EmergencyStop(int fileDescriptor) noexcept;
    EmergencyStop(const EmergencyStop&) = delete;
    EmergencyStop& operator=(const EmergencyStop&) = delete;
    ~EmergencyStop();

    /// From now on there is something to write, and the handlers are there. At most once. [worker]
    void arm(const StopReports& stops) noexcept;

    /// A report has been written: the next counter is due. [worker]
    void count() noexcept;

    /// Whether such a signal has come: nothing else may be written any more. [any]
    [[nodiscard]] static bool hasCome() noexcept;

private:
    struct Place;
    static Place places[8];
    static bool writeAll() noexcept; ///< whether there was something to silence
    friend void stopControllers(int signal) noexcept;

    [[maybe_unused]] Place* place = nullptr;
    [[maybe_unused]] int descriptor;
};

} // namespace pacini::devices
