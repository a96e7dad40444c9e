#pragma once

// A sink that notes all reports with their times, and a clip that was played on it to its end.

#include "devices/InstantClock.h"
#include "devices/RumblePlayer.h"

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace pacini::test
{

struct SentReport
{
    double time;
    devices::Report report;
};

/// Notes all reports; `then` may make sending slow, fail or end playing.
class ReportList : public devices::ReportSink
{
public:
    explicit ReportList(devices::InstantClock& clockToRead) : clock(clockToRead) {}

    void prepare(const devices::StopReports& given) override { stops = given; }

    Result<void> send(const devices::Report& report) override
    {
        sent.push_back({clock.now().value, report});
        return then ? then(sent.size()) : Result<void>();
    }

    devices::InstantClock& clock;
    devices::StopReports stops;
    std::vector<SentReport> sent;
    std::function<Result<void>(std::size_t)> then;
};

/// A sink and a clock that have played a clip to its end.
struct PlayedReports
{
    PlayedReports(const devices::ControllerModel& model, const Clip& clip,
                  std::function<Result<void>(std::size_t)> then = {})
        : sink(clock)
    {
        sink.then = std::move(then);
        devices::ClipRumble rumble(clip, {Seconds(0.0), Seconds(clip.duration)}, 0_dB, model);
        devices::RumblePlayer player(model, std::move(rumble), sink, clock);
        result = player.finish();
    }

    devices::InstantClock clock;
    ReportList sink;
    Result<devices::PlayReport> result = devices::PlayReport{};
};

} // namespace pacini::test
