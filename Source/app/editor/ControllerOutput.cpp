// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/ControllerOutput.h"

#include "editor/Text.h"

namespace pacini::app
{

namespace
{
constexpr int pollInterval = 30;           // ms
constexpr juce::uint32 restartDelay = 200; // ms after the last edit
constexpr double shortestLoop = 0.05;      // s
constexpr double nearStart = 0.02;         // s
} // namespace

ControllerOutput::ControllerOutput(editor::Session& shared) : session(shared)
{
    session.listeners.add(this);
}

ControllerOutput::~ControllerOutput()
{
    session.listeners.remove(this);
}

Result<void> ControllerOutput::choose(const std::optional<devices::Controller>& wanted)
{
    silence();
    target.reset();
    controller.reset();
    if (!wanted)
        return {};
    auto opened = devices::OpenController::open(wanted->path);
    if (!opened)
        return opened.error();
    const auto understood = devices::modelOf(*wanted, **opened);
    if (!understood)
        return understood.error();
    target = std::move(opened).value();
    model = *understood;
    controller = wanted;
    start();
    return {};
}

void ControllerOutput::silence()
{
    stopTimer();
    restartAt = 0;
    player.reset();
    clock.reset();
}

void ControllerOutput::start()
{
    silence();
    const auto clip = session.clip();
    if (!target || !clip || !session.isPlaying() || session.heard() == editor::Heard::sound)
        return;
    const double here = session.playhead();
    devices::PlayRange range{Seconds(here), Seconds(clip->duration), false};
    if (session.isLooping())
    {
        // From the middle of a loop it plays to its end, and from then on whole passes.
        const TimeRange looped = session.timeRange().value_or(TimeRange{0.0, clip->duration});
        range = {Seconds(here), Seconds(looped.to), false};
        if (here - looped.from < nearStart && looped.to - looped.from >= shortestLoop)
            range = {Seconds(looped.from), Seconds(looped.to), true};
    }
    loops = range.loop;
    lastPlayhead = here;
    startTimer(pollInterval);
    if (range.from.value >= range.to.value)
        return;
    clock = std::make_unique<devices::SteadyClock>();
    player = std::make_unique<devices::RumblePlayer>(model, devices::ClipRumble(*clip, range, Decibels(0.0), model),
                                                     *target, *clock);
}

void ControllerOutput::sessionChanged(unsigned changes)
{
    if (!target)
        return;
    if ((changes & editor::Session::playback) != 0)
        start();
    else if ((changes & (editor::Session::content | editor::Session::range)) != 0 && session.isPlaying())
        restartAt = juce::Time::getMillisecondCounter() + restartDelay;
}

void ControllerOutput::timerCallback()
{
    if (!session.isPlaying())
        return silence();
    const double here = session.playhead();
    const bool jumpedBack = here < lastPlayhead && !loops;
    lastPlayhead = here;
    if (player && !player->isPlaying())
        tellFailure();
    else if (jumpedBack || (restartAt != 0 && juce::Time::getMillisecondCounter() >= restartAt))
        start();
}

/// What has ended before the end of the clip, such as by a pulled plug.
void ControllerOutput::tellFailure()
{
    const auto result = player->finish();
    player.reset();
    if (result)
        return;
    const juce::String name = editor::toText(controller->name);
    (void)choose(std::nullopt);
    if (session.onError)
        session.onError(name + " does not play any more", editor::toText(result.error().text()));
}

} // namespace pacini::app
