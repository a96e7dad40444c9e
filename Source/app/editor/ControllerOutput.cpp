// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/ControllerOutput.h"

#include "editor/Text.h"
#include "editor/Translation.h"

namespace pacini::app
{

namespace
{
constexpr int pollInterval = 30;           // ms
constexpr juce::uint32 restartDelay = 200; // ms after the last edit
constexpr double shortestLoop = 0.05;      // s
constexpr double nearStart = 0.02;         // s
} // namespace

ControllerOutput::ControllerOutput(const editor::EditorModel& project, const editor::ClipSelection& selected,
                                   const editor::Transport& playing)
    : edited(project), clipSelection(selected), transport(playing)
{
    subscriptions.on({&transport.changed, &edited.versionChanged},
                     [this]
                     {
                         if (target)
                             start();
                     });
    subscriptions.on({&edited.contentChanged, &clipSelection.rangeChanged, &transport.loopChanged},
                     [this]
                     {
                         if (target && transport.isPlaying())
                             restartAt = juce::Time::getMillisecondCounter() + restartDelay;
                     });
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
    const auto clip = edited.clip();
    if (!target || !clip || !transport.isPlaying() || transport.heard() == editor::Heard::sound)
        return;
    const double here = transport.playhead();
    devices::PlayRange range{Seconds(here), Seconds(clip->duration), false};
    if (transport.isLooping())
    {
        // From the middle of a loop it plays to its end, and from then on whole passes.
        const TimeRange looped = clipSelection.timeRange().value_or(TimeRange{0.0, clip->duration});
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

void ControllerOutput::timerCallback()
{
    if (!transport.isPlaying())
        return silence();
    const double here = transport.playhead();
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
    if (edited.onError)
        edited.onError(editor::tr("{0} stopped playing", {name}), editor::toText(result.error().text()));
}

} // namespace pacini::app
