#pragma once

// Measurement of a drive signal for controllers: tones and events, packet after packet.

#include "devices/PacketContent.h"

#include <pacini/filters/Butterworth.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pacini::devices
{

/// Two tones by which a drive signal is described for a packet, and the event that begins in it.
///
/// The tones have the power of the signal. What stands from packet to packet has the amplitude of a sinusoid, which
/// does not depend on where in its period a packet begins. Two Butterworth filters share the power out at the border of
/// the carriers of HD rumble. The frequency of a tone is that of a sinusoid whose steps from sample to sample have the
/// same power: exact for one sinusoid, and the mean weighted by power for many. A tone that leaks through the other
/// filter so keeps its frequency, and the mapper of tones joins it with its other half.
///
/// An event is a level, over 4 ms, 2.5 times as high as those before, which fade within 35 ms: noise so has few, and a
/// roll has all of its own.
class DriveMeasure
{
public:
    /// The most samples that add() takes at once.
    static constexpr std::size_t blockFrames = 256;

    explicit DriveMeasure(double sampleRate);

    /// At most blockFrames. [worker]
    void add(std::span<const float> samples) noexcept;

    /// Of all samples since the last call. Where it is known whether an event begins with the packet, the signal says
    /// how strong it is. [worker]
    [[nodiscard]] PacketContent take(std::optional<bool> eventBegins = {});

private:
    [[nodiscard]] std::optional<double> eventAt(std::optional<bool> known) noexcept;

    struct Part
    {
        /// Sum over the packet of the squared amplitude of a sinusoid: x[n] - x[n - 1] of one has 2 sin(pi f / fs)
        /// times its amplitude, a quarter of a period later; the squares of both, the second without that factor, add
        /// up to the same at any time.
        [[nodiscard]] double takeSquares() noexcept;
        [[nodiscard]] Hertz pitch(double sampleRate) const noexcept;

        Butterworth filter;
        double last = 0.0;
        double power = 0.0; ///< sum over the packet, as the next
        double steps = 0.0;
        double pitchPower = 0.0; ///< of the packet and those before, the newest most
        double pitchSteps = 0.0;
    };

    double fs;
    std::array<Part, 2> parts; ///< low, high
    std::vector<float> scratch;
    std::size_t frames = 0;   ///< of the packet, as the next
    double power = 0.0;       ///< sum
    double lastSquares = 0.0; ///< of the packet before
    std::size_t shortLength;  ///< frames of 4 ms
    std::size_t shortFrames = 0;
    double shortPower = 0.0;
    double loudest = 0.0;   ///< highest mean square over 4 ms in the packet
    double heldLevel = 0.0; ///< highest level of the packets before, fading
    double lastEvent = 0.0; ///< level of an event in the packet before
};

} // namespace pacini::devices
