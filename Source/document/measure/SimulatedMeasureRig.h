#pragma once

// Simulated measurement rig, to try a measurement without an actuator.

#include "document/measure/MeasureRig.h"

#include <pacini/actuator/Profile.h>
#include <pacini/linearize/SimulatedRig.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <vector>

namespace pacini
{

/// An actuator on a wearer, with a sensor of three axes, and, for mistakes to be made, an output and an input with
/// nothing on it and an input that carries the drive. Each placement is another wearer.
class SimulatedMeasureRig final : public MeasureRig
{
public:
    /// `speed`: how many times as fast as in truth sweeps are played; 0: as fast as can be.
    SimulatedMeasureRig(RigParams params, double speed);
    ~SimulatedMeasureRig() override;

    /// The rig of an actuator, which has a body.
    [[nodiscard]] static RigParams paramsOf(const Profile& actuator);

    [[nodiscard]] RigPorts ports() override;
    void wire(const RigWiring& wiring) override { wired = wiring; }
    Result<void> start(std::vector<float> signal) override;
    void stop() override;
    [[nodiscard]] RigState state() const override;
    [[nodiscard]] double progress() const override;
    [[nodiscard]] std::vector<std::vector<float>> takeRecording() override;
    [[nodiscard]] float takePeak(std::size_t input) override;
    void setTone(std::optional<double> level) override { tone = level; }
    [[nodiscard]] std::optional<double> fullScale() const override { return rig.range; }
    void setPlacement(std::size_t index) override { placement = index; }

private:
    using Channels = std::vector<std::vector<float>>;

    [[nodiscard]] RigParams worn() const;
    [[nodiscard]] double share() const; ///< of the time that playing takes
    [[nodiscard]] bool computed() const;
    void settle();

    RigParams rig;
    double speed;
    RigWiring wired;
    std::size_t placement = 0;
    std::optional<double> tone;

    bool playing = false;
    double seconds = 0.0; ///< that playing takes
    std::chrono::steady_clock::time_point begin;
    std::future<Channels> coming;
    std::vector<std::future<Channels>> unwanted; ///< of sweeps that were stopped
    Channels recording;
    std::vector<std::size_t> shown; ///< frames of each input that its meter has seen
};

} // namespace pacini
