#include "devices/RumblePlayer.h"

#include <memory>
#include <utility>

#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#endif

namespace pacini::devices
{

namespace
{
/// Before other work, where the user is allowed that: a packet takes some microseconds, but should not wait.
void raisePriority() noexcept
{
#if defined(__linux__)
    sched_param lowest{};
    lowest.sched_priority = sched_get_priority_min(SCHED_RR);
    static_cast<void>(pthread_setschedparam(pthread_self(), SCHED_RR, &lowest));
#endif
}
} // namespace

RumblePlayer::RumblePlayer(const ControllerModel& controller, std::unique_ptr<RumbleSource> whatToPlay,
                           ReportSink& where, SendClock& when)
    : source(std::move(whatToPlay)), playback(controller, *source, where, when), clock(when)
{
    thread = std::thread(
        [this]
        {
            raisePriority();
            result = playback.run();
            playing.store(false, std::memory_order_release);
        });
}

void RumblePlayer::stop()
{
    clock.interrupt();
    if (thread.joinable())
        thread.join();
}

Result<PlayReport> RumblePlayer::finish()
{
    if (thread.joinable())
        thread.join();
    return result;
}

} // namespace pacini::devices
