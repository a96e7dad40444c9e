// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Transport.h"

#include <algorithm>
#include <utility>

namespace pacini::editor
{

Transport::Transport(const EditorModel& project, const ProjectSounds& projectSounds, const Actuators& profiles,
                     const HapticOutputs& hapticOutputs, const ClipSelection& selected, ClipPlayer& played)
    : model(project),
      sounds(projectSounds),
      actuators(profiles),
      outputs(hapticOutputs),
      selection(selected),
      player(played)
{
    subscriptions.on({&model.shownChanged}, [this] { reset(); });
    subscriptions.on({&model.contentChanged, &model.versionChanged, &selection.rangeChanged}, [this] { send(); });
    subscriptions.on({&model.contentChanged, &sounds.changed},
                     [this]
                     {
                         if (!lent)
                             player.setSound(audioOf(sounds.soundOfClip()));
                     });
    subscriptions.on({&actuators.changed, &actuators.listChanged, &outputs.changed},
                     [this] { player.setRow(outputs.row(actuators)); });
}

/// For another clip.
void Transport::reset()
{
    endScrub();
    player.stop();
    auditionNow = {};
    startTime = 0.0;
    changed.emit();
}

void Transport::send()
{
    Playback wanted;
    wanted.source = hear != Heard::haptic;
    wanted.haptic = hear != Heard::sound;
    const auto clip = model.clip();
    // An edit or its undo may have made it shorter.
    if (const double end = clip ? clip->duration : 0.0; startTime > end && !model.isShowingUnanalysed())
    {
        startTime = end;
        changed.emit();
    }
    if (looping && clip)
        wanted.loop = selection.timeRange().value_or(TimeRange{0.0, clip->duration});
    const auto item = model.item();
    wanted.a = model.isPreviewing() ? clip : item ? item->clip : nullptr;
    const auto kept = model.keptVersion();
    wanted.b = kept ? kept->clip : nullptr;
    wanted.take = model.isComparing() ? Take::b : Take::a;
    wanted.audition = auditionNow;
    if (!lent)
        player.set(std::move(wanted));
}

void Transport::setLooping(bool wanted)
{
    looping = wanted;
    send();
    loopChanged.emit();
}

void Transport::setHeard(Heard wanted)
{
    hear = wanted;
    send();
    changed.emit();
}

void Transport::lendPlayer()
{
    lent = true;
    endScrub();
    player.stop();
    player.setSound(nullptr);
}

void Transport::takePlayer()
{
    lent = false;
    endScrub();
    player.stop();
    send();
    player.setSound(audioOf(sounds.soundOfClip()));
    changed.emit();
}

void Transport::setAudition(Audition wanted)
{
    auditionNow = std::move(wanted);
    send();
    changed.emit();
}

void Transport::setControls(const PlayControls& wanted)
{
    live = wanted;
    player.setControls(live);
    controlsChanged.emit();
}

void Transport::play()
{
    const auto clip = model.clip();
    if (!clip || !outputs.readyToPlay())
        return;
    endScrub();
    if (startTime >= clip->duration - 1e-3)
        startTime = 0.0;
    if (const auto& range = selection.timeRange();
        looping && range && (startTime < range->from || startTime >= range->to))
        startTime = range->from;
    player.play(startTime);
    changed.emit();
}

void Transport::stop()
{
    endScrub();
    player.stop();
    changed.emit();
}

void Transport::scrub(double time)
{
    constexpr int moment = 90; // ms
    const bool heardNow = scrubbing || !player.isPlaying();
    setPlayhead(time);
    if (!heardNow || !model.clip() || lent || !outputs.canPlay())
        return;
    scrubbing = true;
    player.play(startTime);
    startTimer(moment);
}

void Transport::endScrub()
{
    stopTimer();
    if (std::exchange(scrubbing, false))
        player.stop();
}

double Transport::playhead() const
{
    return isPlaying() ? player.position() : startTime;
}

void Transport::setPlayhead(double time)
{
    const auto clip = model.clip();
    startTime = clip ? std::clamp(time, 0.0, clip->duration) : 0.0;
    if (isPlaying())
        player.play(startTime);
    changed.emit();
}

bool Transport::canSplit() const
{
    const auto clip = model.clip();
    return clip && playhead() > 0.0 && playhead() < clip->duration;
}

} // namespace pacini::editor
