#pragma once

// Offline player of a render plan: its drive signals, or the accelerations felt from them, block by block.

#include <pacini/actuator/FeltModel.h>
#include <pacini/actuator/MeasuredFelt.h>
#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Wearer.h>
#include <pacini/synthesis/RenderPlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Conversion of drive signals to samples of felt acceleration.
struct FeltSettings
{
    FeltModelParams model;
    unsigned wearer = 0;
    double drive = 1.0;                    ///< rated drives at a drive signal of 1: the profile's overdrive
    double fullScale = 100.0;              ///< m/s^2 at a sample of 1
    std::vector<MeasuredPoint> measured{}; ///< response at a drive signal of 1 in the place of the model, if any
};

/// Returns the model of the acceleration that `wearer` (see bodyOn) feels from `profile`, or its measured response,
/// which is that of its own wearer; none without either.
[[nodiscard]] inline std::optional<FeltSettings> feltSettingsOf(const Profile& profile, unsigned wearer,
                                                                double fullScale)
{
    auto model = feltModelParams(profile);
    if (!model && wearer == 0 && hasMeasuredAcceleration(profile))
        return FeltSettings{{}, 0, 1.0, fullScale, profile.measurement->points};
    if (!model)
        return std::nullopt;
    model->body.body = bodyOn(wearer, model->body.body);
    return FeltSettings{*model, wearer, profile.drive.overdrive, fullScale};
}

/// What is wrong at `body` of a profile that says nothing of what is felt.
[[nodiscard]] inline const char* notFeltText(const Profile& profile) noexcept
{
    return hasRelativeLevels(profile)
               ? "is missing, and the measured levels are relative, so the acceleration of the skin cannot be "
                 "predicted; analyse with --full-scale"
               : "is missing in this profile, so the acceleration of the skin cannot be predicted";
}

/// Why feltSettingsOf() has none: invalidData at `body`, invalidArgument at `wearer`.
[[nodiscard]] inline Error notFelt(const Profile& profile, unsigned wearer)
{
    if (wearer > 0 && hasMeasuredAcceleration(profile))
        return {ErrorCode::invalidArgument, "wearer",
                "needs a body model, but this profile was measured on one wearer; leave it out"};
    return {ErrorCode::invalidData, "body", notFeltText(profile)};
}

/// The drive signals of a plan, or the accelerations felt from them; both start at the same frame and are equally long.
/// [worker]
class SignalPlayer
{
public:
    /// `params.builtUntil` does not count: decoders are made shortly before they sound.
    SignalPlayer(RenderPlan plan, const ScenePlayerParams& params, const std::optional<FeltSettings>& felt)
        : player(std::move(plan), withoutDecoders(params)), fs(params.sampleRate)
    {
        if (!felt)
            return;
        driveScale = felt->drive;
        feltScale = 1.0 / felt->fullScale;
        if (!felt->measured.empty())
        {
            measured.assign(player.actuators(), MeasuredFelt(felt->measured, fs));
            late = measured.empty() ? 0 : measured.front().latencyFrames();
            return;
        }
        FeltModel model;
        ProcessSpec spec;
        spec.sampleRate = fs;
        model.prepare(spec);
        model.setParams(felt->model);
        models.assign(player.actuators(), model);
        late = model.latencyFrames();
    }

    [[nodiscard]] std::int64_t totalFrames() const noexcept { return player.totalFrames(); }
    [[nodiscard]] std::size_t maxSounding() const noexcept { return player.maxSounding(); }
    [[nodiscard]] double maxReduction() const noexcept { return player.maxReduction(); }
    [[nodiscard]] const ProtectionMeter* protectionMeter() const noexcept { return player.protectionMeter(); }

    /// Returns the content of the decoder of every play, in order of start. Creates decoders of plays that have not
    /// sounded yet.
    [[nodiscard]] const std::vector<DecodedPlay>& decodedPlays()
    {
        player.build(Seconds(std::numeric_limits<double>::infinity()));
        return player.decodedPlays();
    }

    /// Writes the next frames: one span for each actuator, all of the same length.
    void process(std::span<const std::span<float>> out)
    {
        if (late > 0)
        {
            std::vector<std::vector<float>> samples(out.size(), std::vector<float>(late));
            play(std::vector<std::span<float>>(samples.begin(), samples.end()));
            late = 0;
        }
        play(out);
    }

private:
    static constexpr double buildAhead =
        0.1; // s: decoders are made this early, so that no more than sound are in memory

    [[nodiscard]] static ScenePlayerParams withoutDecoders(ScenePlayerParams params)
    {
        params.builtUntil = 0_s;
        return params;
    }

    static void scale(std::span<float> samples, double factor)
    {
        for (float& sample : samples)
            sample = static_cast<float>(factor * static_cast<double>(sample));
    }

    void play(std::span<const std::span<float>> out)
    {
        position += static_cast<std::int64_t>(out.empty() ? 0 : out.front().size());
        player.build(Seconds(static_cast<double>(position) / fs + buildAhead));
        player.process(out);
        for (std::size_t a = 0; a < std::min(models.size(), out.size()); ++a)
        {
            scale(out[a], driveScale);
            models[a].process(out[a], out[a]);
            scale(out[a], feltScale);
        }
        for (std::size_t a = 0; a < std::min(measured.size(), out.size()); ++a)
        {
            scale(out[a], driveScale);
            measured[a].process(out[a], out[a]);
            scale(out[a], feltScale);
        }
    }

    ScenePlayer player;
    double fs;
    std::vector<FeltModel> models;      ///< one for each actuator, or none
    std::vector<MeasuredFelt> measured; ///< the same
    double driveScale = 1.0;
    double feltScale = 1.0;
    std::size_t late = 0;      ///< frames to be played before the first one is given out
    std::int64_t position = 0; ///< frames that were played
};

} // namespace pacini
