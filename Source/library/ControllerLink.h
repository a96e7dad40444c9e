#pragma once

// A game controller that plays an engine's drive signals, on its own thread.

#include "devices/DriveRumble.h"
#include "devices/OpenController.h"
#include "devices/RumblePlayer.h"
#include "devices/SteadyClock.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace pacini::library
{

/// Plays on a controller until it is destroyed. If the controller stops taking reports, the drive signals are still
/// pulled but not sent, so that plays end as usual.
class ControllerLink
{
public:
    struct Params
    {
        devices::ControllerModel model;
        std::size_t channels = 1;
        double sampleRate = 48000.0;
        bool stopOnCrash = false; ///< installs signal handlers: see devices::EmergencyStop
    };

    /// Starts. [any, may wait]
    ControllerLink(std::unique_ptr<devices::OpenController> openController, devices::DriveRenderer renderer,
                   const Params& params)
        : sink(std::move(openController), params.stopOnCrash),
          player(params.model,
                 std::make_unique<devices::DriveRumble>(std::move(renderer), params.channels, params.sampleRate,
                                                        params.model),
                 sink, clock)
    {
    }

    /// Reports that the controller has taken. [any]
    [[nodiscard]] std::uint64_t sent() const noexcept { return sink.sent.load(std::memory_order_relaxed); }

    /// Why it takes no more; empty while it does. [any, may wait]
    [[nodiscard]] std::string failure()
    {
        const std::lock_guard lock(sink.mutex);
        return sink.failure;
    }

private:
    class Sink : public devices::ReportSink
    {
    public:
        Sink(std::unique_ptr<devices::OpenController> openController, bool stopOnCrash)
            : device(std::move(openController)), handlesSignals(stopOnCrash)
        {
        }

        void prepare(const devices::StopReports& stops) override
        {
            if (handlesSignals)
                device->prepare(stops);
        }

        Result<void> send(const devices::Report& report) override
        {
            if (isGone)
                return {};
            if (const auto done = device->send(report); !done)
            {
                isGone = true;
                const std::lock_guard lock(mutex);
                failure = done.error().message;
            }
            else
                sent.fetch_add(1, std::memory_order_relaxed);
            return {};
        }

        std::atomic<std::uint64_t> sent{0};
        std::mutex mutex;
        std::string failure;

    private:
        std::unique_ptr<devices::OpenController> device;
        bool handlesSignals;
        bool isGone = false; ///< of the player's thread
    };

    Sink sink;
    devices::SteadyClock clock;
    devices::RumblePlayer player; // ends before the others
};

} // namespace pacini::library
