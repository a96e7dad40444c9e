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

#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <thread>

namespace pacini::cli
{

namespace
{
std::atomic<int> interruptingSignal{0};
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void noteInterruptingSignal(int signal)
{
    interruptingSignal.store(signal);
}

#if defined(_WIN32)

constexpr int interrupting[] = {SIGINT, SIGTERM};
using Action = void (*)(int);

// Windows puts the usual action back by itself, and so a second signal ends the program.
Action take(int number) noexcept
{
    const Action former = ::signal(number, noteInterruptingSignal);
    if (former == SIG_IGN)
        ::signal(number, SIG_IGN);
    return former;
}

void giveBack(int number, Action former) noexcept
{
    if (former != SIG_ERR)
        ::signal(number, former);
}

#else

constexpr int interrupting[] = {SIGINT, SIGTERM, SIGHUP};
using Action = struct sigaction;

Action take(int number) noexcept
{
    Action former = {};
    Action action = {};
    action.sa_handler = noteInterruptingSignal;
    action.sa_flags = static_cast<int>(SA_RESETHAND); // a second one ends the program
    sigemptyset(&action.sa_mask);
    if (::sigaction(number, nullptr, &former) == 0 && former.sa_handler != SIG_IGN)
        ::sigaction(number, &action, nullptr);
    return former;
}

void giveBack(int number, const Action& former) noexcept
{
    ::sigaction(number, &former, nullptr); // with its flags, which signal() would lose
}

#endif

Action formerActions[std::size(interrupting)];
} // namespace

Interruption::Interruption() noexcept
{
    interruptingSignal.store(0);
    for (std::size_t i = 0; i < std::size(interrupting); ++i)
        formerActions[i] = take(interrupting[i]);
}

bool Interruption::wait(Seconds time) noexcept
{
    using Clock = std::chrono::steady_clock;
    constexpr Clock::duration look = std::chrono::milliseconds(10);
    const auto end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time.value));
    while (interruptingSignal.load() == 0 && Clock::now() < end)
        std::this_thread::sleep_for(std::min(look, end - Clock::now()));
    came = interruptingSignal.load();
    return came != 0;
}

void Interruption::release() noexcept
{
    for (std::size_t i = 0; i < std::size(interrupting); ++i)
        giveBack(interrupting[i], formerActions[i]);
}

Interruption::~Interruption()
{
    release();
    if (came != 0)
        ::raise(came);
}

} // namespace pacini::cli

#endif
