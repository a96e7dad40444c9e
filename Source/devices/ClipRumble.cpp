#include "devices/ClipRumble.h"

#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/runtime/Engine.h>

#include <memory>
#include <utility>

namespace pacini::devices
{

namespace
{
/// The drive signal of a part of a clip; silence where none can be made.
DriveRenderer driveOf(const Clip& clip, const PlayRange& range, double gain, double sampleRate)
{
    EngineParams params;
    params.sampleRate = sampleRate;
    params.actuators.resize(1);
    params.maxPlays = 1;
    auto made = Engine::make(params);
    const auto part = LoadedClip::ofClip(trimClip(clip, {range.from.value, range.to.value}));
    std::shared_ptr<Engine> engine;
    if (made && part)
    {
        engine = std::move(made).value();
        PlaySettings settings;
        settings.controls.gain = gain;
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
} // namespace

ClipRumble::ClipRumble(Clip clip, const PlayRange& range, Decibels intensity, const ControllerModel& controller)
    : model(controller), packets(clip, range, intensity.gain(), pacingOf(controller).interval), states(controller)
{
    constexpr double fs = 8000.0; // the highest rate of a controller
    if (model.haptics == ControllerHaptics::steamController)
        drive.emplace(driveOf(clip, range, intensity.gain(), fs), 1, fs, model);
}

std::optional<RumbleState> ClipRumble::at(std::int64_t packet)
{
    const auto count = packets.count();
    const bool over = count && packet >= *count;
    if (drive)
        return over ? std::nullopt : drive->at(packet);
    const RumbleState state = states.of(packet, packets.at(packet));
    if (over && state == silentState(model.haptics))
        return std::nullopt;
    return state;
}

} // namespace pacini::devices
