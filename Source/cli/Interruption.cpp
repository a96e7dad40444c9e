#include "cli/Interruption.h"

#if defined(__linux__)

#include <signal.h>
#include <time.h>

#include <initializer_list>

namespace pacini::cli
{

namespace
{
sigset_t interruptingSignals() noexcept
{
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    {
        struct sigaction action = {};
        if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN)
            sigaddset(&set, signal);
    }
    return set;
}
} // namespace

Interruption::Interruption() noexcept
{
    const sigset_t set = interruptingSignals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

bool Interruption::wait(Seconds time) noexcept
{
    if (came != 0)
        return true;
    const sigset_t set = interruptingSignals();
    const auto whole = static_cast<time_t>(time.value);
    const timespec duration{whole, static_cast<long>(1e9 * (time.value - static_cast<double>(whole)))};
    if (const int signal = sigtimedwait(&set, nullptr, &duration); signal > 0)
    {
        came = signal;
        release();
    }
    return came != 0;
}

void Interruption::release() noexcept
{
    const sigset_t set = interruptingSignals();
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

Interruption::~Interruption()
{
    release();
    if (came != 0)
        raise(came);
}

} // namespace pacini::cli

#else

#include <chrono>
#include <thread>

namespace pacini::cli
{

Interruption::Interruption() noexcept = default;

bool Interruption::wait(Seconds time) noexcept
{
    std::this_thread::sleep_for(std::chrono::duration<double>(time.value));
    return came != 0;
}

Interruption::~Interruption() = default;

} // namespace pacini::cli

#endif
