#include "devices/EmergencyStop.h"

#if !defined(_WIN32)

#include "devices/RawReport.h"

#include <signal.h>
#include <time.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <iterator>
#include <mutex>

namespace pacini::devices
{

// Lasts as long as the program: a handler may look at it at any time.
struct EmergencyStop::Place
{
    std::atomic<bool> taken{false};
    std::atomic<int> descriptor{0}; ///< and 1; 0: nothing to write. All zeros take no room in a library
    std::atomic<unsigned> sent{0};
    StopReports stops;
};

EmergencyStop::Place EmergencyStop::places[8];

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<unsigned>::is_always_lock_free);

namespace
{
std::atomic<bool> signalHasCome{false};
constexpr int deadly[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGSYS, SIGABRT, SIGINT, SIGTERM, SIGHUP, SIGQUIT};
struct sigaction formerActions[std::size(deadly)];
} // namespace

bool EmergencyStop::writeAll() noexcept
{
    bool any = false;
    for (Place& place : places)
        if (const int descriptor = place.descriptor.load(std::memory_order_acquire) - 1; descriptor >= 0)
        {
            const Report& report = place.stops[place.sent.fetch_add(1) % place.stops.size()];
            any = writeRawReport(descriptor, report) >= 0 || any;
        }
    return any;
}

void stopControllers(int signal) noexcept
{
    const int error = errno;
    signalHasCome.store(true);
    if (EmergencyStop::writeAll())
    {
        const timespec pause{0, 20'000'000};
        ::nanosleep(&pause, nullptr);
        EmergencyStop::writeAll();
    }
    for (std::size_t i = 0; i < std::size(deadly); ++i)
        if (deadly[i] == signal)
            ::sigaction(signal, &formerActions[i], nullptr);
    errno = error;
    ::raise(signal); // held back until this returns
}

namespace
{
extern "C" void stopControllersOnSignal(int signal)
{
    stopControllers(signal);
}

void installHandlers() noexcept
{
    for (std::size_t i = 0; i < std::size(deadly); ++i)
    {
        if (::sigaction(deadly[i], nullptr, &formerActions[i]) != 0 || formerActions[i].sa_handler == SIG_IGN)
            continue;
        struct sigaction action = {};
        action.sa_handler = stopControllersOnSignal;
        action.sa_flags = static_cast<int>(SA_ONSTACK);
        sigemptyset(&action.sa_mask);
        ::sigaction(deadly[i], &action, nullptr);
    }
}
} // namespace

EmergencyStop::EmergencyStop(int fileDescriptor) noexcept : descriptor(fileDescriptor)
{
    for (Place& free : places)
        if (!free.taken.exchange(true))
        {
            place = &free;
            return;
        }
}

EmergencyStop::~EmergencyStop()
{
    if (place == nullptr)
        return;
    place->descriptor.store(0);
    place->taken.store(false);
}

void EmergencyStop::arm(const StopReports& stops) noexcept
{
    if (place == nullptr)
        return;
    static std::once_flag installed;
    std::call_once(installed, installHandlers);
    place->stops = stops;
    place->sent.store(0);
    place->descriptor.store(descriptor + 1, std::memory_order_release);
}

void EmergencyStop::count() noexcept
{
    if (place != nullptr)
        place->sent.fetch_add(1);
}

bool EmergencyStop::hasCome() noexcept
{
    return signalHasCome.load();
}

} // namespace pacini::devices

#else

namespace pacini::devices
{

EmergencyStop::EmergencyStop(int fileDescriptor) noexcept : descriptor(fileDescriptor) {}
EmergencyStop::~EmergencyStop() = default;
void EmergencyStop::arm(const StopReports&) noexcept {}
void EmergencyStop::count() noexcept {}
bool EmergencyStop::hasCome() noexcept
{
    return false;
}

} // namespace pacini::devices

#endif
