#include "cli/Interruption.h"

#if defined(__linux__) && !defined(PACINI_AS_OTHER_SYSTEMS)

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

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

namespace pacini::cli
{

namespace
{
std::atomic<int> interruptingSignal{0};
static_assert(std::atomic<int>::is_always_lock_free);

using SignalHandler = void (*)(int);
SignalHandler formerInterrupt = SIG_DFL;
SignalHandler formerTerminate = SIG_DFL;

extern "C" void noteInterruptingSignal(int signal)
{
    interruptingSignal.store(signal);
    std::signal(signal, SIG_DFL); // a second one ends the program
}

SignalHandler take(int signal) noexcept
{
    const SignalHandler former = std::signal(signal, noteInterruptingSignal);
    if (former == SIG_IGN)
        std::signal(signal, SIG_IGN);
    return former == SIG_ERR ? SIG_DFL : former;
}
} // namespace

// Standard C++ knows SIGINT, also that of a console on Windows, and SIGTERM.
Interruption::Interruption() noexcept
{
    interruptingSignal.store(0);
    formerInterrupt = take(SIGINT);
    formerTerminate = take(SIGTERM);
}

bool Interruption::wait(Seconds time) noexcept
{
    using Clock = std::chrono::steady_clock;
    constexpr auto look = std::chrono::milliseconds(10);
    const auto end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time.value));
    while (interruptingSignal.load() == 0 && Clock::now() < end)
        std::this_thread::sleep_for(std::min<Clock::duration>(look, end - Clock::now()));
    came = interruptingSignal.load();
    return came != 0;
}

void Interruption::release() noexcept
{
    std::signal(SIGINT, formerInterrupt);
    std::signal(SIGTERM, formerTerminate);
}

Interruption::~Interruption()
{
    release();
    if (came != 0)
        std::raise(came);
}

} // namespace pacini::cli

#endif
