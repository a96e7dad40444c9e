// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/window/HostedSession.h"

#include "document/ProfileShelf.h"

#include <utility>

namespace pacini::plugin
{

using editor::Session;

HostedSession::HostedSession(HostedProject& project) : hosted(project)
{
    hosted.onChange = [this]
    {
        if (juce::MessageManager::existsAndIsCurrentThread())
            update();
        else
            triggerAsyncUpdate();
    };
}

HostedSession::~HostedSession()
{
    hosted.onChange = nullptr;
    hosted.setPlayer(nullptr);
    cancelPendingUpdate();
    if (open)
        open->listeners.remove(this);
}

Session& HostedSession::session()
{
    if (!open)
    {
        open = std::make_unique<Session>(Session::Folders{}, shelfProfiles());
        open->listeners.add(this);
        hosted.setPlayer(&open->player);
        update();
    }
    return *open;
}

void HostedSession::update()
{
    if (!open)
        return;
    if (auto project = hosted.take())
        open->openProject(std::move(*project));
}

void HostedSession::sessionChanged(unsigned changes)
{
    if ((changes & (Session::project | Session::content)) != 0)
        hosted.keep(open->document().project());
}

} // namespace pacini::plugin
