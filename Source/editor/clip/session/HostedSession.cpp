// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/HostedSession.h"

#include "document/ProjectJson.h"

namespace pacini::editor
{

namespace
{
constexpr int blocksOfFade = 8; // more than the fade of a stop in blocks of 64 frames at 96 kHz
}

HostedSession::~HostedSession()
{
    cancelPendingUpdate();
}

Session& HostedSession::session()
{
    if (!open)
    {
        auto made = std::make_unique<Session>(EditorModel::Folders{}, listProfiles());
        subscriptions.on({&made->model.projectChanged}, [this] { keep(); });
        {
            const juce::SpinLock::ScopedLockType lock(playing);
            open = std::move(made);
        }
        update();
    }
    return *open;
}

void HostedSession::prepare(double sampleRate)
{
    rate.store(sampleRate);
    if (juce::MessageManager::existsAndIsCurrentThread())
        update();
    else
        triggerAsyncUpdate();
}

void HostedSession::handleAsyncUpdate()
{
    update();
}

void HostedSession::update()
{
    if (!open)
        return;
    if (const double wanted = rate.load(); wanted > 0.0 && wanted != preparedRate)
    {
        const juce::SpinLock::ScopedLockType lock(playing);
        open->player.prepare(wanted);
        preparedRate = wanted;
    }
    std::optional<Project> project;
    {
        const std::lock_guard lock(mutex);
        project.swap(brought);
    }
    if (project)
        open->model.openProject(std::move(*project));
}

bool HostedSession::process(std::span<float> haptic, std::span<const std::span<float>> sound) noexcept
{
    const juce::SpinLock::ScopedTryLockType lock(playing);
    if (!lock.isLocked() || !open || preparedRate != rate.load(std::memory_order_relaxed))
        return false;
    if (open->player.isPlaying())
        restBlocks = blocksOfFade;
    else if (restBlocks == 0)
        return false;
    else
        --restBlocks;
    open->player.process(haptic, sound);
    return true;
}

void HostedSession::keep()
{
    const std::lock_guard lock(mutex);
    kept = open->model.document().project();
}

std::string HostedSession::text() const
{
    Project project;
    {
        const std::lock_guard lock(mutex);
        project = brought ? *brought : kept;
    }
    if (project == Project{})
        return {};
    std::string text = projectJson(project);
    return text.size() <= largestText ? text : std::string();
}

Result<void> HostedSession::setText(const std::string& text)
{
    Project project;
    if (!text.empty())
    {
        auto read = readProjectJson(text);
        if (!read)
            return read.error();
        project = std::move(read->project);
    }
    {
        const std::lock_guard lock(mutex);
        if (project == (brought ? *brought : kept))
            return {};
        brought = std::move(project);
    }
    if (juce::MessageManager::existsAndIsCurrentThread())
        update();
    else
        triggerAsyncUpdate();
    return {};
}

} // namespace pacini::editor
