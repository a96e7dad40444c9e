#pragma once

// Field list of a texture in JSON, which its readers and writers follow, alone and within a scene.

#include "io/Fields.h"
#include "io/TextureFile.h"

#include <pacini/texture/Texture.h>

#include <type_traits>

namespace pacini::textureFields
{

inline constexpr DocumentFormat format{textureFormatName, textureFormatVersion, "a texture"};

inline constexpr auto nodeFields = [](auto& node, auto& visitor)
{
    visitNumbers(visitor, Need::required, "speed", node.speed, "level", node.level);
    visitor.numbers("reflection", node.reflection, limits::textureOrder);
};

inline constexpr auto toneFields = [](auto& tone, auto& visitor)
{
    visitor.number("frequency", tone.frequency, Need::required);
    visitor.number("phase", tone.phase, Need::optional);
    visitor.numbers("levels", tone.levels, limits::textureNodes);
};

/// Numbers and lists; name, nodes and tones are told apart by what the visitor reads.
inline constexpr auto content = [](auto& texture, auto& visitor)
{
    if constexpr (requires { visitor.optionalText("name", texture.name); })
        visitor.optionalText("name", texture.name);
    else
        visitor.text("name", texture.name, Need::usual);
    visitNumbers(visitor, Need::usual, "fullSpeed", texture.fullSpeed, "fullForce", texture.fullForce);
    visitNumbers(visitor, Need::required, "pitch", texture.pitch, "levelBySpeed", texture.levelBySpeed, "levelByForce",
                 texture.levelByForce);
    if constexpr (requires { visitor.list("", texture.nodes, 1, "", nodeFields, Need::required); })
    {
        visitor.list("nodes", texture.nodes, limits::textureNodes, "nodes", nodeFields, Need::required);
        visitor.list("tones", texture.tones, limits::textureTones, "tones", toneFields, Need::optional);
    }
    else
    {
        visitor.list("nodes", texture.nodes, limits::textureNodes, "nodes",
                     [&](auto& node) { nodeFields(node, visitor); });
        visitor.list("tones", texture.tones, limits::textureTones, "tones",
                     [&](auto& tone) { toneFields(tone, visitor); });
    }
};

/// Within another document, which says what it is.
inline constexpr auto embedded = [](auto& texture, auto& visitor)
{
    visitor.format(format);
    content(texture, visitor);
};

} // namespace pacini::textureFields
