// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Editing session of a project that the plugin's host keeps.

#include "document/HostedProject.h"
#include "editor/clip/session/Session.h"

#include <juce_events/juce_events.h>

#include <memory>

namespace pacini::plugin
{

/// The session and its thread are created on first use.
class HostedSession final : private juce::AsyncUpdater
{
public:
    explicit HostedSession(HostedProject& project);
    ~HostedSession() override;

    /// Made at the first call. [message]
    [[nodiscard]] editor::Session& session();

private:
    void handleAsyncUpdate() override { update(); }
    void update();

    HostedProject& hosted;
    std::unique_ptr<editor::Session> open;
    editor::Subscriptions subscriptions;
};

} // namespace pacini::plugin
