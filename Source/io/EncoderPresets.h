#pragma once

// Presets of the encoder parameters.

#include <pacini/analysis/EncoderParams.h>
#include <pacini/foundation/Result.h>

#include <span>
#include <string>
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

/// The first preset is the default of the analysis.
[[nodiscard]] std::span<const EncoderPreset> encoderPresets();

/// The preset with just these settings, or null.
[[nodiscard]] const EncoderPreset* presetOf(const EncoderParams& params);

/// The name of a preset as options and documents have it: in lower case, with hyphens.
[[nodiscard]] std::string optionName(const EncoderPreset& preset);

/// Returns these names of all presets, in their order.
[[nodiscard]] std::vector<std::string> presetNames();

/// The preset of this name, as windows or as options have it; case does not matter. Errors: invalidArgument at
/// `preset`, with the names there are and the nearest.
[[nodiscard]] Result<const EncoderPreset*> presetNamed(std::string_view name);

} // namespace pacini
