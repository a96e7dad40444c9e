// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Player.h"

#include <cmath>

namespace pacini::editor
{

void Player::prepare(double sampleRate)
{
    if (engine && rate == sampleRate)
        return;
    worker.reset();
    rate = sampleRate;
    engine = std::make_unique<PreviewEngine>(rate);
    worker = std::make_unique<PreviewWorker>(*engine);
    engine->set(playback);
    engine->setProfile(profile);
    if (sound)
        resample();
}

void Player::set(Playback wanted)
{
    playback = std::move(wanted);
    engine->set(playback);
    worker->wake();
}

void Player::setProfile(std::shared_ptr<const Profile> wanted)
{
    profile = std::move(wanted);
    engine->setProfile(profile);
    worker->wake();
}

void Player::setSound(std::shared_ptr<const Sound> wanted)
{
    if (sound == wanted)
        return;
    sound = std::move(wanted);
    engine->setSource(nullptr);
    if (sound)
        resample();
}

void Player::resample()
{
    jobs.run([from = sound, to = rate] { return PreviewSource::of(from->audio, static_cast<int>(std::lround(to))); },
             [this, from = sound, to = rate](std::shared_ptr<const PreviewSource> made)
             {
                 if (from != sound || to != rate)
                     return;
                 engine->setSource(std::move(made));
                 worker->wake();
             });
}

void Player::play(double time)
{
    engine->play(time);
    worker->wake();
}

} // namespace pacini::editor
