#include "document/ClipPlayer.h"

#include <cmath>
#include <utility>

namespace pacini
{

void ClipPlayer::prepare(double sampleRate)
{
    if (engine && rate == sampleRate)
        return;
    stopResampling();
    worker.reset();
    rate = sampleRate;
    engine = std::make_unique<PreviewEngine>(rate);
    worker = std::make_unique<PreviewWorker>(*engine);
    engine->set(playback);
    engine->setRow(row);
    engine->setControls(controls);
    resample();
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

void ClipPlayer::setSound(std::shared_ptr<const AudioData> wanted)
{
    if (sound == wanted)
        return;
    stopResampling();
    sound = std::move(wanted);
    engine->setSource(nullptr);
    resample();
}

void ClipPlayer::resample()
{
    if (!sound)
        return;
    resampling = std::thread(
        [this, from = sound, to = static_cast<int>(std::lround(rate))]
        {
            auto made = PreviewSource::of(*from, to, &noLongerWanted);
            if (!made)
                return;
            engine->setSource(std::move(made));
            worker->wake();
        });
}

void ClipPlayer::stopResampling()
{
    if (!resampling.joinable())
        return;
    noLongerWanted = true;
    resampling.join();
    noLongerWanted = false;
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
