#include "cli/SignalPlayer.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pacini::cli
{

namespace
{
constexpr double buildAhead = 0.1; // s: decoders are made this early, so that no more than sound are in memory

ScenePlayerParams withoutDecoders(ScenePlayerParams params)
{
    params.builtUntil = 0_s;
    return params;
}

void scale(std::span<float> samples, double factor)
{
    for (float& sample : samples)
        sample = static_cast<float>(factor * static_cast<double>(sample));
}
} // namespace

SignalPlayer::SignalPlayer(RenderPlan plan, ScenePlayerParams params, const std::optional<FeltSettings>& felt)
    : player(std::move(plan), withoutDecoders(params)), fs(params.sampleRate)
{
    if (!felt)
        return;
    FeltModel model;
    ProcessSpec spec;
    spec.sampleRate = fs;
    model.prepare(spec);
    model.setParams(felt->model);
    models.assign(player.actuators(), model);
    driveScale = felt->drive;
    feltScale = 1.0 / felt->fullScale;
    late = model.latencyFrames();
}

const std::vector<DecodedPlay>& SignalPlayer::decodedPlays()
{
    player.build(Seconds(std::numeric_limits<double>::infinity()));
    return player.decodedPlays();
}

void SignalPlayer::process(std::span<const std::span<float>> out)
{
    if (late > 0)
    {
        std::vector<std::vector<float>> samples(out.size(), std::vector<float>(late));
        play(std::vector<std::span<float>>(samples.begin(), samples.end()));
        late = 0;
    }
    play(out);
}

void SignalPlayer::play(std::span<const std::span<float>> out)
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
}

} // namespace pacini::cli
