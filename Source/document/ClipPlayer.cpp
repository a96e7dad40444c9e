#include "document/ClipPlayer.h"

#include <utility>

namespace pacini
{

void ClipPlayer::prepare(double sampleRate)
{
    if (engine && rate == sampleRate)
        return;
    worker.reset();
    rate = sampleRate;
    engine = std::make_unique<PreviewEngine>(rate);
    worker = std::make_unique<PreviewWorker>(*engine);
    engine->set(playback);
    engine->setRow(row);
    engine->setControls(controls);
    engine->setSource(sound);
}

void ClipPlayer::set(Playback wanted)
{
    playback = std::move(wanted);
    engine->set(playback);
    worker->wake();
}

void ClipPlayer::setRow(PreviewRow wanted)
{
    row = std::move(wanted);
    engine->setRow(row);
    worker->wake();
}

void ClipPlayer::setControls(const PlayControls& wanted)
{
    controls = wanted;
    engine->setControls(controls);
    worker->wake();
}

void ClipPlayer::setSound(std::shared_ptr<const StoredAudio> wanted)
{
    if (sound == wanted)
        return;
    sound = std::move(wanted);
    engine->setSource(sound);
    worker->wake();
}

void ClipPlayer::stop()
{
    engine->stop();
    worker->wake();
}

void ClipPlayer::play(double time)
{
    engine->play(time);
    worker->wake();
}

} // namespace pacini
