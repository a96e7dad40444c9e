// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Playback of the edited clip on phones in the local network.

#include "editor/clip/session/Transport.h"
#include "phone/PhoneServer.h"

#include <memory>

namespace pacini::app
{

/// Follows the session as ControllerOutput does, while a server runs: off until it is asked for, and with the window.
/// [message]
class PhoneOutput final : private juce::Timer
{
public:
    PhoneOutput(const editor::EditorModel& project, const editor::Transport& playing);

    /// Errors: those of PhoneServer::start().
    Result<void> start();
    void end();

    /// Null: it does not run.
    [[nodiscard]] const phone::PhoneServer* server() const noexcept { return running.get(); }

private:
    void timerCallback() override;
    void show();
    void follow();

    const editor::EditorModel& edited;
    const editor::Transport& transport;
    std::unique_ptr<phone::PhoneServer> running;
    juce::uint32 showAt = 0; ///< ms, 0: phones have the clip as it is
    double lastPlayhead = 0.0;
    editor::Subscriptions subscriptions;
};

} // namespace pacini::app
