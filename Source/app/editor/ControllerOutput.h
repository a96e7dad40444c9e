// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Playback of the edited clip on a game controller or another haptic device.

#include "devices/HidList.h"
#include "devices/OpenController.h"
#include "devices/RumblePlayer.h"
#include "devices/SteadyClock.h"
#include "editor/clip/session/Transport.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pacini::app
{

/// Follows the session: plays and stops with it, from the same position. Edits take effect at the
/// next restart, within a fifth of a second after the last edit. The sender has its own thread.
/// [message]
class ControllerOutput final : private juce::Timer
{
public:
    ControllerOutput(const editor::EditorModel& project, const editor::ClipSelection& selected,
                     const editor::Transport& playing);

    /// Returns the connected controllers. Errors as in connectedControllers().
    [[nodiscard]] static Result<std::vector<devices::Controller>> connected()
    {
        return devices::connectedControllers();
    }

    /// Opens a controller, by its path; none: closes it. Errors: those of OpenController::open() and
    /// modelOf().
    Result<void> choose(const std::optional<devices::Controller>& wanted);
    [[nodiscard]] const std::optional<devices::Controller>& chosen() const noexcept { return controller; }

    /// Whether the chosen controller can play only events.
    [[nodiscard]] bool playsOnlyEvents() const noexcept
    {
        return controller && model.haptics == devices::ControllerHaptics::waveforms && !model.trigger.lasts();
    }

private:
    void timerCallback() override;
    void start();
    void silence();
    void tellFailure();

    const editor::EditorModel& edited;
    const editor::ClipSelection& clipSelection;
    const editor::Transport& transport;
    std::optional<devices::Controller> controller;
    devices::ControllerModel model; ///< of the controller
    juce::uint32 restartAt = 0;     ///< ms, 0: no restart is due
    bool loops = false;             ///< playback returns to the start of the loop by itself
    double lastPlayhead = 0.0;
    std::unique_ptr<devices::OpenController> target;
    std::unique_ptr<devices::SteadyClock> clock;
    std::unique_ptr<devices::RumblePlayer> player; // ends before the others
    editor::Subscriptions subscriptions;
};

} // namespace pacini::app
