#pragma once

// Textures: models of a surface, a river or an engine that are played by speed and force.

#include <pacini/foundation/Result.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pacini
{

namespace limits
{
inline constexpr std::size_t textureNodes = 32;       ///< of a texture
inline constexpr std::size_t textureOrder = 64;       ///< reflection coefficients of a node
inline constexpr double textureLowestExponent = 0.1;  ///< of level laws: a texture is silent at speed 0 and force 0
inline constexpr double textureHighestExponent = 3.0; ///< of level laws
inline constexpr double textureHighestLevel = 1000.0; ///< linear RMS
inline constexpr std::size_t textureTones = 64;       ///< of a texture
inline constexpr double textureToneFrequency = 20000; ///< Hz, of a tone at speed 1
} // namespace limits

inline constexpr double textureRate = 2400.0; ///< Hz, of the reflection coefficients of nodes
inline constexpr double textureLow = 20.0;    ///< Hz; levels count from here ...
inline constexpr double textureHigh = 1000.0; ///< ... to here

/// Level and spectrum of a texture at one speed.
struct TextureNode
{
    double speed = 1.0;             ///< above 0, up to 1
    double level = 0.1;             ///< RMS between 20 and 1000 Hz at force 1; 1 is full drive
    std::vector<double> reflection; ///< coefficients at 2400 Hz, between -1 and 1; see reflectionsOf()
    bool operator==(const TextureNode&) const = default;
};

/// A tone of a texture, such as an order of an engine: its frequency is in proportion to the speed.
struct TextureTone
{
    double frequency = 100.0;   ///< Hz at speed 1
    double phase = 0.0;         ///< cycles, 0 to 1, where the way (the integral of the speed) is 0
    std::vector<double> levels; ///< RMS at each node at force 1, 0 or more
    bool operator==(const TextureTone&) const = default;
};

/// A texture: noise whose spectrum and level depend on the speed, and whose level depends on the force (both 0 to 1);
/// beside it tones that follow the speed.
///
/// Autoregressive models over speed, as J. Romano and K. Kuchenbecker, "Creating realistic virtual textures from
/// contact acceleration data", 2012, and H. Culbertson, J. Unwin and K. Kuchenbecker, "Modeling and rendering realistic
/// textures from unconstrained tool-surface interactions", 2014, have them. Unlike there, spectra also move with the
/// speed, so that few nodes are enough for a surface whose ridges pass faster.
struct Texture
{
    std::string name;
    double fullSpeed = 1.0;         ///< speed 1 in the unit of the recording, such as mm/s or rpm; only for people
    double fullForce = 1.0;         ///< force 1, likewise
    double pitch = 1.0;             ///< frequencies are proportional to the speed raised to this; 0 to 1
    double levelBySpeed = 1.0;      ///< exponent of the level below and above all nodes
    double levelByForce = 0.5;      ///< exponent of the level
    std::vector<TextureNode> nodes; ///< in ascending speed, at least one
    std::vector<TextureTone> tones; ///< levels by the laws of the noise: beyond the nodes, and over force
    bool operator==(const Texture&) const = default;
};

/// Errors: invalidData, notFinite or tooLarge with the place, such as `nodes[2].reflection[7]`.
[[nodiscard]] inline Result<void> validate(const Texture& texture)
{
    const auto check = [](std::string where, double value, bool within, const char* rule) -> Result<void>
    {
        if (!std::isfinite(value))
            return Error{ErrorCode::notFinite, std::move(where), "must be a finite number"};
        if (!within)
            return Error{ErrorCode::invalidData, std::move(where), rule};
        return {};
    };
    const auto isExponent = [](double value)
    {
        return value >= limits::textureLowestExponent && value <= limits::textureHighestExponent;
    };
    for (const auto& [where, value, within, rule] :
         {std::tuple("fullSpeed", texture.fullSpeed, texture.fullSpeed > 0.0, "must be above 0"),
          std::tuple("fullForce", texture.fullForce, texture.fullForce > 0.0, "must be above 0"),
          std::tuple("pitch", texture.pitch, texture.pitch >= 0.0 && texture.pitch <= 1.0, "must be 0 to 1"),
          std::tuple("levelBySpeed", texture.levelBySpeed, isExponent(texture.levelBySpeed), "must be 0.1 to 3"),
          std::tuple("levelByForce", texture.levelByForce, isExponent(texture.levelByForce), "must be 0.1 to 3")})
        if (auto fine = check(where, value, within, rule); !fine)
            return fine;
    if (texture.nodes.empty())
        return Error{ErrorCode::invalidData, "nodes", "must have at least one node"};
    if (texture.nodes.size() > limits::textureNodes)
        return Error{ErrorCode::tooLarge, "nodes", "has more than 32 nodes"};
    double last = 0.0;
    for (std::size_t i = 0; i < texture.nodes.size(); ++i)
    {
        const TextureNode& node = texture.nodes[i];
        const std::string where = "nodes[" + std::to_string(i) + "].";
        if (auto fine = check(where + "speed", node.speed, node.speed > last && node.speed <= 1.0,
                              "must be above 0 and the speeds before it, and at most 1");
            !fine)
            return fine;
        last = node.speed;
        if (auto fine =
                check(where + "level", node.level, node.level > 0.0 && node.level <= limits::textureHighestLevel,
                      "must be above 0, and at most 1000");
            !fine)
            return fine;
        if (node.reflection.empty() || node.reflection.size() > limits::textureOrder)
            return Error{ErrorCode::invalidData, where + "reflection", "must have 1 to 64 numbers"};
        for (std::size_t k = 0; k < node.reflection.size(); ++k)
            if (auto fine = check(where + "reflection[" + std::to_string(k) + "]", node.reflection[k],
                                  std::abs(node.reflection[k]) < 1.0, "must be between -1 and 1, without these");
                !fine)
                return fine;
    }
    if (texture.tones.size() > limits::textureTones)
        return Error{ErrorCode::tooLarge, "tones", "has more than 64 tones"};
    for (std::size_t i = 0; i < texture.tones.size(); ++i)
    {
        const TextureTone& tone = texture.tones[i];
        const std::string where = "tones[" + std::to_string(i) + "].";
        if (auto fine = check(where + "frequency", tone.frequency,
                              tone.frequency > 0.0 && tone.frequency <= limits::textureToneFrequency,
                              "must be above 0, and at most 20000 Hz");
            !fine)
            return fine;
        if (auto fine =
                check(where + "phase", tone.phase, tone.phase >= 0.0 && tone.phase <= 1.0, "must be 0 to 1 cycles");
            !fine)
            return fine;
        if (tone.levels.size() != texture.nodes.size())
            return Error{ErrorCode::invalidData, where + "levels", "must have as many numbers as there are nodes"};
        for (std::size_t k = 0; k < tone.levels.size(); ++k)
            if (auto fine = check(where + "levels[" + std::to_string(k) + "]", tone.levels[k],
                                  tone.levels[k] >= 0.0 && tone.levels[k] <= limits::textureHighestLevel,
                                  "must be 0 or more, and at most 1000");
                !fine)
                return fine;
    }
    return {};
}

} // namespace pacini
