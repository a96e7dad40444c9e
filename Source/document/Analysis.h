#pragma once

// Sounds -> clips, as `pacini encode` makes them.

#include "document/AudioReference.h"

#include <pacini/analysis/Encoder.h>

namespace pacini
{

/// The clip of a sound on the grids of `params.quantise` bits, named after its file. Errors: those of validate(params);
/// invalidData for a sound without channels. Takes about a hundredth of the sound's duration. [worker]
[[nodiscard]] Result<Clip> analyse(const AudioData& audio, const EncoderParams& params,
                                   const AudioReference& reference);

} // namespace pacini
