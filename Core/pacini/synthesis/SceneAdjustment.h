#pragma once

// Adjustment of a whole scene: moved, stretched, transposed and varied.

#include <pacini/clip/Clip.h>
#include <pacini/synthesis/Scene.h>
#include <pacini/synthesis/Variation.h>
#include <pacini/synthesis/VariationSeed.h>

#include <cstddef>
#include <utility>

namespace pacini
{

/// Adjustments of a whole scene.
struct SceneAdjustment
{
    double gain = 0.0;          ///< dB
    double transposition = 0.0; ///< semitones
    double stretch = 1.0;
    double delay = 0.0;        ///< s
    VariationParams variation; ///< of plays that have none of their own; its seed moves all seeds
};

/// Moves, stretches, transposes and varies a whole scene. Times and changes come along.
[[nodiscard]] inline Scene adjusted(Scene scene, const SceneAdjustment& adjustment)
{
    const double r = adjustment.stretch;
    const auto moved = [&](double time)
    {
        return adjustment.delay + r * time;
    };
    scene.gain += adjustment.gain;
    if (scene.duration > 0.0)
        scene.duration = moved(scene.duration);
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
    {
        ScenePlay& play = scene.plays[i];
        play.start = moved(play.start);
        play.stretch *= r;
        play.transposition += adjustment.transposition;
        if (play.variation.amount == 0.0 && adjustment.variation.amount > 0.0)
        {
            play.variation = adjustment.variation;
            play.variation.seed = seedOfPlay(play.variation.seed, i); // plays of one clip differ
        }
        else
            play.variation.seed += adjustment.variation.seed;
    }
    for (SceneChange& change : scene.changes)
    {
        change.time = moved(change.time);
        change.glide *= r;
        if (change.parameter == SceneParameter::stretch)
            change.value *= r;
        if (change.parameter == SceneParameter::transposition)
            change.value += adjustment.transposition;
    }
    return scene;
}

} // namespace pacini
