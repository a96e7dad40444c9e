#pragma once

// Signal handling: ends work in order when the user or the system asks for it.

#include <pacini/foundation/Units.h>

namespace pacini::cli
{

/// Catches interruptions during its lifetime. The first SIGINT, SIGTERM or SIGHUP is recorded instead of ending the
/// program; it takes effect when this is destroyed. A second one ends the program at once. Signals that the program was
/// started to ignore stay ignored; threads started meanwhile block all of them. On systems other than Linux, only one
/// of these may exist at a time; Windows has no SIGHUP.
class Interruption
{
public:
    Interruption() noexcept;
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
    ~Interruption();

    /// Waits for one of the signals, at most for `time`; whether one has come by now.
    [[nodiscard]] bool wait(Seconds time) noexcept;

private:
    static void release() noexcept;

    int came = 0;
};

} // namespace pacini::cli
