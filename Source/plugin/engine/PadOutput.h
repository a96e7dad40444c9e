// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Game controller that plays the drive of the first haptic channel.

#include "live/LivePad.h"

#include <pacini/foundation/Result.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace pacini::plugin
{

/// What a controller is found and opened by: those of this machine, or those of a test.
struct PadAccess
{
    std::function<Result<std::vector<devices::Controller>>()> list;
    std::function<Result<live::OpenedController>(const devices::Controller&)> open;
};

/// What people and sessions know a controller by: its name, or its path where it has none.
[[nodiscard]] std::string nameOf(const devices::Controller& controller);

/// The controllers that are connected to this machine. A DualSense plays samples where it can.
[[nodiscard]] PadAccess connectedPads();

/// Plays on one controller, from its own thread, as `pacini live` does, and looks for it until it is there. Without a
/// choice it has no thread and no memory. All but drive() may wait for a lock, for no longer than a word takes to copy.
class PadOutput
{
public:
    /// What became of the choice, for people.
    struct Status
    {
        std::string name;    ///< of the chosen controller; empty: none
        std::string path;    ///< where it was found last; empty: not yet
        bool plays = false;  ///< it is connected
        std::string trouble; ///< why it does not play, as the rest of a sentence about it; empty: nothing is known
        std::string lesser;  ///< why it plays by rumble what it could play as samples, likewise

        bool operator==(const Status&) const = default;
    };

    explicit PadOutput(PadAccess wanted = connectedPads());
    PadOutput(const PadOutput&) = delete;
    PadOutput& operator=(const PadOutput&) = delete;
    /// Silences the controller.
    ~PadOutput();

    /// Of a test, before the first choice. [message]
    void setAccess(PadAccess wanted) { access = std::move(wanted); }

    /// Silences the controller also when the program crashes: see devices::EmergencyStop. For a program of our own; a
    /// host keeps its signals. Before the first choice. [message]
    void setStopsOnCrash(bool wanted) noexcept { stopsOnCrash = wanted; }

    /// The connected controllers. Errors: those of PadAccess::list. [message]
    [[nodiscard]] Result<std::vector<devices::Controller>> connected() const { return access.list(); }

    /// Chooses a controller by its name; empty: none. Of several with this name, that at `path`. The same name again
    /// changes nothing. [any but audio]
    void choose(const std::string& name, const std::string& path = {});

    /// Whether a connected controller is the chosen one. [message]
    [[nodiscard]] bool isChosen(const devices::Controller& controller) const;

    /// The rate of what is pushed, Hz. [any but audio]
    void prepare(double sampleRate);

    /// [any but audio]
    [[nodiscard]] Status status() const;

    /// Where the drive goes; null: nowhere. Stays valid until this ends. [audio]
    [[nodiscard]] live::LiveDrive* drive() const noexcept { return listening.load(std::memory_order_acquire); }

private:
    struct Wanted
    {
        std::string name, path;
        double fs = 48000.0; ///< Hz
        bool operator==(const Wanted&) const = default;
    };

    void work();
    [[nodiscard]] std::unique_ptr<live::LivePad> padFor(const Wanted& meant);
    [[nodiscard]] bool isStillThere(const Wanted& meant);
    void note(const Wanted& of, const live::LivePad& pad, const live::PadNews& news);
    [[nodiscard]] Result<devices::Controller> find(const Wanted& meant);

    PadAccess access;
    bool stopsOnCrash = false;

    mutable std::mutex mutex; ///< of the members up to the thread
    std::condition_variable changed;
    Wanted choice;
    Status now;
    bool ending = false;
    std::unique_ptr<live::LiveDrive> queue; ///< lasts, once there was a choice
    std::thread thread;

    std::atomic<live::LiveDrive*> listening{nullptr};
};

} // namespace pacini::plugin
