// The call `encode`: a sound to a clip by Pacini's own method.

#include "web/core/Call.h"
#include "web/core/SoundInput.h"

#include <pacini/analysis/Encoder.h>

#include <string>
#include <utility>

namespace pacini::web
{

namespace
{
EncoderParams paramsOf(Call& call)
{
    EncoderParams params;
    params.bands = static_cast<int>(call.number("bands", params.bands, 1.0, 32.0));
    params.breakpoints = call.number("breakpoints", params.breakpoints, 0.5, 1000.0);
    params.quantise = static_cast<int>(call.number("quantise", params.quantise, 4.0, 16.0));
    params.lowFrequency = call.number("low", params.lowFrequency, 1.0, 1700.0);
    params.highFrequency = call.number("high", params.highFrequency, 2.0, 1800.0);
    params.audible = call.number("audible", params.audible, 0.0, 1.0);
    params.onsets.sensitivity = call.number("sensitivity", params.onsets.sensitivity, 0.25, 4.0);
    params.normalise = !call.truth("keepLevel", !params.normalise);
    const std::string spacing = call.word("spacing", "log");
    if (spacing != "log" && spacing != "linear")
        call.reader.fail("spacing", "must be log or linear", ErrorCode::invalidArgument);
    params.spacing = spacing == "log" ? BandSpacing::logarithmic : BandSpacing::linear;
    return params;
}
} // namespace

Result<void> encodeSound(Call& call)
{
    const EncoderParams params = paramsOf(call);
    SoundInput sound(call);
    if (call.reader.error)
        return {};
    if (auto valid = validate(params); !valid)
        return valid;
    Encoder encoder(params);
    auto clip = pacini::encodeSound(encoder, sound.sound(), sound);
    if (!clip)
        return clip.error();
    return sound.put(std::move(*clip));
}

} // namespace pacini::web
