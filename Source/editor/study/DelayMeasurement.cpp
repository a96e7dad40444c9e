// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/study/DelayMeasurement.h"

#include "study/SessionLog.h"
#include "study/Stimuli.h"

#include <cmath>
#include <utility>
#include <vector>

namespace pacini::editor
{

DelayMeasurement::DelayMeasurement(MeasureRig& wanted, std::filesystem::path study)
    : rig(wanted), folder(std::move(study))
{
    rig.setOpen(true);
}

DelayMeasurement::~DelayMeasurement()
{
    rig.stop();
    rig.setOpen(false);
}

Result<void> DelayMeasurement::start(std::size_t soundOut, std::size_t touchOut, std::size_t soundIn,
                                     std::size_t touchIn, const std::optional<Profile>& profile)
{
    const RigPorts now = rig.ports();
    if (!now.problem.empty())
        return Error{ErrorCode::io, "", now.problem};
    if (soundOut == touchOut)
        return Error{ErrorCode::invalidArgument, "outputs", "are the same"};
    if (soundIn == touchIn)
        return Error{ErrorCode::invalidArgument, "inputs", "are the same"};
    probe.sampleRate = static_cast<int>(std::lround(now.sampleRate));
    if (auto valid = study::validate(probe); !valid)
        return valid;
    std::vector<float> burst = study::latencyBurst(probe), signal;
    study::protectDrive(burst, profile, probe.sampleRate);
    for (int second = 0; second < static_cast<int>(probe.duration); ++second)
        signal.insert(signal.end(), burst.begin(), burst.end());
    rig.wire({soundOut, {soundIn, touchIn}, touchOut});
    auto started = rig.start(std::move(signal));
    running = static_cast<bool>(started);
    return started;
}

std::optional<Result<study::Latency>> DelayMeasurement::poll()
{
    if (!running || rig.state() == RigState::playing)
        return std::nullopt;
    running = false;
    if (rig.state() != RigState::finished)
    {
        rig.stop();
        return Error{ErrorCode::io, "device", "went away or changed"};
    }
    const auto recorded = rig.takeRecording();
    study::LatencyMeter meter(probe);
    if (recorded.size() == 2)
        meter.push(recorded[0], recorded[1]);
    auto latency = meter.latency();
    if (!latency)
        return latency;
    study::MeasuredLatency measured;
    measured.time = study::utcNow();
    measured.device = rig.ports().name;
    measured.sampleRate = probe.sampleRate;
    measured.latency = *latency;
    if (auto kept = study::keepLatency(folder, measured); !kept)
        return kept.error();
    return latency;
}

} // namespace pacini::editor
