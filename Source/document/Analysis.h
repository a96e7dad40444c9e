#pragma once

// Analysis of a sound for the editor: sound -> clip, as `pacini encode` makes it.

#include "document/AudioReference.h"
#include "io/StoredAudio.h"

#include <pacini/analysis/EncoderParams.h>

#include <functional>

namespace pacini
{

/// Progress callback, called repeatedly with the completed share, 0 to 1; returning false stops the work.
using GoOn = std::function<bool(double done)>;

/// The clip of a sound on the grids of `params.quantise` bits, named after its file and sealed, with
/// the markers of the file. Errors: those of
/// validate(params); invalidData for a sound without channels; cancelled when `goOn` has said no. Takes about a
/// hundredth of the sound's duration. [worker]
[[nodiscard]] Result<Clip> analyse(const StoredAudio& audio, const EncoderParams& params,
                                   const AudioReference& reference, const GoOn& goOn = {});

} // namespace pacini
