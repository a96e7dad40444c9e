#pragma once

// Parameters of the analysis of a texture with their description, without its algorithms.

#include <pacini/foundation/Description.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <array>
#include <optional>

namespace pacini
{

/// Parameters of analyseTexture().
struct TextureParams
{
    int order = 32; ///< 24 and 32 are the knee of error against run time, see `pacini bench textures`
    std::optional<double> pitch;
    int tones = 16;
    double speed = 0.5;
    std::optional<double> fullSpeed;
    std::optional<double> fullForce;
    bool operator==(const TextureParams&) const = default;
};

/// Parameters of a rendering of a texture.
struct TextureRenderParams
{
    double sampleRate = 48000.0; ///< Hz
    Decibels gain{0.0};
    std::optional<double> duration; ///< s
    bool operator==(const TextureRenderParams&) const = default;
};

/// Descriptions of all of them.
inline constexpr std::array textureRenderParameters{
    described<&TextureRenderParams::sampleRate>({.name = "sampleRate",
                                                 .option = "rate",
                                                 .text = "Sample rate of the output",
                                                 .unit = "Hz",
                                                 .range = {limits::lowestRate, limits::highestRate}}),
    described<&TextureRenderParams::gain>(
        {.name = "gain",
         .text = "Gain; the limiter keeps the result within full drive (1) and the limits of the profile",
         .unit = "dB",
         .range = {-120, 60}}),
    described<&TextureRenderParams::duration>({.name = "duration",
                                               .text = "Length of the output",
                                               .unit = "s",
                                               .range = {0.001, 86400},
                                               .usualText = "until the last point of the speed"}),
};

/// Descriptions of all of TextureParams.
inline constexpr std::array textureParameters{
    described<&TextureParams::order>({.name = "order",
                                      .text = "Reflection coefficients of each spectrum; more tell closer tones apart",
                                      .range = {1, 64}}),
    described<&TextureParams::pitch>(
        {.name = "pitch",
         .text = "How frequencies follow the speed: 1 in proportion, as ridges do, 0 not at all, as a river",
         .range = {0, 1},
         .usualText = "measured; 1 for a single speed"}),
    described<&TextureParams::tones>(
        {.name = "tones",
         .text = "Most tones that follow the speed, such as orders of an engine; they are told from the noise",
         .range = {0, 64}}),
    described<&TextureParams::speed>(
        {.name = "recordedSpeed",
         .text = "Speed (0 to 1) at which the recording plays, where no table of speeds is given",
         .range = {0.01, 1}}),
    described<&TextureParams::fullSpeed>({.name = "fullSpeed",
                                          .text = "Speed that counts as 1, in the unit of the table",
                                          .range = {1e-9, 1e9},
                                          .usualText = "the highest of the table"}),
    described<&TextureParams::fullForce>({.name = "fullForce",
                                          .text = "Force that counts as 1, in the unit of the table",
                                          .range = {1e-9, 1e9},
                                          .usualText = "the highest of the table"}),
};

} // namespace pacini
