#pragma once

// Conversion of drive signals to the states of a controller, packet after packet.

#include "devices/ControllerReports.h"
#include "devices/PacketStates.h"
#include "devices/RumbleSource.h"

#include <pacini/filters/Butterworth.h>
#include <pacini/filters/RationalDecimator.h>

#include <array>
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

/// Two tones by which a drive signal is described for a packet, and the event that begins in it.
///
/// Two Butterworth filters, whose powers add up to that of the signal, part it at the border of the carriers of HD
/// rumble. The amplitude of a tone is that of a sinusoid of the same power, not above the peak; its frequency is that
/// of a sinusoid whose steps from sample to sample have the same power: exact for one sinusoid, and the mean weighted
/// by power for many. A tone that leaks through the other filter so keeps its frequency; the mapper of tones joins it
/// with its other half. An event is a level that doubles within a packet.
class DriveMeasure
{
public:
    explicit DriveMeasure(double sampleRate);

    /// At most DriveRumble::blockFrames. [worker]
    void add(std::span<const float> samples) noexcept;

    /// Of all samples since the last call. [worker]
    [[nodiscard]] PacketContent take();

private:
    struct Part
    {
        Butterworth filter;
        double last = 0.0;
        double power = 0.0; ///< sum over the packet
        double peak = 0.0;
        double pitchPower = 0.0; ///< of some packets, the newest most
        double pitchSteps = 0.0;
    };
    [[nodiscard]] RumbleTone toneOf(Part& part) const noexcept;

    double fs;
    std::array<Part, 2> parts; ///< low, high
    std::vector<float> scratch;
    std::size_t frames = 0;
    double peak = 0.0;     ///< of the packet
    double heldPeak = 0.0; ///< of those before, fading
};

/// Converts drive signals, pulled by the controller's thread, to states of a controller. One signal plays on both
/// sides; of more, the first two play left and right. It never ends.
class DriveRumble : public RumbleSource
{
public:
    static constexpr std::size_t blockFrames = 256;

    /// Whether a controller can be sent a drive signal of this rate (Hz): what plays samples takes whole numbers that
    /// are not below its own. [any]
    [[nodiscard]] static bool takesRate(double sampleRate, const ControllerModel& controller) noexcept;

    /// `channels` 1 to 16, `sampleRate` such as takesRate().
    DriveRumble(DriveRenderer renderer, std::size_t channels, double sampleRate, const ControllerModel& controller);

    /// Pulls the frames of the packet; those of packets that were left out are pulled and not played, but no more than
    /// a second of them: after a longer standstill the signal goes on where it was. [worker]
    [[nodiscard]] std::optional<RumbleState> at(std::int64_t packet) override;

private:
    void pull(std::size_t frames);
    [[nodiscard]] PcmBlock samplesOf();
    [[nodiscard]] std::size_t sides() const noexcept { return channels.size() > 1 ? 2 : 1; }

    DriveRenderer render;
    double fs;
    ControllerModel model;
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
