#pragma once

// Presets of the live parameters, as plain data.

#include <pacini/realtime/TranslatorParams.h>

#include <array>
#include <string_view>

namespace pacini
{

/// A named set of live parameters.
struct TranslatorPreset
{
    std::string_view name;
    std::string_view purpose; ///< in plain words
    TranslatorParams params;
};

/// The shipped presets; the first one is the default of TranslatorParams.
[[nodiscard]] inline const std::array<TranslatorPreset, 8>& translatorPresets() noexcept
{
    static constexpr std::array<TranslatorPreset, 8> presets{{
        {"Neutral", "the range of touch of the sound, with hats and ticks beside it and stronger events", {}},
        {"Music",
         "a firm bass under a lighter body; only clear events",
         {.intensity = 3.0,
          .rumble = {2.0},
          .texture = {-3.0},
          .transients = {-3.0},
          .audible = 0.5,
          .transientSensitivity = 0.4}},
        {"Games and effects",
         "strong impacts, full body, fast attack",
         {.intensity = 6.0,
          .rumble = {3.0},
          .transients = {4.0},
          .transientSensitivity = 0.6,
          .transientSharpness = 0.2,
          .gateThreshold = -60.0}},
        {"Voice",
         "the rhythm of speech without its hum",
         {.intensity = 6.0,
          .rumble = {0.0, true},
          .transients = {-6.0},
          .transientSensitivity = 0.4,
          .gateThreshold = -50.0,
          .gateRelease = 150.0}},
        {"Rumble only",
         "only sound below 100 Hz",
         {.rumble = {0.0}, .texture = {0.0, true}, .transients = {0.0, true}}},
        {"Events only",
         "a pulse for each event, nothing between events",
         {.rumble = {0.0, true}, .texture = {0.0, true}, .transients = {12.0}}},
        {"Subtle",
         "subtle, for long sessions",
         {.intensity = -9.0,
          .texture = {-3.0},
          .transients = {-6.0},
          .brightness = -12.0,
          .audible = 0.5,
          .gateThreshold = -55.0}},
        {"Voice off", "as neutral, with less of speech", {.speech = 0.0}},
    }};
    return presets;
}

} // namespace pacini
