#include "document/ClipPlayer.h"

#include "document/PreviewEngine.h"
#include "document/PreviewWorker.h"

#include <utility>

namespace pacini
{

ClipPlayer::ClipPlayer()
{
    prepare(48000.0);
}

ClipPlayer::~ClipPlayer() = default;

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

void ClipPlayer::process(std::span<const std::span<float>> haptic, std::span<const std::span<float>> soundOut) noexcept
{
    engine->process(haptic, soundOut);
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

bool ClipPlayer::isPlaying() const noexcept
{
    return engine->isPlaying();
}

double ClipPlayer::position() const noexcept
{
    return engine->position();
}

PreviewMeters ClipPlayer::takeMeters(std::size_t output)
{
    return engine->takeMeters(output);
}

std::optional<Error> ClipPlayer::lastError() const
{
    return worker->lastError();
}

} // namespace pacini
