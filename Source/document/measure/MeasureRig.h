#pragma once

// Measurement rig: interface to a device that plays on the actuator and records its sensor.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// The connections of a rig.
struct RigPorts
{
    std::string name;
    std::vector<std::string> outputs, inputs;
    std::size_t expectedOutput = 0; ///< of `outputs`: where the actuator is, as far as is known
    double sampleRate = 48000.0;    ///< Hz
    std::string problem;            ///< why nothing can be measured now and what to do, in plain words; empty: it can
};

/// Ports of a rig that are used, counted from 0.
struct RigWiring
{
    std::size_t output = 0;
    std::vector<std::size_t> inputs = {0};                  ///< one to three: a microphone or the axes of a sensor
    std::optional<std::size_t> secondOutput = std::nullopt; ///< plays the same
    bool operator==(const RigWiring&) const = default;
};

enum class RigState
{
    idle,
    playing,
    finished, ///< the recording can be taken
    lost      ///< the device went away or changed while playing
};

/// Plays a signal and records the sensor in sync. [message]
class MeasureRig
{
public:
    virtual ~MeasureRig() = default;

    /// Inputs are heard only while a rig is open.
    virtual void setOpen(bool) {}
    [[nodiscard]] virtual RigPorts ports() = 0;
    /// From now on these inputs are metered, and used by start().
    virtual void wire(const RigWiring& wiring) = 0;

    /// Plays `signal`, which has the rate of the ports.
    virtual Result<void> start(std::vector<float> signal) = 0;
    virtual void stop() = 0;
    [[nodiscard]] virtual RigState state() const = 0;
    [[nodiscard]] virtual double progress() const = 0; ///< 0 to 1
    /// One channel for each input that is wired, once finished; then the rig is idle.
    [[nodiscard]] virtual std::vector<std::vector<float>> takeRecording() = 0;

    /// The largest magnitude of a wired input since the last call, full scale 1.
    [[nodiscard]] virtual float takePeak(std::size_t input) = 0;
    /// A steady sinusoid of this level, dB re full scale, on the wired output; nothing: silence.
    virtual void setTone(std::optional<double> level) = 0;

    /// m/s^2 of a full-scale sample, where the rig knows it.
    [[nodiscard]] virtual std::optional<double> fullScale() const { return std::nullopt; }
    /// How many times the actuator has been put on before the next sweep. Only a simulation needs to be told.
    virtual void setPlacement(std::size_t) {}
};

inline constexpr double testToneFrequency = 100.0; ///< Hz

} // namespace pacini
