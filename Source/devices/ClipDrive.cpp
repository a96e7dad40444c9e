#include "devices/ClipDrive.h"

#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/runtime/Engine.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

namespace pacini::devices
{

DriveRenderer clipDrive(const Clip& clip, const PlayRange& range, Decibels gain, double sampleRate,
                        const Profile* profile)
{
    EngineParams params;
    params.sampleRate = sampleRate;
    params.actuators.resize(1);
    if (profile)
        params.actuators[0].profile = *profile;
    params.maxPlays = 1;
    auto made = Engine::make(params);
    const auto part = LoadedClip::asItIs(trimClip(clip, {range.from.value, range.to.value}));
    std::shared_ptr<Engine> engine;
    if (made && part)
    {
        engine = std::move(made).value();
        PlaySettings settings;
        settings.controls.gain = gain.gain();
        settings.loop = range.loop ? (*part)->duration() : 0.0;
        if (!engine->play(*part, settings))
            engine.reset();
    }
    return [engine](std::span<const std::span<float>> out)
    {
        if (engine)
            engine->render(out);
        else
            std::fill(out[0].begin(), out[0].end(), 0.0f);
    };
}

} // namespace pacini::devices
