#include "document/measure/SimulatedMeasureRig.h"

#include <pacini/actuator/Wearer.h>
#include <pacini/foundation/Gaussian.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t axes = 3;
constexpr std::size_t loopback = axes;
constexpr std::size_t actuatorOutput = 0;

float noiseOf(const RigParams& rig)
{
    constexpr double crest = 4.0; // of noise over some milliseconds
    return static_cast<float>(crest * rig.noiseDensity * std::sqrt(rig.sampleRate / 2.0) / rig.range);
}

/// What the inputs that are wired record of `drive`.
std::vector<std::vector<float>> record(std::vector<float> drive, const RigParams& rig, const RigWiring& wiring)
{
    const std::vector<float> played = drive;
    if (wiring.output != actuatorOutput)
        std::fill(drive.begin(), drive.end(), 0.0f);
    const auto moved = recordOnRig(drive, rig);
    const auto latency = static_cast<std::size_t>(std::lround(rig.latency * rig.sampleRate));
    Gaussian noise(rig.seed + 3000);
    std::vector<std::vector<float>> channels;
    for (const std::size_t input : wiring.inputs)
    {
        if (input < axes)
        {
            channels.push_back(moved[input]);
            continue;
        }
        std::vector<float>& channel = channels.emplace_back(moved[0].size());
        for (std::size_t n = 0; n < channel.size(); ++n)
        {
            channel[n] = 1e-4f * static_cast<float>(noise.next());
            if (input == loopback && n >= latency && n - latency < played.size())
                channel[n] += played[n - latency];
        }
    }
    return channels;
}
} // namespace

SimulatedMeasureRig::SimulatedMeasureRig(RigParams params, double wantedSpeed)
    : rig(std::move(params)), speed(wantedSpeed)
{
    rig.axes = axes;
    rig.driftPpm = 0.0; // one device for both
}

SimulatedMeasureRig::~SimulatedMeasureRig() = default;

RigParams SimulatedMeasureRig::paramsOf(const Profile& actuator)
{
    RigParams params;
    params.body = actuator.body;
    params.resonance = actuator.resonance;
    params.polynomial = {0.0, 1.0, 0.0, -0.05}; // a little of the third harmonic
    return params;
}

RigPorts SimulatedMeasureRig::ports()
{
    return {.name = "Simulated actuator",
            .outputs = {"Actuator", "Nothing connected"},
            .inputs = {"Sensor, axis x", "Sensor, axis y", "Sensor, axis z", "Drive signal", "Nothing connected"},
            .sampleRate = rig.sampleRate,
            .problem = {}};
}

RigParams SimulatedMeasureRig::worn() const
{
    RigParams params = rig;
    const auto wearer = static_cast<unsigned>(placement % (simulatedWearers + 1));
    if (params.body)
        params.body = bodyOn(wearer, *params.body);
    params.seed += placement;
    return params;
}

Result<void> SimulatedMeasureRig::start(std::vector<float> signal)
{
    stop();
    seconds = static_cast<double>(signal.size()) / rig.sampleRate + rig.tail;
    coming = std::async(std::launch::async, record, std::move(signal), worn(), wired);
    begin = std::chrono::steady_clock::now();
    shown.assign(wired.inputs.size(), 0);
    playing = true;
    return {};
}

void SimulatedMeasureRig::stop()
{
    // Waiting for the thread would hold up whoever asks.
    if (coming.valid())
        unwanted.push_back(std::move(coming));
    std::erase_if(unwanted, [](const std::future<Channels>& one)
                  { return one.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
    playing = false;
    recording.clear();
}

bool SimulatedMeasureRig::computed() const
{
    return !recording.empty() ||
           (coming.valid() && coming.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
}

double SimulatedMeasureRig::share() const
{
    if (!(speed > 0.0))
        return computed() ? 1.0 : 0.0;
    const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::min(1.0, speed * passed / seconds);
}

void SimulatedMeasureRig::settle()
{
    if (recording.empty() && computed())
        recording = coming.get();
}

RigState SimulatedMeasureRig::state() const
{
    if (!playing)
        return RigState::idle;
    return share() >= 1.0 && computed() ? RigState::finished : RigState::playing;
}

double SimulatedMeasureRig::progress() const
{
    return playing ? share() : 0.0;
}

std::vector<std::vector<float>> SimulatedMeasureRig::takeRecording()
{
    settle();
    playing = false;
    return std::exchange(recording, {});
}

float SimulatedMeasureRig::takePeak(std::size_t input)
{
    if (input >= wired.inputs.size())
        return 0.0f;
    settle();
    if (playing && input < recording.size())
    {
        const auto& channel = recording[input];
        const auto to = static_cast<std::size_t>(share() * static_cast<double>(channel.size()));
        float peak = 0.0f;
        for (std::size_t& n = shown[input]; n < to; ++n)
            peak = std::max(peak, std::abs(channel[n]));
        return peak;
    }
    const std::size_t port = wired.inputs[input];
    const double drive = tone && wired.output == actuatorOutput ? Decibels(*tone).gain() : 0.0;
    if (port == loopback)
        return static_cast<float>(tone ? Decibels(*tone).gain() : 0.0) + 4e-4f;
    if (port > loopback)
        return 4e-4f;
    const RigParams params = worn();
    const auto along = std::abs(detail::randomDirection(params.seed)[port]);
    const auto down = std::abs(detail::randomDirection(params.seed + 1000)[port]);
    const double moved = drive * Decibels(rigLevel(params, testToneFrequency)).gain();
    return static_cast<float>(std::min(1.0, (along * moved + standardGravity * down) / params.range)) + noiseOf(params);
}

} // namespace pacini
