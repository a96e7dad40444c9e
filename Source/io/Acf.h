#pragma once

// Actuator configuration files (ACF) of the Meta haptics SDK: JSON5 with the settings of its renderer.

#include <pacini/foundation/Result.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace pacini
{

enum class AcfShape
{
    saw,
    sine,
    square,
    triangle
};

/// Playback of an event at one end of the sharpness scale; between the ends the renderer cross-fades.
struct AcfEmphasisEnd
{
    double frequency = 55.0; ///< Hz
    double duration = 36.4;  ///< ms
    AcfShape shape = AcfShape::sine;
    bool operator==(const AcfEmphasisEnd&) const = default;
};

/// The file's content. The defaults of the optional entries are the values that the SDK's own files mostly have.
struct Acf
{
    std::string version, device, date, author; ///< metadata, all optional
    double continuousGain = 1.0;
    double emphasisDucking = 0.5; ///< gain of the continuous signal while an event plays: 1 leaves it, 0 silences it
    double lowFrequency = 55.0;   ///< Hz, at a clip's frequency of 0
    double highFrequency = 200.0; ///< Hz, at a clip's frequency of 1; equal to the low one where only amplitude counts
    double emphasisGain = 1.0;
    double fadeOutPercent = 0.0;          ///< of an event's strength lost until its end
    std::array<AcfEmphasisEnd, 2> ends{}; ///< of the dullest and the sharpest event
    bool operator==(const Acf&) const = default;
};

/// Longer texts are refused.
inline constexpr std::size_t largestAcfText = std::size_t(1) << 20;

/// Reads an ACF. Required: `continuous` and `emphasis` with `frequency_min` and `frequency_max`, whose three entries
/// are required under `emphasis`. Gains and ducking are 0 to 1, the fade 0 to 100, the range 1 to 20000 Hz, emphasis 1
/// to 2000 Hz and 0.1 to 10000 ms. Unknown keys are ignored. Errors: as in jsonFromJson5(), and invalidData with a path
/// such as `emphasis.frequency_min.shape`.
[[nodiscard]] Result<Acf> readAcf(std::string_view text);

/// The text of a valid ACF, which is strict JSON; numbers have six digits, since the SDK reads them as float.
[[nodiscard]] std::string acfText(const Acf& acf);

} // namespace pacini
