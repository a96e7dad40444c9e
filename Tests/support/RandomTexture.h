#pragma once

// Valid textures at random.

#include <pacini/foundation/Random.h>
#include <pacini/texture/Texture.h>

#include <cstddef>
#include <cstdint>

namespace pacini::test
{

inline Texture randomTexture(std::uint64_t seed)
{
    Random random(seed);
    Texture texture;
    if (random.next() % 4 != 0)
        texture.name = "Rille \"tief\"\n";
    texture.fullSpeed = random.uniform(1e-3, 1e3);
    texture.fullForce = random.uniform(1e-3, 1e3);
    texture.pitch = random.uniform();
    texture.levelBySpeed = random.uniform(0.1, 3.0);
    texture.levelByForce = random.uniform(0.1, 3.0);
    const std::size_t count = 1 + random.next() % limits::textureNodes;
    for (std::size_t i = 0; i < count; ++i)
    {
        TextureNode node;
        node.speed = (static_cast<double>(i) + random.uniform(0.01, 1.0)) / static_cast<double>(count);
        node.level = random.uniform(1e-6, 2.0);
        node.reflection.resize(1 + random.next() % limits::textureOrder);
        for (double& k : node.reflection)
            k = random.uniform(-1.0, 1.0) * 0.999999;
        texture.nodes.push_back(node);
    }
    for (std::size_t i = random.next() % 5; i > 0; --i)
    {
        TextureTone tone;
        tone.frequency = random.uniform(1.0, limits::textureToneFrequency);
        tone.phase = random.next() % 2 == 0 ? 0.0 : random.uniform();
        for (std::size_t k = 0; k < count; ++k)
            tone.levels.push_back(random.next() % 4 == 0 ? 0.0 : random.uniform(0.0, 2.0));
        texture.tones.push_back(tone);
    }
    return texture;
}

} // namespace pacini::test
