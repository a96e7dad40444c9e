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
    std::vector<EncoderPreset> all;
    // The parameters of a new one, until the next is added.
    const auto add = [&](const char* name, const char* description) -> EncoderParams&
    {
        return all.emplace_back(EncoderPreset{name, description, {}}).params;
    };
    add("Effects", "Good for most sounds");
    auto* params = &add("Fine detail", "More bands and points");
    params->bands = 24;
    params->breakpoints = 60.0;
    params->quantise = 8;
    params = &add("Small file", "Few bands and points");
    params->bands = 6;
    params->breakpoints = 8.0;
    params->quantise = 5;
    params = &add("Transients first", "Finds weak and close hits");
    params->bands = 8;
    params->onsets.sensitivity = 2.0;
    params = &add("Steady texture", "Only clear hits become events");
    params->onsets.sensitivity = 0.5;
    params->breakpoints = 30.0;
    params = &add("Low rumble", "20 to 300 Hz, for large actuators");
    params->bands = 8;
    params->lowFrequency = 20.0;
    params->highFrequency = 300.0;
    params->audible = 0.0;
    add("As recorded", "Ignores sound above the range of touch").audible = 0.0;
    add("Music", "The beat first, less of hats and voices").audible = 0.5;
    add("Everything heard", "Loudness leads where most of a sound lies above touch").heard = HeardRole::instead;
    add("Voice off", "As effects, with less of speech").speech = 0.0;
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
