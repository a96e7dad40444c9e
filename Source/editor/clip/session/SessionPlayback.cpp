// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Session.h"

#include <algorithm>

namespace pacini::editor
{

void Session::sendPlayback()
{
    Playback wanted;
    wanted.source = hear != Heard::haptic;
    wanted.haptic = hear != Heard::sound;
    if (looping && clip())
        wanted.loop = rangeNow.value_or(TimeRange{0.0, clip()->duration});
    const auto shown = item();
    wanted.a = preview ? preview : shown ? shown->clip : nullptr;
    wanted.b = keptVersion();
    wanted.take = comparing ? Take::b : Take::a;
    wanted.audition = auditionNow;
    player.set(std::move(wanted));
}

void Session::setTimeRange(std::optional<TimeRange> wanted)
{
    if (wanted && clip())
        wanted = withinClip(*wanted, clip()->duration);
    if (wanted && wanted->to <= wanted->from)
        wanted.reset();
    if (wanted == rangeNow)
        return;
    rangeNow = wanted;
    sendPlayback();
    changed(range);
}

void Session::setLooping(bool wanted)
{
    looping = wanted;
    sendPlayback();
    changed(range);
}

void Session::setHeard(Heard wanted)
{
    hear = wanted;
    sendPlayback();
    changed(playback);
}

void Session::setAudition(Audition wanted)
{
    auditionNow = std::move(wanted);
    sendPlayback();
    changed(playback);
}

void Session::addProfile(NamedProfile added, bool use)
{
    const auto same = std::find_if(shelf.begin(), shelf.end(),
                                   [&](const NamedProfile& entry) { return entry.own && entry.name == added.name; });
    const std::string name = added.name;
    const bool changesCurrent = name == profileName();
    if (same != shelf.end())
        *same = std::move(added);
    else
        shelf.push_back(std::move(added));
    changed(profileList);
    if (use && changesCurrent)
        chooseProfile(name); // another content under its name
    else if (use)
        setProfile(name);
}

void Session::setProfile(const std::string& name)
{
    if (name != profileName())
        chooseProfile(name);
}

void Session::chooseProfile(const std::string& name)
{
    ProjectProfile wanted;
    wanted.name = name;
    for (const NamedProfile& entry : shelf)
        if (entry.name == name && entry.own)
            wanted.embedded = *entry.profile;
    if (!take(open->setProfile(std::move(wanted), "Choose actuator")))
        return;
    player.setProfile(profile());
    follow();
    changed(project | playback);
}

std::shared_ptr<const Profile> Session::profile() const
{
    const ProjectProfile& chosen = open->project().profile;
    if (chosen.embedded)
        return std::make_shared<const Profile>(*chosen.embedded);
    for (const NamedProfile& entry : shelf)
        if (entry.name == chosen.name)
            return entry.profile;
    return nullptr;
}

void Session::play()
{
    const auto now = clip();
    if (!now)
        return;
    if (startTime >= now->duration - 1e-3)
        startTime = 0.0;
    if (looping && rangeNow && (startTime < rangeNow->from || startTime >= rangeNow->to))
        startTime = rangeNow->from;
    player.play(startTime);
    changed(playback);
}

void Session::stop()
{
    player.stop();
    changed(playback);
}

double Session::playhead() const
{
    return player.isPlaying() ? player.position() : startTime;
}

void Session::setPlayhead(double time)
{
    startTime = clip() ? std::clamp(time, 0.0, clip()->duration) : 0.0;
    if (player.isPlaying())
        player.play(startTime);
    changed(playback);
}

} // namespace pacini::editor
