#include "live/LivePad.h"

#include "live/LiveRumble.h"
#include "live/TrackedDrive.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace pacini::live
{

namespace
{
/// Notes whether the state that is sent next is silent.
class WatchedRumble : public devices::RumbleSource
{
public:
    WatchedRumble(LiveDrive& drive, double fs, const devices::ControllerModel& controller, bool& soundsNow)
        : rumble(drive, fs, controller),
          model(controller),
          silence(devices::reportOf(controller, devices::silentState(controller), 0)),
          sounds(soundsNow)
    {
    }

    std::optional<devices::RumbleState> at(std::int64_t packet) override
    {
        auto state = rumble.at(packet);
        sounds = state && devices::reportOf(model, *state, 0) != silence;
        return state;
    }

private:
    LiveRumble rumble;
    devices::ControllerModel model;
    devices::Report silence;
    bool& sounds;
};

/// Passes reports on, counts them, and tells the probe of those that are not silent.
class WatchedSink : public devices::ReportSink
{
public:
    WatchedSink(devices::ReportSink& target, bool stopsOnCrash, const bool& soundsNow, LatencyProbe* measured,
                std::atomic<std::int64_t>& counter)
        : device(target), stops(stopsOnCrash), sounds(soundsNow), probe(measured), sent(counter)
    {
    }

    void prepare(const devices::StopReports& reports) override
    {
        if (stops)
            device.prepare(reports);
    }

    Result<void> send(const devices::Report& report) override
    {
        auto done = device.send(report);
        if (!done)
            return done;
        sent.fetch_add(1, std::memory_order_relaxed);
        if (probe && sounds)
            probe->sent();
        return done;
    }

private:
    devices::ReportSink& device;
    bool stops;
    const bool& sounds;
    LatencyProbe* probe;
    std::atomic<std::int64_t>& sent;
};
} // namespace

/// All that lasts from a connection to its end; the player ends first.
struct LivePad::Link
{
    Link(OpenedController opened, bool stopsOnCrash, LiveDrive& drive, double fs, LatencyProbe* probe)
        : pad(std::move(opened)), sink(std::make_unique<WatchedSink>(*pad.device, stopsOnCrash, sounds, probe, sent))
    {
        if (pad.sound)
            playSound(drive, fs);
        else
            player.emplace(pad.model, std::make_unique<WatchedRumble>(drive, fs, pad.model, sounds), *sink, clock);
    }

    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;
    ~Link()
    {
        if (pad.sound)
            pad.sound->stop();
    }

    /// Blocks of its sound device count as reports.
    void playSound(LiveDrive& drive, double driveRate)
    {
        constexpr double margin = 0.010; // s, as for a sound card whose blocks are not known
        const double goes = static_cast<double>(pad.sound->blockFrames()) / pad.sound->sampleRate();
        tracked.emplace(drive, driveRate, pad.sound->sampleRate(),
                        static_cast<std::size_t>((goes + margin) * driveRate));
        failure = pad.sound->play(
            [this](std::span<float> frames)
            {
                tracked->read(frames);
                sent.fetch_add(1, std::memory_order_relaxed);
            });
    }

    [[nodiscard]] bool isPlaying()
    {
        if (player)
            return player->isPlaying();
        return pad.sound->isRunning() && pad.isThere() && !tracked->isOver();
    }

    void stop()
    {
        if (player)
            player->stop();
        else
            pad.sound->stop();
    }

    [[nodiscard]] Result<devices::PlayReport> finish()
    {
        if (player)
            return player->finish();
        const bool isThere = pad.isThere();
        pad.sound->stop();
        if (!failure)
            return failure.error();
        if (!isThere)
            return Error{ErrorCode::io, "", "does not answer any more; was it unplugged or switched off?"};
        return devices::PlayReport{};
    }

    OpenedController pad;
    Result<void> failure;
    bool sounds = false; ///< of the player's thread
    std::atomic<std::int64_t> sent{0};
    bool works = false; ///< it has taken a report
    std::unique_ptr<devices::ReportSink> sink;
    devices::SteadyClock clock;
    std::optional<TrackedDrive> tracked;         ///< of its sound device
    std::optional<devices::RumblePlayer> player; ///< of reports
};

LivePad::LivePad(PadDoor wanted, LiveDrive& drive, double sampleRate, LatencyProbe* probe)
    : door(std::move(wanted)), source(drive), fs(sampleRate), measured(probe)
{
    source.listen(false);
}

LivePad::~LivePad() = default;

Result<void> LivePad::openOne(const devices::Controller& controller)
{
    auto opened = door.open(controller);
    if (!opened)
        return opened.error();
    if (!devices::DriveRumble::takesRate(fs, opened->model))
        return Error{ErrorCode::invalidArgument, opened->name,
                     fmt::format("takes no sound of {} Hz; use one of a whole number of Hz from 8000 on", fs)};
    source.listen(true);
    report.name = opened->name;
    report.lesser = opened->lesser;
    link = std::make_unique<Link>(std::move(*opened), door.stopsOnCrash, source, fs, measured);
    return {};
}

Result<void> LivePad::open()
{
    lastLook = std::chrono::steady_clock::now();
    const auto found = door.find();
    return found ? openOne(*found) : Result<void>(found.error());
}

Result<void> LivePad::takeResult()
{
    const auto result = link->finish();
    noteConnection();
    report.sent += link->sent.load();
    link.reset();
    source.listen(false);
    if (!result)
        return result.error();
    report.leftOut += result->leftOut;
    report.latest.value = std::max(report.latest.value, result->latest.value);
    return {};
}

bool LivePad::noteConnection()
{
    if (link->works || link->sent.load() == 0)
        return false;
    link->works = true;
    return ++report.connections > 1;
}

PadNews LivePad::look()
{
    constexpr std::chrono::milliseconds pause(300);
    PadNews news;
    if (link)
    {
        news.isBack = noteConnection();
        news.lesser = std::exchange(report.lesser, {});
        if (link->isPlaying() || source.isOver())
            return news;
        const bool worked = link->works; // one that is just being plugged in may open and not answer
        if (const auto done = takeResult(); !done)
            (worked ? news.stopped : news.notFound) = done.error();
        return news;
    }
    if (std::chrono::steady_clock::now() - lastLook >= pause)
        if (const auto opened = open(); !opened)
            news.notFound = opened.error();
    return news;
}

bool LivePad::isConnected() const noexcept
{
    return link && link->works;
}

bool LivePad::isDone() const
{
    return !link || !link->isPlaying();
}

const LivePadReport& LivePad::close()
{
    if (link)
    {
        link->stop();
        static_cast<void>(takeResult());
    }
    return report;
}

} // namespace pacini::live
