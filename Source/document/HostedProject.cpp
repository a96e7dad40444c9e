#include "document/HostedProject.h"

#include "document/ProjectJson.h"

#include <utility>

namespace pacini
{

namespace
{
constexpr int blocksOfFade = 8; // more than the fade of a stop in blocks of 64 frames at 96 kHz
}

void HostedProject::prepare(double sampleRate)
{
    rate.store(sampleRate);
    if (onChange)
        onChange();
}

bool HostedProject::process(std::span<float> haptic, std::span<const std::span<float>> sound) noexcept
{
    const std::unique_lock lock(playing, std::try_to_lock);
    if (!lock.owns_lock() || player == nullptr || preparedRate != rate.load(std::memory_order_relaxed))
        return false;
    if (player->isPlaying())
        restBlocks = blocksOfFade;
    else if (restBlocks == 0)
        return false;
    else
        --restBlocks;
    player->process(std::span(&haptic, 1), sound);
    return true;
}

std::string HostedProject::text() const
{
    Project project;
    {
        const std::lock_guard lock(mutex);
        project = brought ? *brought : kept;
    }
    if (project == Project{})
        return {};
    std::string text = projectJson(project);
    if (text.size() > largestText)
    {
        // Rather the clips without their sounds than nothing.
        for (AudioReference& sound : project.sources)
            sound.embedded.reset();
        text = projectJson(project);
    }
    return text.size() <= largestText ? text : std::string();
}

Result<void> HostedProject::setText(const std::string& text)
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
    if (onChange)
        onChange();
    return {};
}

void HostedProject::setPlayer(ClipPlayer* wanted)
{
    const std::lock_guard lock(playing);
    player = wanted;
    preparedRate = 0.0;
}

std::optional<Project> HostedProject::take()
{
    if (const double wanted = rate.load(); player != nullptr && wanted > 0.0 && wanted != preparedRate)
    {
        const std::lock_guard lock(playing);
        player->prepare(wanted);
        preparedRate = wanted;
    }
    const std::lock_guard lock(mutex);
    return std::exchange(brought, std::nullopt);
}

void HostedProject::keep(Project project)
{
    const std::lock_guard lock(mutex);
    kept = std::move(project);
}

} // namespace pacini
