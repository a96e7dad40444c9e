// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/window/HostedSession.h"

#include "io/ShippedProfiles.h"

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
}

Session& HostedSession::session()
{
    if (!open)
    {
        open = std::make_unique<Session>(editor::EditorModel::Folders{}, builtInProfiles());
        subscriptions.on({&open->model.projectChanged}, [this] { hosted.keep(open->model.document().project()); });
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
        open->model.openProject(std::move(*project));
}

} // namespace pacini::plugin
