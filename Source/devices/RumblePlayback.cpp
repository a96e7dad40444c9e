#include "devices/RumblePlayback.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace pacini::devices
{

namespace
{
/// Which packets say nothing that the controller does not know.
class Repeats
{
public:
    explicit Repeats(const ControllerModel& controller)
        : model(controller), pacing(pacingOf(controller)), silence(contentOf(silentState(controller)))
    {
    }

    /// Whether `state`, due at `time`, is to be sent.
    [[nodiscard]] bool needs(const RumbleState& state, Seconds time)
    {
        constexpr double rounding = 1e-6; // s
        const Report content = contentOf(state);
        if (last == content && !beginsAnew(state))
        {
            if (content == silence && time.value - since.value > pacing.quietAfter.value)
            {
                quiet = true;
                return false;
            }
            if (time.value - sent.value < pacing.refresh.value - rounding)
                return false;
        }
        else
            since = time;
        last = content;
        sent = time;
        return true;
    }

    /// Whether silence was not sent since the last call.
    [[nodiscard]] bool wasQuiet() noexcept { return std::exchange(quiet, false); }

private:
    /// What a controller can tell states by.
    [[nodiscard]] Report contentOf(const RumbleState& state) const noexcept { return reportOf(model, state, 0); }

    ControllerModel model;
    Pacing pacing;
    Report silence;
    std::optional<Report> last;
    Seconds since; ///< when it became so
    Seconds sent;
    bool quiet = false;
};
} // namespace

Result<PlayReport> RumblePlayback::run()
{
    play();
    // Also after an error, should it have been one that passes. Again after an interval: the first may come too soon
    // after the packet before it, and be ignored.
    const auto silence = [&]
    {
        return send(reportOf(model, silentState(model), counter));
    };
    if (silence())
    {
        for (int more = 1; more < pacing.lastSilent; ++more)
        {
            clock.pause(pacing.interval);
            static_cast<void>(silence());
        }
        for (const TimedReport& closing : closingReports(model, counter))
        {
            static_cast<void>(send(closing.report));
            clock.pause(closing.pause);
        }
    }
    if (!failure)
        return failure.error();
    return report;
}

void RumblePlayback::play()
{
    if (!sendAll(openingReports(model)))
        return;
    const double interval = pacing.interval.value;
    const double start = clock.now().value;
    Repeats repeats(model);
    std::int64_t packet = 0;
    for (;;)
    {
        const Seconds due(static_cast<double>(packet) * interval);
        const Seconds sending(std::max(due.value - pacing.ahead * interval, 0.0));
        if (!clock.waitUntil(Seconds(start + sending.value)))
            return;
        const auto state = source.at(packet); // not before: what is played live may still change
        if (!state)
            break;
        played.store(sending.value, std::memory_order_relaxed);
        report.latest.value = std::max(report.latest.value, clock.now().value - start - sending.value);
        if (repeats.needs(*state, due))
        {
            if (repeats.wasQuiet() && !sendAll(resumingReports(model)))
                return;
            if (!send(reportOf(model, *state, counter)))
                return;
        }
        const auto next = static_cast<std::int64_t>(std::floor((clock.now().value - start) / interval));
        report.leftOut += std::max(next - packet - 1, std::int64_t{0});
        packet = std::max(next, packet + 1);
    }
    static_cast<void>(clock.waitUntil(Seconds(start + static_cast<double>(packet) * interval)));
}

bool RumblePlayback::sendAll(std::span<const TimedReport> reports)
{
    for (const TimedReport& each : reports)
    {
        const double sentAt = clock.now().value;
        if (!send(each.report) || !clock.waitUntil(Seconds(sentAt + each.pause.value)))
            return false;
    }
    return true;
}

bool RumblePlayback::send(const Report& toSend)
{
    const auto done = sink.send(toSend);
    ++counter;
    if (done)
        ++report.sent;
    else if (failure)
        failure = done;
    return done.ok();
}

} // namespace pacini::devices
