#pragma once

// Scenes to test with.

#include "support/ClipSamples.h"
#include "support/RandomTexture.h"

#include <pacini/foundation/Random.h>
#include <pacini/synthesis/Scene.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace pacini::test
{

/// A clip of any shape whose texts are UTF-8.
inline Clip sceneClip(std::uint64_t seed)
{
    Clip clip = randomClip(seed);
    clip.markers.clear();
    clip.name = "clip " + std::to_string(seed);
    return clip;
}

/// A valid scene of any shape.
inline Scene randomScene(std::uint64_t seed)
{
    Random random(seed);
    const auto below = [&](double n)
    {
        return static_cast<std::size_t>(random.uniform(0.0, n));
    };
    Scene scene;
    scene.name = "scene \"" + std::to_string(seed) + "\"\n\xC3\xA4";
    scene.duration = 1.0 + random.uniform(0.0, 5.0);
    scene.gain = random.uniform(-40.0, 6.0);
    scene.actuators = 1 + static_cast<int>(below(16.0));
    scene.panLaw = static_cast<PanLaw>(below(3.0));
    scene.panDelay = random.uniform(0.0, 0.1);
    for (std::size_t i = below(4.0) + 1; i > 0; --i)
        scene.clips.push_back(sceneClip(seed * 100 + i));
    for (std::size_t i = below(20.0) + 1; i > 0; --i)
    {
        ScenePlay play;
        play.name = "play " + std::to_string(i);
        play.clip = below(static_cast<double>(scene.clips.size()));
        play.start = random.uniform(0.0, 4.0);
        play.loop = random.uniform() < 0.5 ? 0.0 : std::min(0.01, scene.clips[play.clip].duration);
        play.passes = below(9.0);
        play.gain = random.uniform(-140.0, 6.0);
        play.pan = random.uniform();
        play.transposition = random.uniform(-12.0, 12.0);
        play.stretch = random.uniform(0.5, 2.0);
        play.priority = static_cast<int>(below(9.0)) - 4;
        play.variation = {random.uniform(), static_cast<VariationScope>(below(2.0)), random.next()};
        play.tones = random.uniform(-140.0, 6.0);
        play.events = below(2.0) == 0 ? 0.0 : random.uniform(-140.0, 6.0);
        play.noise = random.uniform(-6.0, 6.0);
        scene.plays.push_back(play);
    }
    for (double time = 0.0; time < 1.0; time += random.uniform(0.0, 0.2))
    {
        const auto parameter = static_cast<SceneParameter>(below(8.0));
        scene.changes.push_back({time, below(static_cast<double>(scene.plays.size())), parameter,
                                 0.5 + 0.5 * random.uniform(), random.uniform()});
    }
    return scene;
}

/// The same with textures, which move.
inline Scene texturedScene(std::uint64_t seed)
{
    Scene scene = randomScene(seed);
    Random random(seed + 1);
    for (std::uint64_t i = 0; i < 2; ++i)
    {
        Clip silent;
        silent.duration = random.uniform(0.1, 3.0);
        ScenePlay play;
        play.clip = scene.clips.size();
        play.texture = scene.textures.size();
        play.speed = random.uniform();
        play.force = random.uniform();
        scene.clips.push_back(silent);
        scene.textures.push_back(randomTexture(7 * seed + i));
        scene.plays.push_back(play);
        const double last = scene.changes.empty() ? 0.0 : scene.changes.back().time;
        scene.changes.push_back({last, scene.plays.size() - 1, i == 0 ? SceneParameter::speed : SceneParameter::force,
                                 random.uniform(), random.uniform()});
    }
    return scene;
}

} // namespace pacini::test
