#pragma once

// Presets of the encoder parameters.

#include <pacini/analysis/EncoderParams.h>

#include <span>
#include <string_view>
#include <vector>

namespace pacini
{

struct EncoderPreset
{
    std::string_view name;
    std::string_view purpose; ///< in a few words
    EncoderParams params;
};

/// The first is what sounds are analysed with when nothing is said.
[[nodiscard]] inline std::span<const EncoderPreset> encoderPresets()
{
    static const std::vector<EncoderPreset> presets = []
    {
        std::vector<EncoderPreset> all = {
            {"Standard", "Good for most sounds", {}},
            {"Fine detail", "More bands and points", {}},
            {"Small file", "Few bands and points", {}},
            {"Transients first", "Finds weak and close hits", {}},
            {"Steady texture", "Only clear hits become events", {}},
            {"Low rumble", "20 to 300 Hz, for large actuators", {}},
            {"As recorded", "Ignores sound above the range of touch", {}},
            {"Music", "The beat first, less of hats and voices", {}},
            {"Everything heard", "Loudness leads where most of a sound lies above touch", {}},
        };
        all[1].params.bands = 24;
        all[1].params.breakpoints = 60.0;
        all[1].params.quantise = 8;
        all[2].params.bands = 6;
        all[2].params.breakpoints = 8.0;
        all[2].params.quantise = 5;
        all[3].params.bands = 8;
        all[3].params.onsets.sensitivity = 2.0;
        all[4].params.onsets.sensitivity = 0.5;
        all[4].params.breakpoints = 30.0;
        all[5].params.bands = 8;
        all[5].params.lowFrequency = 20.0;
        all[5].params.highFrequency = 300.0;
        all[5].params.audible = 0.0;
        all[6].params.audible = 0.0;
        all[7].params.audible = 0.5;
        all[8].params.heard = HeardRole::instead;
        return all;
    }();
    return presets;
}

/// The preset with just these settings, or null.
[[nodiscard]] inline const EncoderPreset* presetOf(const EncoderParams& params)
{
    for (const EncoderPreset& preset : encoderPresets())
        if (preset.params == params)
            return &preset;
    return nullptr;
}

} // namespace pacini
