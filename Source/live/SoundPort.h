#pragma once

// Sound devices that a live sound comes from, or a drive signal goes to.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pacini::live
{

/// Receives interleaved frames, on the device's own thread. [audio]
using SoundTaker = std::function<void(std::span<const float> interleaved, std::size_t channels)>;

/// Fills one channel, which all channels of the device play, on the device's own thread. [audio]
using SoundMaker = std::function<void(std::span<float> frames)>;

/// A sound device that can be named, see SoundPort.
struct SoundDevice
{
    std::string name;        ///< SYSTEM:NAME
    std::string description; ///< for people; may be empty
    int inputs = 0;          ///< channels, as the next
    int outputs = 0;
};

/// An open sound device, by RtAudio. A device is named as SYSTEM or SYSTEM:NAME. The systems are those that RtAudio was
/// built with: jack, pulse, alsa, core. NAME is a part of a device's name; of pulse, the whole name of a source
/// or a sink. Without a name it is the default device; jack then leaves its ports for the user to connect.
class SoundPort
{
public:
    /// The systems that can be named.
    [[nodiscard]] static std::vector<std::string> systems();

    /// The devices of all systems that run. [message]
    [[nodiscard]] static std::vector<SoundDevice> devices();

    /// Opens a device to take at most two channels from. Errors: invalidArgument (no such system), io, with what the
    /// system says. [message]
    [[nodiscard]] static Result<std::unique_ptr<SoundPort>> openInput(const std::string& named);

    /// Opens a device to play on. Errors likewise. [message]
    [[nodiscard]] static Result<std::unique_ptr<SoundPort>> openOutput(const std::string& named);

    /// Opens the sound device of a DualSense on a cable, a card of ALSA, to play on its coils (channels 3 and 4): the
    /// sink of PulseAudio that has this card, or else ALSA's own device. Not tried on one. Errors: io. [message]
    [[nodiscard]] static Result<std::unique_ptr<SoundPort>> openDualSense(int card);

    virtual ~SoundPort() = default;

    [[nodiscard]] virtual double sampleRate() const = 0;
    [[nodiscard]] virtual std::size_t blockFrames() const = 0;

    /// Starts; one of the two, once. Errors: io. [message]
    [[nodiscard]] virtual Result<void> take(SoundTaker taker) = 0;
    [[nodiscard]] virtual Result<void> play(SoundMaker maker) = 0;

    /// Returns when nothing is called any more. [message]
    virtual void stop() = 0;

    /// Whether it still runs. [message]
    [[nodiscard]] virtual bool isRunning() = 0;

    /// How many blocks it has asked for or handed in. [any]
    [[nodiscard]] virtual std::uint64_t blocks() const = 0;

    /// How often the device came too late or too early. [any]
    [[nodiscard]] virtual std::uint64_t interruptions() const = 0;
};

} // namespace pacini::live
