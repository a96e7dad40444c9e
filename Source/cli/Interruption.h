#pragma once

// Signal handling: ends work in order when the user or the system asks for it.

#include <pacini/foundation/Units.h>

namespace pacini::cli
{

/// While it lives, the first SIGINT, SIGTERM or SIGHUP does not end the program but waits to be taken in; at the end of
/// its life, that signal does what it would have done. A second one ends the program at once. Signals that the program
/// was started to ignore stay ignored; threads that are started meanwhile leave them all alone. On systems other than
/// Linux there is one of these at a time; Windows has no SIGHUP.
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
