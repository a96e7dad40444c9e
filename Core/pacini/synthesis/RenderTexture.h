#pragma once

// A texture as a drive signal, by curves of speed and force.

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/actuator/Profile.h>
#include <pacini/clip/Curve.h>
#include <pacini/foundation/Result.h>
#include <pacini/synthesis/ActuatorOutput.h>
#include <pacini/synthesis/AdaptationParams.h>
#include <pacini/synthesis/RenderPlan.h>
#include <pacini/texture/Texture.h>
#include <pacini/texture/TextureParams.h>
#include <pacini/texture/TexturePlayer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Speed and force from 0 to 1 over s; without points of a force it is 1.
struct TextureCourse
{
    Curve speed;
    Curve force;
};

/// What a rendering of a texture reached.
struct TextureRenderReport
{
    std::uint64_t frames = 0;
    double peak = 0.0, rms = 0.0; ///< 1 is full drive
};

/// Takes the next frames; `done` of the whole, 0 to 1.
using TextureSink = std::function<Result<void>(std::span<const float> samples, double done)>;

/// Renders a valid texture for an actuator: through the equaliser of `profile` or the inverse of its resonance and
/// within its limits, without one within full drive. Delays are taken out. The same arguments give the same samples.
/// Errors: those of checkParameters(textureRenderParameters) and of the sink; invalidArgument at `speed` without
/// points, at `duration` without one where the last point of the speed is at 0; invalidData at `technology` for a
/// motor. [worker]
[[nodiscard]] inline Result<TextureRenderReport> renderTexture(const Texture& texture, const TextureCourse& course,
                                                               TextureRenderParams params, std::uint64_t seed,
                                                               const Profile* profile, const TextureSink& sink)
{
    if (course.speed.empty())
        return Error{ErrorCode::invalidArgument, "speed", "has no points"};
    if (!params.duration)
        params.duration = course.speed.back().time;
    if (!(*params.duration > 0.0))
        return Error{ErrorCode::invalidArgument, "duration",
                     "is missing; a speed without points has no end of its own"};
    if (auto allowed = checkParameters(textureRenderParameters, params); !allowed)
        return allowed.error();
    RenderPlan plan; // as far as an output needs it
    if (profile != nullptr)
    {
        if (profile->technology == Technology::erm)
            return Error{ErrorCode::invalidData, "technology",
                         "is a motor, which cannot follow a texture; take another actuator"};
        plan.profile = *profile;
        plan.flattening = flatteningOf(*profile, AdaptationParams().maxBoost);
    }
    const double fs = params.sampleRate;
    const auto block = static_cast<std::size_t>(std::max(1.0, std::floor(0.001 * fs)));
    TexturePlayer player(std::make_shared<const TextureTable>(texture, fs), seed);
    ActuatorOutput actuator(plan, {fs, block}, true, Seconds(0.001));
    TextureRenderReport report;
    report.frames = static_cast<std::uint64_t>(std::llround(*params.duration * fs));
    const auto frames = static_cast<std::int64_t>(report.frames), step = static_cast<std::int64_t>(block);
    const auto late = static_cast<std::int64_t>(player.latencyFrames() + actuator.latencyFrames());
    const double gain = params.gain.gain();
    double square = 0.0;
    CurveReader speeds(course.speed), forces(course.force);
    std::vector<float> samples(block);
    for (std::int64_t n = 0; n < frames + late; n += step)
    {
        const double time = static_cast<double>(n) / fs;
        player.setSpeed(speeds.at(time));
        player.setForce(course.force.empty() ? 1.0 : forces.at(time));
        player.process(samples);
        for (float& sample : samples)
            sample = toSample(gain * static_cast<double>(sample));
        actuator.process(samples);
        // The first frames are from before the beginning.
        const auto first = static_cast<std::size_t>(std::clamp<std::int64_t>(late - n, 0, step));
        const auto last = static_cast<std::size_t>(std::clamp<std::int64_t>(frames + late - n, 0, step));
        const auto heard = std::span<const float>(samples).first(last).subspan(std::min(first, last));
        for (const float sample : heard)
        {
            report.peak = std::max(report.peak, std::abs(static_cast<double>(sample)));
            square += static_cast<double>(sample) * static_cast<double>(sample);
        }
        if (auto taken = sink(heard, static_cast<double>(n) / static_cast<double>(frames + late)); !taken)
            return taken.error();
    }
    report.rms = std::sqrt(square / static_cast<double>(std::max<std::int64_t>(frames, 1)));
    return report;
}

} // namespace pacini
