// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Editing session of a project that the plugin's host keeps.

#include "document/HostedProject.h"
#include "editor/clip/session/Session.h"

#include <juce_events/juce_events.h>

#include <memory>

namespace pacini::plugin
{

/// There is no session, and so no thread of its own, before anyone asks for it.
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
