#pragma once

// Conversion of drive signals to the states of a controller, packet after packet.

#include "devices/ControllerReports.h"
#include "devices/DriveMeasure.h"
#include "devices/PacketStates.h"
#include "devices/RumbleSource.h"

#include <pacini/filters/RationalDecimator.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace pacini::devices
{

/// Writes the next frames of every channel; all spans are of the same length, 1 to DriveRumble::blockFrames.
using DriveRenderer = std::function<void(std::span<const std::span<float>>)>;

/// Says whether an event begins with a packet; asked for one after another.
using DriveEvents = std::function<bool(std::int64_t packet)>;

/// Converts drive signals, pulled by the controller's thread, to states of a controller. One signal plays on both
/// sides; of more, the first two play left and right. It never ends.
class DriveRumble : public RumbleSource
{
public:
    static constexpr std::size_t blockFrames = DriveMeasure::blockFrames;

    /// Whether a controller can be sent a drive signal of this rate (Hz): what plays samples takes whole numbers that
    /// are not below its own. [any]
    [[nodiscard]] static bool takesRate(double sampleRate, const ControllerModel& controller) noexcept;

    /// `channels` 1 to 16, `sampleRate` such as takesRate(). Without `events` they are found in the signals.
    DriveRumble(DriveRenderer renderer, std::size_t channels, double sampleRate, const ControllerModel& controller,
                DriveEvents events = {});

    /// Pulls the frames of the packet; those of packets that were left out are pulled and not played, but no more than
    /// a second of them: after a longer standstill the signal goes on where it was. [worker]
    [[nodiscard]] std::optional<RumbleState> at(std::int64_t packet) override;

private:
    void pull(std::size_t frames);
    [[nodiscard]] PcmBlock samplesOf();
    [[nodiscard]] std::size_t sides() const noexcept { return channels.size() > 1 ? 2 : 1; }

    DriveRenderer render;
    DriveEvents events;
    double fs;
    std::optional<SampleStream> stream;
    double framesPerPacket;
    std::vector<std::vector<float>> channels;
    std::vector<std::span<float>> outputs;
    std::int64_t nextPacket = 0;
    double owed = 0.0; ///< frames, less than 1: packets are not always whole numbers of them
    std::vector<DriveMeasure> measures;
    PacketStates states;
    std::vector<RationalDecimator> decimators; ///< for samples
    std::vector<std::vector<float>> decimated;
};

} // namespace pacini::devices
