#include "io/EncoderPresets.h"

#include "io/JsonText.h"
#include "io/NearestName.h"

#include <fmt/format.h>

#include <algorithm>

namespace pacini
{

namespace
{
std::vector<EncoderPreset> madePresets()
{
    std::vector<EncoderPreset> all = {
        {"Effects", "Good for most sounds", {}},
        {"Fine detail", "More bands and points", {}},
        {"Small file", "Few bands and points", {}},
        {"Transients first", "Finds weak and close hits", {}},
        {"Steady texture", "Only clear hits become events", {}},
        {"Low rumble", "20 to 300 Hz, for large actuators", {}},
        {"As recorded", "Ignores sound above the range of touch", {}},
        {"Music", "The beat first, less of hats and voices", {}},
        {"Everything heard", "Loudness leads where most of a sound lies above touch", {}},
        {"Voice off", "As effects, with less of speech", {}},
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
    all[9].params.speech = 0.0;
    return all;
}

/// `name` in lower case, with hyphens for spaces.
std::string hyphened(std::string_view name)
{
    std::string result(name);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](char c) { return c == ' '               ? '-'
                                       : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a')
                                                              : c; });
    return result;
}
} // namespace

std::span<const EncoderPreset> encoderPresets()
{
    static const std::vector<EncoderPreset> presets = madePresets();
    return presets;
}

const EncoderPreset* presetOf(const EncoderParams& params)
{
    const auto presets = encoderPresets();
    const auto found = std::find_if(presets.begin(), presets.end(),
                                    [&](const EncoderPreset& preset) { return preset.params == params; });
    return found != presets.end() ? &*found : nullptr;
}

std::string optionName(const EncoderPreset& preset)
{
    return hyphened(preset.name);
}

std::vector<std::string> presetNames()
{
    std::vector<std::string> names;
    for (const EncoderPreset& preset : encoderPresets())
        names.push_back(optionName(preset));
    return names;
}

Result<const EncoderPreset*> presetNamed(std::string_view name)
{
    const std::string wanted = hyphened(name);
    for (const EncoderPreset& preset : encoderPresets())
        if (optionName(preset) == wanted)
            return &preset;
    const std::vector<std::string> names = presetNames();
    return Error{
        ErrorCode::invalidArgument, "preset",
        fmt::format("'{}' is not one of {}{}", shownText(name), fmt::join(names, ", "), meantText(wanted, names))};
}

} // namespace pacini
