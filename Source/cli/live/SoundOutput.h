#pragma once

// Sound device that plays a live drive signal, and plays again when it is back.

#include "cli/Console.h"
#include "live/LiveDrive.h"
#include "live/SoundPort.h"
#include "live/TrackedDrive.h"

#include <pacini/foundation/Units.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace pacini::cli
{

/// Tells whether a sound device still asks for sound: a driver may fall silent without saying so.
class Heartbeat
{
public:
    /// `blocks` counts what the device has asked for so far. [message]
    [[nodiscard]] bool beats(std::uint64_t blocks) noexcept
    {
        const auto now = Clock::now();
        if (blocks != last)
        {
            last = blocks;
            since = now;
        }
        return now - since < longest;
    }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds longest{1500};

    std::uint64_t last = 0;
    Clock::time_point since = Clock::now();
};

/// Plays a drive signal on a sound device, at the device's own clock. [message]
class SoundOutput
{
public:
    /// The drive has the rate `fs`, Hz, and comes in blocks of `blockSeconds`; it outlives this.
    SoundOutput(std::string device, live::LiveDrive& from, double fs, Seconds blockSeconds)
        : named(std::move(device)), source(from), sourceRate(fs), comes(blockSeconds.value)
    {
    }

    /// Errors: those of live::SoundPort::openOutput() and play().
    [[nodiscard]] Result<void> open()
    {
        constexpr double margin = 0.002; // s
        auto opened = live::SoundPort::openOutput(named);
        if (!opened)
            return opened.error();
        const double goes = static_cast<double>((*opened)->blockFrames()) / (*opened)->sampleRate(); // s
        auto next =
            std::make_unique<live::TrackedDrive>(source, sourceRate, (*opened)->sampleRate(),
                                                 static_cast<std::size_t>((comes + goes + margin) * sourceRate));
        auto started = (*opened)->play([reader = next.get()](std::span<float> frames) { reader->read(frames); });
        if (!started)
            return started;
        port = std::move(*opened);
        drive = std::move(next);
        heartbeat = {};
        isSilent = false;
        ++opens;
        return {};
    }

    /// Says when the device falls silent or goes away, and opens it again when it is back. Not on the audio thread.
    void look(Console& console)
    {
        const auto now = Clock::now();
        if (port && !port->isRunning())
        {
            before += drive->standstills();
            port.reset();
            tried = now;
            console.warning(named, "does not answer any more; it plays again when it is back");
        }
        else if (port)
        {
            // A driver that hangs may never return from closing it, so it is left open.
            const bool beats = heartbeat.beats(port->blocks());
            if (!beats && !isSilent)
                console.warning(named, "asks for no sound any more, so nothing is felt there");
            else if (beats && isSilent)
                console.note(named + " plays again");
            isSilent = !beats;
        }
        else if (now - tried >= betweenTries)
        {
            tried = now;
            if (open())
                console.note(named + " plays again");
        }
    }

    void stop()
    {
        if (port)
            port->stop();
    }

    /// Whether all is played, or the device is gone.
    [[nodiscard]] bool isDone() const noexcept { return !port || drive->isOver(); }

    [[nodiscard]] const std::string& name() const noexcept { return named; }
    [[nodiscard]] std::size_t standstills() const noexcept { return before + (port ? drive->standstills() : 0); }
    [[nodiscard]] double correction() const noexcept { return drive ? drive->correction() : 1.0; }
    [[nodiscard]] std::size_t connections() const noexcept { return opens; }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds betweenTries{1};

    std::string named;
    live::LiveDrive& source;
    double sourceRate;
    double comes; // s
    std::size_t opens = 0;
    std::size_t before = 0; // standstills of earlier connections
    Clock::time_point tried{};
    Heartbeat heartbeat;
    bool isSilent = false;
    std::unique_ptr<live::TrackedDrive> drive;
    std::unique_ptr<live::SoundPort> port; // ends first
};

} // namespace pacini::cli
